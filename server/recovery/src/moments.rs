//! Where a condition takes several values of one variable for one.
//!
//! The conditions of a variable are said over what contacts see, by name. If a
//! coil between two of the contacts writes what both look at, they see
//! different values in a scan in which that changes: the condition is true of
//! every scan in which it does not. Whoever shows a condition says so.

use std::collections::BTreeMap;

use logic::{Expr, Function, Name};

use crate::Analysis;
use crate::conditions::{Variable, Write, WriteKind};
use crate::order::{Order, Place, Rung, names_in};

/// A variable that a condition takes to be at rest: it is written between the
/// contacts that lead to the coil.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AtRest {
    /// The variable.
    pub name: Name,
    /// The first rung that writes it in between, by its routine and its place
    /// there; none if that is not known, since rungs are solved several times
    /// in a scan.
    pub written: Option<Rung>,
}

impl Analysis {
    /// What the conditions of `variable` take to be at rest though rungs write
    /// it between those that read it, in the order of the names.
    pub fn at_rest(&self, variable: &Variable) -> Vec<AtRest> {
        if !self.may_see_several_moments(variable) {
            return Vec::new();
        }
        let order = self.order();
        let mut readings: BTreeMap<Name, Vec<Option<Place>>> = BTreeMap::new();
        for write in &variable.writes {
            let reader = match order.of(write.place.rung(), write.place.element) {
                Some(Ok(rank)) => {
                    Some(order.reader((rank, write.place.element), write.place.rung()))
                }
                Some(Err(())) => None,
                None => continue,
            };
            // What a coil sees of its own variable its condition says.
            for name in self.names_at(write).filter(|it| *it != variable.name) {
                let places = match &reader {
                    Some(reader) => order
                        .readings(&name, reader)
                        .into_iter()
                        .map(Some)
                        .collect(),
                    None => vec![None],
                };
                readings.entry(name).or_default().extend(places);
            }
        }
        let all = readings.into_iter();
        all.filter_map(|(name, readings)| at_rest(name, readings, order))
            .collect()
    }

    /// One rung that is always solved tells itself what its contacts see.
    fn may_see_several_moments(&self, variable: &Variable) -> bool {
        match &variable.writes[..] {
            [write] => !(is_always(&write.solved) && is_always(&write.zone)),
            writes => writes.len() > 1,
        }
    }

    /// The variables in what decides a write.
    fn names_at(&self, write: &Write) -> impl Iterator<Item = Name> {
        let deciding = [&write.guard, &write.solved, &write.zone];
        let copied = match write.kind {
            WriteKind::BitOf(source) => Some(source),
            _ => None,
        };
        let atoms = deciding.into_iter().flatten();
        let atoms = atoms.flat_map(|it| it.support().iter().copied());
        atoms.chain(copied).flat_map(|atom| {
            let atom = self.conditions.atoms.atom(atom).clone();
            names_in(&Expr::Atom(atom))
        })
    }
}

fn is_always(condition: &Result<Function, logic::Stop>) -> bool {
    condition.as_ref().is_ok_and(Function::is_true)
}

/// A variable that is read at several moments, and written between them.
fn at_rest(name: Name, readings: Vec<Option<Place>>, order: &Order) -> Option<AtRest> {
    let readings: Option<Vec<Place>> = readings.into_iter().collect();
    let written = match (readings, order.writings(&name)) {
        (Some(readings), Ok(places)) => {
            let between = readings.iter().min()?..readings.iter().max()?;
            let first = places.iter().filter(|at| between.contains(at)).min()?;
            Some(order.rung(*first)?)
        }
        (Some(readings), Err(())) if readings.iter().all(|at| *at == readings[0]) => return None,
        (None, Ok(places)) if places.is_empty() => return None,
        _ => None,
    };
    Some(AtRest { name, written })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use logic::Budget;

    /// What the conditions of `v` suppose to rest, each with the rung that
    /// writes it.
    fn supposed(rungs: &str) -> Vec<String> {
        let text = format!("program P\n\n{rungs}");
        let program = Arc::new(ladder::read(text.as_bytes()).program);
        let analysis = crate::analyse(&program, &Budget::default());
        let variable = analysis.conditions.find("v").expect("a coil drives it");
        let all = analysis.at_rest(variable).into_iter();
        all.map(|it| match it.written {
            Some((_, rung)) => format!("{}, written by rung {rung}", it.name),
            None => format!("{}, nobody knows where", it.name),
        })
        .collect()
    }

    #[test]
    fn rungs_that_write_one_variable_see_another_before_and_after_it_is_written() {
        assert_eq!(
            supposed("rung: w -> set v\nrung: a -> w\nrung: /w -> set v\n"),
            ["w, written by rung 1"]
        );
    }

    #[test]
    fn what_is_written_before_or_after_all_that_read_it_is_one_value() {
        let none: [String; 0] = [];
        assert_eq!(
            supposed("rung: a -> w\nrung: w -> set v\nrung: /w -> reset v\n"),
            none
        );
        assert_eq!(
            supposed("rung: w -> set v\nrung: /w -> reset v\nrung: a -> w\n"),
            none
        );
    }

    #[test]
    fn one_rung_says_what_its_own_contacts_see() {
        let none: [String; 0] = [];
        assert_eq!(supposed("rung: a*/w -> w, (w*b -> v)\n"), none);
    }

    #[test]
    fn a_zone_is_seen_where_it_begins() {
        assert_eq!(
            supposed("rung: w -> MCR()\nrung: a -> w\nrung: /w -> v\nrung: 1 -> MCR()\n"),
            ["w, written by rung 1"]
        );
    }
}
