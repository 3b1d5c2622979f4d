use std::hash::{Hash, Hasher};
use std::ops::Bound;

use foldhash::fast::RandomState;
use imbl::ordmap::DiffItem;
use imbl::shared_ptr::DefaultSharedPtr;
use imbl::{GenericHashMap, OrdMap};

use crate::{Atom, Name};

/// Identifies an atom in its [`Atoms`] table. The order of the numbers is the
/// order of the variables in every diagram and every printed product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct AtomId(pub u64);

impl Hash for AtomId {
    /// Most numbers differ in their upper half alone, and simple hashes look at
    /// the lower bits.
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.0.rotate_left(32));
    }
}

/// Numbers left free behind an atom, so that others find room between it and
/// the next when a program is edited.
const ROOM: u64 = 1 << 32;

/// All atoms of a program or a spec, in the order of their diagrams.
///
/// Atoms get their place when they are first added, so add them in the order
/// wanted: for a ladder, coils by address, then inputs by address, the order
/// that the paper's Table 5 is printed in.
///
/// A table that [follows](Atoms::following) an earlier one gives atoms the
/// numbers that they had, as far as the order allows, and never gives a number
/// of that table to another atom: a function over the atoms of the earlier
/// table means the same in this one if all its atoms are still there.
///
/// Clones share what they hold, and when one of them is changed, all that did
/// not change.
#[derive(Clone, Debug, Default)]
pub struct Atoms {
    table: Table,
    /// The table whose numbers are given again.
    earlier: Option<Table>,
    /// The numbers that were asked for, where somebody wants to know.
    asked: Option<Vec<AtomId>>,
}

#[derive(Clone, Debug, Default)]
struct Table {
    listed: OrdMap<AtomId, Atom>,
    ids: GenericHashMap<Atom, AtomId, RandomState, DefaultSharedPtr>,
}

impl Table {
    fn insert(&mut self, id: AtomId, atom: Atom) {
        self.listed.insert(id, atom.clone());
        self.ids.insert(atom, id);
    }

    fn remove(&mut self, id: AtomId) {
        if let Some(atom) = self.listed.remove(&id) {
            self.ids.remove(&atom);
        }
    }

    fn last(&self) -> u64 {
        self.listed.get_max().map_or(0, |(id, _)| id.0)
    }

    fn is_same(&self, other: &Self) -> bool {
        self.listed.ptr_eq(&other.listed)
    }
}

impl Atoms {
    /// An empty table.
    pub fn new() -> Self {
        Self::default()
    }

    /// A table of the atoms of `order`, each named once, that follows
    /// `earlier`. As many as possible keep their numbers.
    pub fn following(earlier: &Self, order: Vec<Atom>) -> Self {
        let was = &earlier.table;
        let same =
            was.listed.len() == order.len() && was.listed.values().zip(&order).all(|(a, b)| a == b);
        let table = match same {
            true => was.clone(),
            false => numbered(order, was),
        };
        Self {
            table,
            earlier: Some(was.clone()),
            asked: None,
        }
    }

    /// The same table, to be changed atom by atom; it follows this one.
    pub fn editing(&self) -> Self {
        Self {
            table: self.table.clone(),
            earlier: Some(self.table.clone()),
            asked: None,
        }
    }

    /// Takes an atom out.
    pub fn remove(&mut self, id: AtomId) {
        self.table.remove(id);
    }

    /// Puts back an atom that was taken out, where the order allows it.
    pub fn put_back(&mut self, id: AtomId, atom: Atom) {
        self.table.insert(id, atom);
    }

    /// Takes out all atoms behind `last`.
    pub fn end_at(&mut self, last: Option<AtomId>) {
        while let Some((id, _)) = self.table.listed.get_max()
            && Some(*id) > last
        {
            let id = *id;
            self.table.remove(id);
        }
    }

    /// Puts a new atom right behind another, or before all. `None` if there is
    /// no room.
    pub fn insert_behind(&mut self, other: Option<AtomId>, atom: Atom) -> Option<AtomId> {
        let least = other.map_or(0, |it| it.0);
        let next = self.next_behind(AtomId(least));
        let step = match next {
            Some(next) => step_between(least, next.0, 1),
            None => ROOM,
        };
        let id = unused(self.earlier.as_ref(), least.checked_add(step.max(1))?);
        if next.is_some_and(|next| next <= id) {
            return None;
        }
        self.table.insert(id, atom);
        Some(id)
    }

    /// The atom behind the number `id`.
    pub fn next_behind(&self, id: AtomId) -> Option<AtomId> {
        let behind = (Bound::Excluded(id), Bound::Unbounded);
        self.table.listed.range(behind).next().map(|(id, _)| *id)
    }

    /// Ends the giving again of earlier numbers: the table is whole.
    pub fn settle(&mut self) {
        self.earlier = None;
        self.asked = None;
    }

    /// Whether both hold the same atoms under the same numbers.
    pub fn is_same(&self, other: &Self) -> bool {
        self.table.is_same(&other.table) || self.table.listed == other.table.listed
    }

    /// Atoms of this table that have another number in `other`, or none, in
    /// order.
    pub fn missing_in(&self, other: &Self) -> Vec<AtomId> {
        let differences = self.table.listed.diff(&other.table.listed);
        let missing = differences.filter_map(|difference| match difference {
            DiffItem::Remove(id, _) | DiffItem::Update { old: (id, _), .. } => Some(*id),
            DiffItem::Add(..) => None,
        });
        missing.collect()
    }

    /// Begins to take down which atoms are asked for by adding them.
    pub fn watch(&mut self) {
        self.asked = Some(Vec::new());
    }

    /// Ends what [`watch`](Self::watch) began: the atoms in the order in which
    /// they were asked for, as often as they were.
    pub fn watched(&mut self) -> Vec<AtomId> {
        self.asked.take().unwrap_or_default()
    }

    /// The number of `atom`, added at the end if it is new.
    pub fn add(&mut self, atom: Atom) -> AtomId {
        let id = match self.find(&atom) {
            Some(id) => id,
            None => {
                let id = self.next(&atom);
                self.table.insert(id, atom);
                id
            }
        };
        if let Some(asked) = &mut self.asked {
            asked.push(id);
        }
        id
    }

    /// The number for an atom at the end.
    fn next(&self, atom: &Atom) -> AtomId {
        let last = self.table.last();
        let Some(earlier) = &self.earlier else {
            return AtomId(last + ROOM);
        };
        match earlier.ids.get(atom) {
            Some(id) if id.0 > last => *id,
            _ => unused(Some(earlier), last + ROOM),
        }
    }

    /// The number of the variable called `name`, added if it is new.
    pub fn add_variable(&mut self, name: &Name) -> AtomId {
        self.add(Atom::Variable(name.clone()))
    }

    /// The number of `atom`, if it is in the table.
    pub fn find(&self, atom: &Atom) -> Option<AtomId> {
        self.table.ids.get(atom).copied()
    }

    /// The number of the variable called `name`, if it is in the table.
    pub fn find_variable(&self, name: &Name) -> Option<AtomId> {
        self.find(&Atom::Variable(name.clone()))
    }

    /// The atom with a number of this table.
    pub fn atom(&self, id: AtomId) -> &Atom {
        &self.table.listed[&id]
    }

    /// The place of an atom of this table in its order, from 0. Counts those
    /// before it.
    pub fn place(&self, id: AtomId) -> usize {
        self.table.listed.range(..id).count()
    }

    /// The atom at a place of the order. Counts those before it.
    pub fn at(&self, place: usize) -> Option<AtomId> {
        self.table.listed.keys().nth(place).copied()
    }

    /// The last atom.
    pub fn last(&self) -> Option<AtomId> {
        self.table.listed.get_max().map(|(id, _)| *id)
    }

    /// All atoms with their numbers, in order.
    pub fn iter(&self) -> impl Iterator<Item = (AtomId, &Atom)> {
        self.table.listed.iter().map(|(id, atom)| (*id, atom))
    }

    /// Number of atoms.
    pub fn len(&self) -> usize {
        self.table.listed.len()
    }

    /// Whether the table is empty.
    pub fn is_empty(&self) -> bool {
        self.table.listed.is_empty()
    }
}

/// The first number from `id` on that no atom of `earlier` has.
fn unused(earlier: Option<&Table>, id: u64) -> AtomId {
    let mut id = AtomId(id);
    while earlier.is_some_and(|it| it.listed.contains_key(&id)) {
        id.0 += 1;
    }
    id
}

/// The table of the atoms of `order`, with those numbers of `earlier` that can
/// stay.
fn numbered(order: Vec<Atom>, earlier: &Table) -> Table {
    let known: Vec<Option<AtomId>> = order
        .iter()
        .map(|atom| earlier.ids.get(atom).copied())
        .collect();
    let kept = longest_ascending(&known);
    squeezed(&order, &kept, earlier).unwrap_or_else(|| spaced(order, earlier))
}

/// Every atom gets a new number, with room behind it, beyond all of `earlier`.
fn spaced(order: Vec<Atom>, earlier: &Table) -> Table {
    let start = match earlier.last().checked_add(ROOM * (order.len() as u64 + 1)) {
        Some(end) if end < u64::MAX / 2 => earlier.last(),
        _ => 0,
    };
    let mut table = Table::default();
    let mut last = start;
    for atom in order {
        let id = unused(Some(earlier), last + ROOM);
        last = id.0;
        table.insert(id, atom);
    }
    table
}

/// Atoms without a number get one between those of their neighbours. `None` if
/// there is no room.
fn squeezed(order: &[Atom], kept: &[Option<AtomId>], earlier: &Table) -> Option<Table> {
    let mut table = earlier.clone();
    let mut staying = kept.iter().flatten().peekable();
    for id in earlier.listed.keys() {
        if staying.next_if(|it| *it == id).is_none() {
            table.remove(*id);
        }
    }
    let mut last = 0;
    let mut at = 0;
    while at < order.len() {
        if let Some(id) = kept[at] {
            last = id.0;
            at += 1;
            continue;
        }
        let end = (at..order.len()).find(|&it| kept[it].is_some());
        let count = end.unwrap_or(order.len()) - at;
        let next = end.and_then(|end| kept[end]);
        let step = match next {
            Some(next) => step_between(last, next.0, count as u64),
            None => ROOM,
        };
        for atom in &order[at..at + count] {
            let id = unused(Some(earlier), last.checked_add(step.max(1))?);
            table.insert(id, atom.clone());
            last = id.0;
        }
        at += count;
        if next.is_some_and(|next| last >= next.0) {
            return None;
        }
    }
    Some(table)
}

/// How far apart `count` numbers are put between two others: a little nearer to
/// the lower, since new names mostly follow each other.
fn step_between(last: u64, next: u64, count: u64) -> u64 {
    (next - last) / (count + 1).max(3)
}

/// The numbers of a longest ascending part of `numbers`, in their places; all
/// others are `None`.
fn longest_ascending(numbers: &[Option<AtomId>]) -> Vec<Option<AtomId>> {
    let mut known = numbers.iter().flatten();
    if known
        .clone()
        .zip(known.by_ref().skip(1))
        .all(|(a, b)| a < b)
    {
        return numbers.to_vec();
    }
    // For each length the place of the least number that ends a part of it.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = vec![None; numbers.len()];
    for (at, number) in numbers.iter().enumerate() {
        let Some(number) = number else { continue };
        let length = ends.partition_point(|&end| numbers[end] < Some(*number));
        before[at] = length.checked_sub(1).map(|shorter| ends[shorter]);
        match ends.get_mut(length) {
            Some(end) => *end = at,
            None => ends.push(at),
        }
    }
    let mut kept = vec![None; numbers.len()];
    let mut next = ends.last().copied();
    while let Some(at) = next {
        kept[at] = numbers[at];
        next = before[at];
    }
    kept
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn table(names: &[&str]) -> Atoms {
        let mut atoms = Atoms::new();
        for name in names {
            atoms.add_variable(&(*name).into());
        }
        atoms
    }

    fn order(names: &[&str]) -> Vec<Atom> {
        let atom = |name: &&str| Atom::Variable((*name).into());
        names.iter().map(atom).collect()
    }

    /// The names in order, those marked that have their numbers from before.
    fn marked(before: &[&str], after: &[&str]) -> String {
        let earlier = table(before);
        let later = Atoms::following(&earlier, order(after));
        let marked = later.iter().map(|(id, atom)| {
            let mark = if earlier.find(atom) == Some(id) {
                "="
            } else {
                ""
            };
            format!("{mark}{atom}")
        });
        marked.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn atoms_keep_their_numbers_when_others_come_and_go() {
        assert_eq!(marked(&["a", "b", "c"], &["a", "x", "c", "y"]), "=a x =c y");
        assert_eq!(
            marked(&["a", "b"], &["x", "y", "z", "a", "b"]),
            "x y z =a =b"
        );
    }

    #[test]
    fn an_atom_that_moves_gets_another_number_and_all_others_keep_theirs() {
        assert_eq!(
            marked(&["a", "b", "c", "d"], &["b", "c", "a", "d"]),
            "=b =c a =d"
        );
    }

    #[test]
    fn a_table_in_the_same_order_is_the_same() {
        let earlier = table(&["a", "b"]);
        let later = Atoms::following(&earlier, order(&["a", "b"]));
        assert!(later.is_same(&earlier) && later.missing_in(&earlier).is_empty());
    }

    #[test]
    fn what_is_added_later_gets_its_earlier_number_where_the_order_allows() {
        let earlier = table(&["a", "b", "c"]);
        let mut later = Atoms::following(&earlier, order(&["a"]));
        let [c, b] = ["c", "b"].map(|name| later.add_variable(&name.into()));
        assert_eq!(Some(c), earlier.find_variable(&"c".into()));
        assert_ne!(Some(b), earlier.find_variable(&"b".into()));
        assert!(b > c && later.atom(b).to_string() == "b");
    }

    #[test]
    fn names_that_follow_each_other_find_room_for_a_while_and_then_all_move() {
        let mut atoms = table(&["first", "last"]);
        let mut names = vec!["first".to_owned(), "last".to_owned()];
        for round in 0..200 {
            names.insert(names.len() - 1, format!("n{round}"));
            let order = names
                .iter()
                .map(|name| Atom::Variable(name.as_str().into()));
            atoms = Atoms::following(&atoms, order.collect());
            let said: Vec<String> = atoms.iter().map(|(_, atom)| atom.to_string()).collect();
            assert_eq!(said, names);
        }
    }

    proptest! {
        #[test]
        fn numbers_ascend_and_none_gets_another_meaning(
            first in proptest::sample::subsequence((0..12).collect::<Vec<_>>(), 0..12).prop_shuffle(),
            second in proptest::sample::subsequence((0..12).collect::<Vec<_>>(), 0..12).prop_shuffle(),
        ) {
            let order = |numbers: &[i32]| -> Vec<Atom> {
                numbers.iter().map(|it| Atom::Variable(it.to_string().into())).collect()
            };
            let earlier = Atoms::following(&Atoms::new(), order(&first));
            let later = Atoms::following(&earlier, order(&second));
            let said: Vec<Atom> = later.iter().map(|(_, atom)| atom.clone()).collect();
            prop_assert_eq!(said, order(&second));
            let ids: Vec<AtomId> = later.iter().map(|(id, _)| id).collect();
            prop_assert!(ids.is_sorted_by(|a, b| a < b));
            for (id, atom) in earlier.iter() {
                let free = ids.binary_search(&id).is_err();
                prop_assert!(free || later.atom(id) == atom);
                prop_assert_eq!(earlier.missing_in(&later).contains(&id), free);
            }
        }
    }
}
