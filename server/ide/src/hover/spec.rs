//! The thing under the pointer in a spec.

use grafcet::{Mention, Places, Role, Step, Transition, action_text};
use logic::{Budget, Name};
use source::Span;

use super::ladder::of_variable;
use super::{Block, Hover, coil};
use crate::{Ladder, Spec, Term};

/// What is known of the thing at the byte `offset` of a spec: a step, a
/// transition, a variable, a state of its ladder.
pub fn hover_in_spec(
    spec: &Spec,
    ladder: Option<&Ladder>,
    offset: usize,
    budget: &Budget,
) -> Option<Hover> {
    let places = &spec.reading.places;
    let Some(mention) = places.mention_at(offset) else {
        return of_rule_at(spec, places, offset);
    };
    match mention.role {
        Role::Step => of_step(spec, ladder, mention, budget),
        Role::Transition => of_transition(spec, &mention.name, mention.span),
        Role::State => of_state(spec, ladder?, &mention.name, mention.span, budget),
        Role::Variable | Role::Parameter => of_value(spec, ladder, mention, budget),
        Role::Rule => of_rule_at(spec, places, offset),
        Role::Grafcet | Role::Part | Role::Instance => None,
    }
}

fn of_rule_at(spec: &Spec, places: &Places, offset: usize) -> Option<Hover> {
    let rule = places.rules.iter().find(|rule| rule.span.touches(offset))?;
    match rule.role {
        Role::Transition => of_transition(spec, &rule.name, rule.span),
        _ => None,
    }
}

pub(super) fn of_step(
    spec: &Spec,
    ladder: Option<&Ladder>,
    mention: &Mention,
    budget: &Budget,
) -> Option<Hover> {
    let grafcet = &spec.reading.spec.grafcet;
    let step: &Step = grafcet.steps().find(|step| step.name == mention.name)?;
    let mut summary = match (&step.state, step.initial) {
        (Some(state), true) => format!("initial step for {state}"),
        (Some(state), false) => format!("step for {state}"),
        (None, true) => "initial step that stands for no state of the ladder".to_owned(),
        (None, false) => "step that stands for no state of the ladder".to_owned(),
    };
    if let Some(comment) = &step.comment {
        summary = format!("{comment}: {summary}");
    }
    let mut blocks = vec![Block::Fields(around(spec, &step.name))];
    let mut terms = vec![Term::Step];
    if let (Some(ladder), Some(state)) = (ladder, &step.state)
        && let Some(state) = of_state(spec, ladder, state, mention.span, budget)
    {
        blocks.extend(state.blocks);
        terms.extend(state.terms);
    }
    Some(Hover {
        span: mention.span,
        name: step.name.to_string(),
        address: None,
        summary,
        blocks,
        terms,
    })
}

/// The transitions before and after a step, and what it does.
fn around(spec: &Spec, step: &Name) -> Vec<(&'static str, String)> {
    let grafcet = &spec.reading.spec.grafcet;
    let mut fields = Vec::new();
    for transition in grafcet.transitions().filter(|it| it.to.contains(step)) {
        fields.push(("begins by", ruled(transition)));
    }
    for transition in grafcet.transitions().filter(|it| it.from.contains(step)) {
        fields.push(("ends by", ruled(transition)));
    }
    for action in grafcet.actions().filter(|it| it.step == *step) {
        fields.push(("does", action_text(action)));
    }
    if fields.is_empty() {
        fields.push(("rules", "none speaks of it".to_owned()));
    }
    fields
}

fn ruled(transition: &Transition) -> String {
    format!(
        "{}: from {} to {} on {}",
        transition.name,
        listed(&transition.from),
        listed(&transition.to),
        transition.receptivity
    )
}

fn listed(names: &[Name]) -> String {
    match names {
        [] => "nothing".to_owned(),
        names => names.join(" and "),
    }
}

fn of_transition(spec: &Spec, name: &Name, span: Span) -> Option<Hover> {
    let grafcet = &spec.reading.spec.grafcet;
    let transition = grafcet.transitions().find(|it| it.name == *name)?;
    let mut fields = vec![
        ("from", listed(&transition.from)),
        ("to", listed(&transition.to)),
        ("on", transition.receptivity.to_string()),
    ];
    if transition.from.len() > 1 {
        fields.push(("joins", "all steps before it end together".to_owned()));
    }
    if transition.to.len() > 1 {
        fields.push(("parts", "all steps after it begin together".to_owned()));
    }
    Some(Hover {
        span,
        name: name.to_string(),
        address: None,
        summary: match &transition.comment {
            Some(comment) => format!("{comment}: transition"),
            None => "transition".to_owned(),
        },
        blocks: vec![Block::Fields(fields)],
        terms: vec![Term::Transition],
    })
}

/// A state of the ladder: a coil, or a value of a register.
fn of_state(
    spec: &Spec,
    ladder: &Ladder,
    state: &Name,
    span: Span,
    budget: &Budget,
) -> Option<Hover> {
    if ladder.analysis.conditions.find(state).is_some() {
        return Some(of_variable(ladder, Some(spec), state, span, budget));
    }
    let summary = coil::value_summary(state, ladder)?;
    Some(Hover {
        span,
        name: state.to_string(),
        address: None,
        summary,
        blocks: vec![Block::Fields(coil::neighbours(
            state,
            ladder,
            Some(spec),
            budget,
        ))],
        terms: vec![Term::StepRegister, Term::Succession],
    })
}

pub(super) fn of_value(
    spec: &Spec,
    ladder: Option<&Ladder>,
    mention: &Mention,
    budget: &Budget,
) -> Option<Hover> {
    if let Some(ladder) = ladder
        && ladder.names().of(&mention.name).next().is_some()
    {
        return Some(of_variable(
            ladder,
            Some(spec),
            &mention.name,
            mention.span,
            budget,
        ));
    }
    let grafcet = &spec.reading.spec.grafcet;
    let variable = grafcet.variables().find(|it| it.name == mention.name)?;
    Some(Hover {
        span: mention.span,
        name: variable.name.to_string(),
        address: variable.address.as_deref().map(str::to_owned),
        summary: match &variable.comment {
            Some(comment) => format!("{comment}: variable of the spec"),
            None => "variable of the spec".to_owned(),
        },
        blocks: Vec::new(),
        terms: Vec::new(),
    })
}
