//! What the steps do: the outputs of a ladder as actions.

use grafcet::{Action, Chart, Effect, Step};
use logic::{AtomId, Expr, Function, Name};

use super::forms::{Form, Forms};
use super::naming::Names;
use super::product::Product;
use super::sequence::Plan;
use super::wording::Wording;
use crate::Analysis;
use crate::conditions::Variable;
use crate::states::StoredOutput;

/// The variables that belong to the program itself. Those of a block's
/// definition belong to its instances; they count only in a file that holds
/// nothing but definitions.
pub(super) fn own_variables(analysis: &Analysis) -> impl Iterator<Item = &Variable> {
    let all_defined = analysis.program.is_only_definitions();
    analysis
        .conditions
        .variables
        .iter()
        .map(|variable| &**variable)
        .filter(move |variable| all_defined || !analysis.is_in_definition(variable))
}

/// Adds the actions of all outputs to `chart`.
pub(super) fn add(
    analysis: &Analysis,
    sequences: &[Plan],
    product: &Product<'_>,
    names: &mut Names,
    wording: &Wording<'_>,
    chart: &mut Chart,
) {
    let mut actions = Actions {
        analysis,
        forms: product.forms,
        sequences,
        wording,
        names,
        chart,
        always: None,
    };
    let mut conditional = Vec::new();
    for variable in own_variables(analysis) {
        let atom = variable.atom;
        let mut stored = analysis.states().stored.iter();
        let is_exact = matches!(
            product.forms.of(atom),
            Some(Form::Steps(_) | Form::Action(_))
        );
        if let Some(stored) = stored.find(|it| it.atom == atom && !is_exact) {
            actions.add_stored(stored);
        } else if !wording.steps_of(atom).is_empty() {
            actions.add_state(variable);
        } else {
            conditional.push(variable);
        }
    }
    for variable in conditional {
        actions.add_conditional(variable);
    }
    if let Some(first) = &product.first {
        let always = actions.always();
        first.draw(always, actions.names, actions.chart);
    }
}

/// A chart whose steps are drawn, and what it takes to add their actions.
struct Actions<'a> {
    analysis: &'a Analysis,
    forms: &'a Forms,
    sequences: &'a [Plan],
    wording: &'a Wording<'a>,
    names: &'a mut Names,
    chart: &'a mut Chart,
    /// The step that is always active, once an action needs it.
    always: Option<Name>,
}

impl Actions<'_> {
    /// An output that some steps set and others reset.
    fn add_stored(&mut self, stored: &StoredOutput) {
        for (effect, function) in [(Effect::Set, &stored.set), (Effect::Reset, &stored.reset)] {
            for (step, condition) in shares(function, self.sequences, self.wording) {
                self.chart.actions.push(Action {
                    condition,
                    ..Action::stored(step, effect.clone(), stored.name.clone())
                });
            }
        }
    }

    /// The bit of a state is its step; it is written only if it is an output or
    /// somebody reads what it was.
    fn add_state(&mut self, variable: &Variable) {
        if !self.analysis.is_output(variable) && !self.forms.followed.contains(&variable.atom) {
            return;
        }
        for step in self.wording.steps_of(variable.atom) {
            let action = Action::continuous(step.clone(), variable.name.clone());
            self.chart.actions.push(action);
        }
    }

    /// A rung that holds nothing: a continuous action on the steps where its
    /// guard can be true, or of the step that is always active.
    fn add_conditional(&mut self, variable: &Variable) {
        let forms = self.forms;
        let next = match forms.of(variable.atom) {
            // A transition bit that is resolved wherever it is read is not there.
            Some(_) if !forms.read.contains(&variable.atom) => None,
            Some(Form::Action(next)) => Some(next.clone()),
            // A state to which nothing accepted leads has no step.
            None if !forms.is_member(variable.atom) => None,
            _ => self.wording.resolved(variable),
        };
        let Some(next) = next else {
            return;
        };
        let on_steps = shares(&next, self.sequences, self.wording);
        if !on_steps.is_empty() {
            for (step, condition) in on_steps {
                self.chart.actions.push(Action {
                    condition,
                    ..Action::continuous(step, variable.name.clone())
                });
            }
            return;
        }
        let Some(condition) = self.wording.say(&next) else {
            return;
        };
        if condition == Expr::Constant(false) {
            return;
        }
        let step = self.always();
        self.chart.actions.push(Action {
            condition: (condition != Expr::Constant(true)).then_some(condition),
            ..Action::continuous(step, variable.name.clone())
        });
    }

    /// The step that is always active, drawn when first needed.
    fn always(&mut self) -> Name {
        if let Some(always) = &self.always {
            return always.clone();
        }
        let name = self.names.step("Always");
        self.chart.steps.push(Step {
            initial: true,
            comment: Some("never left: carries what depends on no step".into()),
            ..Step::new(name.clone())
        });
        self.always = Some(name.clone());
        name
    }
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
