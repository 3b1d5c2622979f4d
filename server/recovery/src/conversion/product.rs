//! The product form: every memory a partial grafcet of two steps.

use grafcet::{Chart, Step, Transition};
use logic::{AtomId, Expr, Function, Name};

use super::forms::{Form, Forms};
use super::naming::Names;
use super::wording::Wording;
use crate::Analysis;

/// A variable that keeps its value, with its two steps.
pub(super) struct Memory {
    pub(super) variable: Name,
    pub(super) atom: AtomId,
    off: Name,
    on: Name,
    /// Whether it is on before the first scan.
    is_on: bool,
    turns_on: Function,
    deactivation: Function,
}

/// The memories that no accepted succession ties to a sequence and that are
/// said by two steps, with their steps named.
pub(super) fn memories(
    analysis: &Analysis,
    forms: &Forms<'_>,
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Vec<Memory> {
    let stored = |atom| analysis.states().stored.iter().any(|it| it.atom == atom);
    let mut found = Vec::new();
    for variable in super::actions::own_variables(analysis) {
        let next = match forms.of(variable.atom) {
            Some(Form::Steps(next)) => next.clone(),
            Some(Form::Rough) if !stored(variable.atom) => match wording.resolved(variable) {
                Some(next) if next.depends_on(variable.atom) => next,
                _ => continue,
            },
            _ => continue,
        };
        let memory = Memory {
            variable: variable.name.clone(),
            off: names.step(&format!("{}_off", variable.name)),
            on: names.step(&format!("X{}", variable.name)),
            is_on: forms.seen.is_initial(variable.atom),
            turns_on: next.restrict(variable.atom, false),
            deactivation: next.restrict(variable.atom, true).not(),
            atom: variable.atom,
        };
        wording.stands_for(variable.atom, memory.on.clone());
        found.push(memory);
    }
    found
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
            initial: !memory.is_on,
            ..Step::new(memory.off.clone())
        });
        chart.steps.push(Step {
            initial: memory.is_on,
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

/// Two steps that follow a variable one scan late: what rungs see that stand
/// above those that write it.
pub(super) struct Follower {
    variable: Name,
    off: Name,
    on: Name,
}

/// The followers of all variables whose last value actions read, with their
/// steps named.
pub(super) fn followers(
    analysis: &Analysis,
    forms: &Forms<'_>,
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Vec<Follower> {
    let mut found = Vec::new();
    for &atom in &forms.followed {
        let (Some(variable), Some(before)) =
            (analysis.conditions.variable(atom), forms.seen.before(atom))
        else {
            continue;
        };
        let follower = Follower {
            off: names.step(&format!("{}_was_off", variable.name)),
            on: names.step(&format!("X{}_was", variable.name)),
            variable: variable.name.clone(),
        };
        wording.stands_for(before, follower.on.clone());
        found.push(follower);
    }
    found
}

/// Draws the followers. Their receptivities read the variable as the last scan
/// has published it.
pub(super) fn draw_followers(followers: &[Follower], names: &mut Names, chart: &mut Chart) {
    for follower in followers {
        let (off, on) = (&follower.off, &follower.on);
        chart.steps.push(Step {
            initial: true,
            ..Step::new(off.clone())
        });
        let comment = format!(
            "{} as the last scan left it: rungs above its own see that",
            follower.variable
        );
        chart.steps.push(Step {
            comment: Some(comment.into()),
            ..Step::new(on.clone())
        });
        let followed = Expr::variable(follower.variable.clone());
        for (word, from, to, receptivity) in [
            ("starts", off, on, followed.clone()),
            ("ends", on, off, followed.complement()),
        ] {
            let name = names.transition(&format!("{}_was_{word}", follower.variable));
            chart
                .transitions
                .push(Transition::new(name, from.clone(), to.clone(), receptivity));
        }
    }
}
