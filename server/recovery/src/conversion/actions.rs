//! What the steps do: the outputs of a ladder as actions.

use grafcet::{Action, Chart, Effect, Step};
use logic::{AtomId, Expr, Function, Name};

use super::naming::Names;
use super::product::Memory;
use super::sequence::Plan;
use super::wording::Wording;
use crate::Analysis;
use crate::conditions::{Variable, WriteKind};

/// The variables that belong to the program itself. Those of a block's
/// definition belong to its instances; they count only in a file that holds
/// nothing but definitions.
pub(super) fn own_variables(analysis: &Analysis) -> impl Iterator<Item = &Variable> {
    let all_defined = analysis
        .conditions
        .variables
        .iter()
        .all(|variable| analysis.is_in_definition(variable));
    analysis
        .conditions
        .variables
        .iter()
        .filter(move |variable| all_defined || !analysis.is_in_definition(variable))
}

/// Adds the actions of all outputs to `chart`.
pub(super) fn add(
    analysis: &Analysis,
    sequences: &[Plan],
    memories: &[Memory],
    names: &mut Names,
    wording: &Wording<'_>,
    chart: &mut Chart,
) {
    let mut conditional = Vec::new();
    for variable in own_variables(analysis) {
        let atom = variable.atom;
        if let Some(stored) = analysis.states.stored.iter().find(|it| it.atom == atom) {
            for (effect, function) in [(Effect::Set, &stored.set), (Effect::Reset, &stored.reset)] {
                for (step, condition) in shares(function, sequences, wording) {
                    chart.actions.push(Action {
                        condition,
                        ..Action::stored(step, effect.clone(), variable.name.clone())
                    });
                }
            }
            continue;
        }
        let is_memory = memories.iter().any(|memory| memory.atom == atom);
        if is_memory || !wording.steps_of(atom).is_empty() {
            // A memory's bit is its step; the plant sees it only if it is an
            // output.
            if analysis.is_output(variable) {
                for step in wording.steps_of(atom) {
                    let action = Action::continuous(step.clone(), variable.name.clone());
                    chart.actions.push(action);
                }
            }
            continue;
        }
        conditional.push(variable);
    }
    let mut always = None;
    for variable in conditional {
        add_conditional(
            variable,
            analysis,
            sequences,
            names,
            wording,
            chart,
            &mut always,
        );
    }
}

/// A rung that holds nothing: a continuous action on the steps where its guard
/// can be true, or of the step that is always active.
#[allow(clippy::too_many_arguments)]
fn add_conditional(
    variable: &Variable,
    analysis: &Analysis,
    sequences: &[Plan],
    names: &mut Names,
    wording: &Wording<'_>,
    chart: &mut Chart,
    always: &mut Option<Name>,
) {
    let is_coil = variable
        .writes
        .iter()
        .any(|write| matches!(write.kind, WriteKind::Coil(_)));
    // A transition bit is resolved wherever it is read.
    let is_resolved =
        analysis.states.auxiliaries.contains(variable.atom) && !analysis.is_output(variable);
    if !is_coil || is_resolved {
        return;
    }
    let Some(next) = wording.resolved(variable) else {
        return;
    };
    let on_steps = shares(&next, sequences, wording);
    if !on_steps.is_empty() {
        for (step, condition) in on_steps {
            chart.actions.push(Action {
                condition,
                ..Action::continuous(step, variable.name.clone())
            });
        }
        return;
    }
    let Some(condition) = wording.say(&next) else {
        return;
    };
    if condition == Expr::Constant(false) {
        return;
    }
    let step = always.get_or_insert_with(|| {
        let name = names.step("Always");
        chart.steps.push(Step {
            initial: true,
            comment: Some("never left: carries what depends on no step".into()),
            ..Step::new(name.clone())
        });
        name
    });
    chart.actions.push(Action {
        condition: (condition != Expr::Constant(true)).then_some(condition),
        ..Action::continuous(step.clone(), variable.name.clone())
    });
}

/// `function` shared out among the steps without which it is false: each with
/// the condition that remains while the step is active. Empty if it can be
/// true without any.
fn shares(
    function: &Function,
    sequences: &[Plan],
    wording: &Wording<'_>,
) -> Vec<(Name, Option<Expr>)> {
    let mut shares = Vec::new();
    let states: Vec<AtomId> = function
        .support()
        .iter()
        .copied()
        .filter(|atom| !wording.steps_of(*atom).is_empty())
        .collect();
    let without = states.iter().fold(function.clone(), |function, state| {
        function.restrict(*state, false)
    });
    if states.is_empty() || !without.is_false() {
        return wording.shares_of_register(function);
    }
    for &state in &states {
        // With a sequence's other steps inactive, unless some run at once.
        let alone = sequences
            .iter()
            .find(|plan| plan.holds(state))
            .filter(|plan| !plan.forks);
        let mut here = function.restrict(state, true);
        for other in states.iter().filter(|other| **other != state) {
            if alone.is_some_and(|plan| plan.holds(*other)) {
                here = here.restrict(*other, false);
            }
        }
        if here.is_false() {
            continue;
        }
        let Some(condition) = wording.say(&here) else {
            return Vec::new();
        };
        let condition = (condition != Expr::Constant(true)).then_some(condition);
        for step in wording.steps_of(state) {
            shares.push((step.clone(), condition.clone()));
        }
    }
    shares
}
