//! The product form: every memory a partial grafcet of two steps.

use grafcet::{Chart, Step, Transition};
use logic::{AtomId, Function, Name};

use super::decisions::Accepted;
use super::naming::Names;
use super::wording::Wording;
use crate::Analysis;
use crate::conditions::{Variable, WriteKind};

/// A variable that keeps its value, with its two steps.
pub(super) struct Memory {
    pub(super) variable: Name,
    pub(super) atom: AtomId,
    off: Name,
    on: Name,
    turns_on: Function,
    deactivation: Function,
}

/// The memories that no accepted succession ties to a sequence, with their
/// steps named.
pub(super) fn memories(
    analysis: &Analysis,
    accepted: &Accepted,
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Vec<Memory> {
    let members = accepted.members();
    let stored = |atom| analysis.states().stored.iter().any(|it| it.atom == atom);
    let mut found = Vec::new();
    for variable in super::actions::own_variables(analysis) {
        if members.contains(&variable.atom) || stored(variable.atom) || !is_coil(variable) {
            continue;
        }
        let Some(next) = wording.resolved(variable) else {
            continue;
        };
        if !next.depends_on(variable.atom) {
            continue;
        }
        let memory = Memory {
            variable: variable.name.clone(),
            atom: variable.atom,
            off: names.step(&format!("{}_off", variable.name)),
            on: names.step(&format!("X{}", variable.name)),
            turns_on: next.restrict(variable.atom, false),
            deactivation: next.restrict(variable.atom, true).not(),
        };
        wording.stands_for(variable.atom, memory.on.clone());
        found.push(memory);
    }
    found
}

fn is_coil(variable: &Variable) -> bool {
    variable
        .writes
        .iter()
        .any(|write| matches!(write.kind, WriteKind::Coil(_)))
}

/// Draws the memories. A change that can never happen has no transition.
pub(super) fn draw(
    memories: &[Memory],
    analysis: &Analysis,
    names: &mut Names,
    wording: &Wording<'_>,
    chart: &mut Chart,
) {
    for memory in memories {
        chart.steps.push(Step {
            initial: true,
            ..Step::new(memory.off.clone())
        });
        chart.steps.push(Step {
            state: Some(memory.variable.clone()),
            comment: analysis.description(&memory.variable),
            ..Step::new(memory.on.clone())
        });
        let (off, on) = (&memory.off, &memory.on);
        for (word, from, to, condition) in [
            ("starts", off, on, &memory.turns_on),
            ("ends", on, off, &memory.deactivation),
        ] {
            if condition.is_false() {
                continue;
            }
            let name = names.transition(&format!("{}_{word}", memory.variable));
            let receptivity = wording.say_or_name(condition, &name);
            chart
                .transitions
                .push(Transition::new(name, from.clone(), to.clone(), receptivity));
        }
    }
}
