//! From the writes of a variable to its next value.

use std::collections::BTreeMap;
use std::sync::Arc;

use ladder::CoilKind;
use logic::{Atom, AtomId, Budget, Function, Stop};

use super::{Conditions, Variable, Variables, Walk, Write, WriteKind};

/// One variable for every target of `writes`, which stand in the order of the
/// scan, and how many of them were folded. Those whose writes are what they
/// were in `earlier` are kept.
pub(super) fn variables(
    writes: Vec<Write>,
    earlier: Option<&Conditions>,
    walk: &mut Walk<'_>,
) -> (Variables, usize) {
    let mut by_target: BTreeMap<AtomId, Vec<Write>> = BTreeMap::new();
    for write in writes {
        by_target.entry(write.target).or_default().push(write);
    }
    let mut folded = 0;
    let variables = by_target.into_iter().filter_map(|(atom, writes)| {
        let was = earlier.and_then(|earlier| earlier.kept(atom));
        let after = variable_after(atom, writes, was, walk)?;
        folded += usize::from(after.is_anew);
        Some(after.variable)
    });
    (variables.collect(), folded)
}

/// A variable after an edit.
pub(super) struct After {
    pub(super) variable: Arc<Variable>,
    /// Whether its writes were folded.
    pub(super) is_anew: bool,
}

/// The variable of `writes`, which stand in the order of the scan; that of
/// `was` if it is written as it was. `None` if no coil writes it.
pub(super) fn variable_after(
    atom: AtomId,
    writes: Vec<Write>,
    was: Option<&Arc<Variable>>,
    walk: &mut Walk<'_>,
) -> Option<After> {
    if !writes.iter().any(is_coil_or_copy) {
        return None;
    }
    let kept = was.and_then(|was| kept(was, &writes));
    Some(After {
        is_anew: kept.is_none(),
        variable: kept.unwrap_or_else(|| variable(atom, writes, walk).into()),
    })
}

/// The variable as it was, if it is written as it was, though perhaps in rungs
/// that have moved.
fn kept(was: &Arc<Variable>, writes: &[Write]) -> Option<Arc<Variable>> {
    if was.writes == writes {
        return Some(Arc::clone(was));
    }
    // Which writes share a rung matters, and so does nothing else of a place.
    let alike = was.writes.len() == writes.len()
        && was
            .writes
            .iter()
            .zip(writes)
            .all(|(was, is)| is.moved_to(was.place) == *was)
        && stretches(&was.writes) == stretches(writes);
    alike.then(|| {
        Arc::new(Variable {
            writes: writes.to_vec(),
            ..(**was).clone()
        })
    })
}

/// How many writes follow each other in one rung, rung by rung.
fn stretches(writes: &[Write]) -> Vec<usize> {
    let same = |a: &Write, b: &Write| a.place.rung() == b.place.rung();
    writes.chunk_by(same).map(<[Write]>::len).collect()
}

/// A word that is only moved about has no conditions of its own; its bits do
/// when a coil writes them, or when they are copies of bits that coils write.
fn is_coil_or_copy(write: &Write) -> bool {
    matches!(write.kind, WriteKind::Coil(_) | WriteKind::BitOf(_))
}

fn variable(atom: AtomId, writes: Vec<Write>, walk: &mut Walk<'_>) -> Variable {
    let next = next_value(atom, &writes, Skipping::Keeps, walk.budget);
    let holds = |next: &Result<Function, Stop>| {
        next.as_ref()
            .is_ok_and(|function| function.depends_on(atom))
    };
    let is_skipped = |write: &Write| write.solved.as_ref().is_ok_and(|it| !it.is_true());
    let kept_when_skipped = holds(&next)
        && writes.iter().any(is_skipped)
        && !holds(&next_value(atom, &writes, Skipping::Never, walk.budget));
    let closed_contacts = writes
        .iter()
        .flat_map(|write| write.closed_contacts.iter().copied())
        .filter(|other| *other != atom)
        .collect::<std::collections::BTreeSet<_>>();
    Variable {
        name: match walk.atoms.atom(atom) {
            Atom::Variable(name) => name.clone(),
            other => other.to_string().into(),
        },
        atom,
        kept_when_skipped,
        grows: next
            .as_ref()
            .ok()
            .filter(|it| it.depends_on(atom))
            .and_then(|it| it.grows_in(atom, walk.budget).ok()),
        closed_contacts: closed_contacts.into_iter().collect(),
        next,
        writes,
    }
}

/// Whether rungs may be skipped.
#[derive(Clone, Copy, PartialEq)]
enum Skipping {
    /// A skipped rung keeps what is there.
    Keeps,
    /// Every rung is taken to be solved.
    Never,
}

/// Stands for a variable as it was at the start of the scan, in a condition in
/// which the variable's own atom is what it was before the rung. No table gives
/// this number to an atom.
pub(crate) const AT_START: AtomId = AtomId(0);

/// The variable as it was at the start of the scan, in the guard of one that
/// its rung writes several times.
pub(super) fn at_start() -> Function {
    Function::atom(AT_START)
}

/// The value of `atom` after these writes, over what it was before them.
pub(crate) fn value_after(
    atom: AtomId,
    writes: &[Write],
    budget: &Budget,
) -> Result<Function, Stop> {
    next_value(atom, writes, Skipping::Keeps, budget)
}

/// The value of `atom` after the scan: its writes, one after the other.
fn next_value(
    atom: AtomId,
    writes: &[Write],
    skipping: Skipping,
    budget: &Budget,
) -> Result<Function, Stop> {
    let before_scan = Function::atom(atom);
    let mut value = before_scan.clone();
    let mut before_rung = value.clone();
    let mut rung = None;
    for write in writes {
        let here = write.place.rung();
        if rung != Some(here) {
            rung = Some(here);
            before_rung = value.clone();
        }
        let guard = write.effective.as_ref().unwrap_or(&write.guard);
        let guard = guard.clone()?.substitute(atom, &before_rung, budget)?;
        let guard = guard.substitute(AT_START, &before_scan, budget)?;
        let written = apply(&write.kind, &guard, &write.zone.clone()?, &value, budget)?;
        value = match skipping {
            Skipping::Never => written,
            Skipping::Keeps => {
                let solved = write.solved.clone()?;
                written
                    .and(&solved, budget)?
                    .or(&value.and_not(&solved, budget)?, budget)?
            }
        };
    }
    Ok(value)
}

/// The value after one write that is solved.
pub(super) fn apply(
    kind: &WriteKind,
    guard: &Function,
    zone: &Function,
    value: &Function,
    budget: &Budget,
) -> Result<Function, Stop> {
    let chosen = |new: &Function| {
        guard
            .and(new, budget)?
            .or(&value.and_not(guard, budget)?, budget)
    };
    match kind {
        // In an unpowered zone power never arrives, so that a negated coil
        // is written 1 there.
        WriteKind::Coil(CoilKind::Negated) => Ok(guard.and(zone, budget)?.not()),
        // The edge of the power is an atom that `collect` put in the guard.
        WriteKind::Coil(CoilKind::Plain | CoilKind::Rising | CoilKind::Falling) => {
            guard.and(zone, budget)
        }
        WriteKind::Coil(CoilKind::Set) => value.or(&guard.and(zone, budget)?, budget),
        WriteKind::Coil(CoilKind::Reset) => value.and_not(&guard.and(zone, budget)?, budget),
        WriteKind::Bit(true) => value.or(&guard.and(zone, budget)?, budget),
        WriteKind::Bit(false) => value.and_not(&guard.and(zone, budget)?, budget),
        WriteKind::BitOf(source) | WriteKind::Unknown(source) => chosen(&Function::atom(*source)),
    }
}

#[cfg(test)]
mod tests {
    use logic::{Budget, notation};

    use crate::conditions::conditions;

    /// The value of `q` after a scan of one rung.
    fn next(rung: &str) -> String {
        next_of("q", rung)
    }

    /// The value of a variable after a scan of one rung.
    fn next_of(name: &str, rung: &str) -> String {
        let program = ladder::read(format!("program P\n\nrung: {rung}\n").as_bytes()).program;
        let budget = Budget::default();
        let conditions = conditions(&program, &budget);
        let variable = conditions.find(name).expect("a coil drives it");
        let next = variable.next.as_ref().expect("a small condition");
        notation::write(&conditions.expr(next, &budget).expect("a small sum"))
    }

    #[test]
    fn a_leg_sees_what_the_legs_above_it_have_written() {
        assert_eq!(next("a -> q, (b*/q -> set q)"), "a");
        assert_eq!(next("a -> set q, (b*q -> reset q)"), "q*/a + a*/b");
    }

    #[test]
    fn where_contacts_see_a_coil_before_and_after_the_condition_is_that_before_the_rung() {
        // With `q` off the rung switches it on, and the leg sees that.
        assert_eq!(next_of("p", "/q -> q, (q*c -> p)"), "/q*c");
        assert_eq!(next_of("p", "a*/q -> set q, (b*q -> p)"), "/q*a*b");
        // Where all that lead to the coil see the same, they are spoken of as
        // they see it.
        assert_eq!(next_of("p", "a -> q, (q*c -> p)"), "q*a*c");
    }

    #[test]
    fn a_zone_was_switched_by_what_was_there_before_the_rung() {
        // What the second leg sees is `b` in the zone that the first rung's `q`
        // has switched on, whatever `a` has made of it since.
        let rungs = "q -> MCR()\nrung: a -> q\nrung: b -> q, (c*q -> reset q)\nrung: 1 -> MCR()";
        assert_eq!(next(rungs), "q*b*/c");
    }

    #[test]
    fn a_contact_before_the_first_leg_and_one_behind_it_see_different_values() {
        assert_eq!(next("/q -> set q, (q -> reset q)"), "q");
        assert_eq!(
            next("q -> reset q, (a*/q -> set q), (b*q -> reset q)"),
            "q*a*/b"
        );
    }
}
