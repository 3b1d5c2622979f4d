//! Which variables a program names, where, and the order that their atoms get:
//! coils before inputs, each by address.
//!
//! The order is that of the paper's Table 5. It decides how conditions print
//! and, for the paper's own rule (`cubes`), what that rule finds.

use std::cmp::Ordering;
use std::sync::Arc;

use foldhash::fast::RandomState;
use imbl::shared_ptr::DefaultSharedPtr;
use imbl::{GenericHashMap, OrdMap, OrdSet};
use ladder::{Class, Declarations, ElementKind, Network, Program};
use logic::{Atom, Name};

use super::Place;

/// Every name that a contact reads or anything writes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    uses: GenericHashMap<Name, Arc<Uses>, RandomState, DefaultSharedPtr>,
    /// The names of coils and contacts, as they are ordered without addresses.
    order: OrdMap<Key, Name>,
    /// Names that are read, and that no coil writes and nothing declares to come
    /// from outside.
    unaccounted: OrdSet<Name>,
    /// Of the names that coils write and of those that are only read: how many
    /// there are, and how many have an address.
    addressed: [(usize, usize); 2],
}

/// Where one name stands, in the order of the source.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Uses {
    pub(crate) coils: Vec<Place>,
    pub(crate) contacts: Vec<Place>,
    /// Elements other than coils that write it.
    pub(crate) written_otherwise: Vec<Place>,
}

/// Names are ordered by this where one of them has no address: what coils
/// write by its first coil; what is only read by its declaration, or behind all
/// that have one, by its first contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Key {
    Written(Place),
    Read(usize, Place),
}

impl Key {
    /// Which of the two lists the name is in.
    fn list(self) -> usize {
        match self {
            Self::Written(_) => 0,
            Self::Read(..) => 1,
        }
    }
}

impl Names {
    pub(super) fn of(program: &Program) -> Self {
        let mut uses: foldhash::HashMap<Name, Uses> = foldhash::HashMap::default();
        for (routine, it) in program.routines.iter().enumerate() {
            for (rung, it) in it.rungs.iter().enumerate() {
                note(routine, rung, &it.network, |name, place, role| {
                    uses.entry(name.clone()).or_default().list(role).push(place);
                });
            }
        }
        let mut names = Self::default();
        for (name, uses) in uses {
            if let Some(key) = uses.key(&name, &program.declarations) {
                names.enter(key, &name, &program.declarations);
            }
            names.uses.insert(name, Arc::new(uses));
        }
        names
    }

    /// The names of contacts and coils in their order.
    pub(super) fn order(&self, declarations: &Declarations) -> Vec<Atom> {
        let (written, read) = self
            .order
            .iter()
            .partition::<Vec<_>, _>(|(key, _)| key.list() == 0);
        let lists = [(0, written), (1, read)].map(|(list, names)| {
            let mut names: Vec<Name> = names.iter().map(|(_, name)| (*name).clone()).collect();
            if self.is_by_address(list) {
                names.sort_by(|a, b| {
                    let [a, b] = [a, b].map(|name| address(name, declarations).unwrap_or_default());
                    natural(&a, &b)
                });
            }
            names
        });
        lists.into_iter().flatten().map(Atom::Variable).collect()
    }

    /// Whether all names of a list have an address, so that these order them.
    fn is_by_address(&self, list: usize) -> bool {
        let (all, addressed) = self.addressed[list];
        all > 0 && all == addressed
    }

    /// Where a name stands.
    pub(crate) fn uses(&self, name: &str) -> Option<&Arc<Uses>> {
        self.uses.get(name)
    }

    /// Whether a name stands just where `uses` says.
    pub(crate) fn is_used_as(&self, name: &str, uses: &Arc<Uses>) -> bool {
        match self.uses.get(name) {
            Some(now) => Arc::ptr_eq(now, uses) || now == uses,
            None => **uses == Uses::default(),
        }
    }

    /// Names that contacts read, that no coil writes and that nothing declares
    /// to come from outside.
    pub(crate) fn unaccounted(&self) -> impl Iterator<Item = &Name> {
        self.unaccounted.iter()
    }

    /// What orders a name; `None` if neither a coil nor a contact names it.
    pub(super) fn key(&self, name: &str, declarations: &Declarations) -> Option<Key> {
        self.uses.get(name)?.key(name, declarations)
    }

    /// The name before a key.
    pub(super) fn before(&self, key: Key) -> Option<&Name> {
        self.order.range(..key).next_back().map(|(_, name)| name)
    }

    /// The last name of the order.
    pub(super) fn last(&self) -> Option<&Name> {
        self.order.get_max().map(|(_, name)| name)
    }

    /// Changes the network of a rung. `None` where addresses order a name that
    /// moves.
    pub(super) fn edited(
        &mut self,
        (routine, rung): (usize, usize),
        before: &Network,
        after: &Network,
        declarations: &Declarations,
    ) -> Option<Edited> {
        let mut here: Vec<(Name, Uses)> = Vec::new();
        for network in [before, after] {
            note(routine, rung, network, |name, _, _| {
                if here.iter().all(|(it, _)| it != name) {
                    here.push((name.clone(), Uses::default()));
                }
            });
        }
        note(routine, rung, after, |name, place, role| {
            if let Some((_, uses)) = here.iter_mut().find(|(it, _)| it == name) {
                uses.list(role).push(place);
            }
        });
        let mut moved = Vec::new();
        let mut used_otherwise = Vec::new();
        for (name, here) in here {
            let was = self.uses.get(&name).cloned().unwrap_or_default();
            let uses = was.with_rung((routine, rung), here);
            let [old, new] = [&*was, &uses].map(|uses| uses.key(&name, declarations));
            if old != new {
                moved.push((name.clone(), old, new));
            }
            if uses == *was {
                continue;
            }
            used_otherwise.push(name.clone());
            match uses.is_empty() {
                true => self.uses.remove(&name),
                false => self.uses.insert(name, Arc::new(uses)),
            };
        }
        let keys = || moved.iter().flat_map(|(_, old, new)| [old, new]).flatten();
        let ordered_by_address = |names: &Self| keys().any(|key| names.is_by_address(key.list()));
        if ordered_by_address(self) {
            return None;
        }
        // One may take the place that another leaves.
        for (name, old, _) in &moved {
            if let Some(key) = old {
                self.leave(*key, name, declarations);
            }
        }
        for (name, _, new) in &moved {
            if let Some(key) = new {
                self.enter(*key, name, declarations);
            }
        }
        if ordered_by_address(self) {
            return None;
        }
        Some(Edited {
            moved: moved.into_iter().map(|(name, ..)| name).collect(),
            used_otherwise,
        })
    }

    fn enter(&mut self, key: Key, name: &Name, declarations: &Declarations) {
        self.order.insert(key, name.clone());
        let (all, addressed) = &mut self.addressed[key.list()];
        *all += 1;
        *addressed += usize::from(address(name, declarations).is_some());
        if key.list() == 1 && !comes_from_outside(name, declarations) {
            self.unaccounted.insert(name.clone());
        }
    }

    fn leave(&mut self, key: Key, name: &Name, declarations: &Declarations) {
        self.order.remove(&key);
        let (all, addressed) = &mut self.addressed[key.list()];
        *all -= 1;
        *addressed -= usize::from(address(name, declarations).is_some());
        if key.list() == 1 {
            self.unaccounted.remove(name);
        }
    }
}

/// What an edit of a rung does to names.
#[derive(Default)]
pub(super) struct Edited {
    /// Names that came or went or have another key.
    pub(super) moved: Vec<Name>,
    /// Names that stand in other places.
    pub(super) used_otherwise: Vec<Name>,
}

/// What an element does with a name.
#[derive(Clone, Copy)]
enum Role {
    Coil,
    Contact,
    WrittenOtherwise,
}

impl Uses {
    fn list(&mut self, role: Role) -> &mut Vec<Place> {
        match role {
            Role::Coil => &mut self.coils,
            Role::Contact => &mut self.contacts,
            Role::WrittenOtherwise => &mut self.written_otherwise,
        }
    }

    /// Whether anything writes it.
    pub(crate) fn is_written(&self) -> bool {
        !self.coils.is_empty() || !self.written_otherwise.is_empty()
    }

    /// Whether a coil or a contact of a rung names it.
    pub(super) fn stands_in(&self, rung: (usize, usize)) -> bool {
        let is_there = |all: &[Place]| all.binary_search_by_key(&rung, Place::rung).is_ok();
        is_there(&self.coils) || is_there(&self.contacts)
    }

    fn is_empty(&self) -> bool {
        !self.is_written() && self.contacts.is_empty()
    }

    fn key(&self, name: &str, declarations: &Declarations) -> Option<Key> {
        if let Some(first) = self.coils.first() {
            return Some(Key::Written(*first));
        }
        let first = self.contacts.first()?;
        let declared = declarations.place(name).unwrap_or(usize::MAX);
        Some(Key::Read(declared, *first))
    }

    /// The uses of the same name when those in one rung are `here`.
    fn with_rung(&self, rung: (usize, usize), here: Self) -> Self {
        let replaced = |all: &[Place], here: Vec<Place>| {
            let start = all.partition_point(|place| place.rung() < rung);
            let end = all.partition_point(|place| place.rung() <= rung);
            [&all[..start], &here, &all[end..]].concat()
        };
        Self {
            coils: replaced(&self.coils, here.coils),
            contacts: replaced(&self.contacts, here.contacts),
            written_otherwise: replaced(&self.written_otherwise, here.written_otherwise),
        }
    }
}

/// Tells every name in a network, in the order of its elements.
fn note(routine: usize, rung: usize, network: &Network, mut tell: impl FnMut(&Name, Place, Role)) {
    for (at, element) in network.elements() {
        let place = Place {
            routine,
            rung,
            element: at.index(),
        };
        match &element.kind {
            ElementKind::Coil(coil) => tell(&coil.operand.name, place, Role::Coil),
            ElementKind::Contact(contact) => tell(&contact.operand.name, place, Role::Contact),
            other => {
                for operand in other.writes() {
                    tell(&operand.name, place, Role::WrittenOtherwise);
                }
            }
        }
    }
}

fn address(name: &Name, declarations: &Declarations) -> Option<Name> {
    if name.starts_with('%') {
        return Some(name.clone());
    }
    declarations.find(name)?.address.clone()
}

/// Whether something beyond the program gives the name its value, as its address
/// or its declaration says; constants count too.
fn comes_from_outside(name: &str, declarations: &Declarations) -> bool {
    let address =
        |text: &str| text.starts_with("%I") || text.contains(":I.") || text.contains(":I:");
    if address(name)
        || crate::registers::is_first_scan(name)
        || matches!(name, "0" | "1" | "TRUE" | "FALSE")
    {
        return true;
    }
    let root = name.split(['.', '[']).next().unwrap_or(name);
    [name, root].iter().any(|name| {
        declarations.find(name).is_some_and(|declaration| {
            matches!(
                declaration.class,
                Class::Input | Class::InOut | Class::Constant
            ) || declaration.address.as_deref().is_some_and(address)
        })
    })
}

/// Compares texts with the numbers in them by value: `%I2` before `%I10`.
pub(crate) fn natural(a: &str, b: &str) -> Ordering {
    pieces(a).cmp(pieces(b))
}

/// Runs of digits by value, other characters one by one.
fn pieces(text: &str) -> impl Iterator<Item = (u64, char)> + '_ {
    let mut rest = text.chars().peekable();
    std::iter::from_fn(move || {
        let first = rest.next()?;
        let Some(mut value) = first.to_digit(10).map(u64::from) else {
            return Some((0, first));
        };
        while let Some(digit) = rest.peek().and_then(|c| c.to_digit(10)) {
            value = value.saturating_mul(10).saturating_add(u64::from(digit));
            rest.next();
        }
        Some((value, '0'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_addresses_count_by_value() {
        let mut addresses = ["%I10", "%I2", "%I1.10", "%I1.9", "%I1"];
        addresses.sort_by(|a, b| natural(a, b));
        assert_eq!(addresses, ["%I1", "%I1.9", "%I1.10", "%I2", "%I10"]);
    }
}
