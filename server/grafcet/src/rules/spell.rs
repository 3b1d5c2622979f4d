//! How each thing is written in a canonical text, a line at a time.

use std::collections::HashSet;

use logic::notation::{quoted, write, write_factor};
use logic::{Atom, Expr, Name};

use super::decisions::register_value;
use super::lists::is_plain_address;
use super::next_scan;
use super::words::is_reserved;
use crate::model::normal;
use crate::{
    Action, ActionKind, Effect, EnvironmentRule, Grafcet, Instance, Part, PartKind, Property,
    Situation, Step, StepKind, Transition, Trigger, Variable,
};

/// A name in a declaration or a rule: in quotes where it is not plain, or is a
/// word of the rule text.
pub(crate) fn name(name: &str) -> String {
    match is_reserved(name) {
        true => format!("\"{name}\""),
        false => quoted(name),
    }
}

fn names(list: &[Name], separator: &str) -> String {
    let names: Vec<String> = list.iter().map(|item| name(item)).collect();
    names.join(separator)
}

/// A state of the ladder: a register's value `Seq=10` stands without quotes.
pub(crate) fn state(state: &str) -> String {
    match register_value(state) {
        Some((register, value)) if name(&register) == *register => format!("{register}={value}"),
        _ => name(state),
    }
}

/// A line with its comment, if it has one that says something.
pub(crate) fn with_comment(line: String, comment: Option<&str>) -> String {
    match comment.map(comment_line).unwrap_or_default() {
        said if said.is_empty() => line,
        said => format!("{line}  // {said}"),
    }
}

/// A comment as it can stand on one line.
pub(crate) fn comment_line(comment: &str) -> String {
    let words: Vec<&str> = comment.split(['\r', '\n']).map(str::trim).collect();
    words.join(" ").trim().to_owned()
}

pub(crate) fn step(step: &Step) -> String {
    let mut text = name(&step.name);
    match &step.kind {
        StepKind::Plain => {}
        StepKind::Macro(expansion) => text += &format!("({})", name(expansion)),
        StepKind::Enclosing(parts) => text += &format!("({})", names(parts, ", ")),
    }
    if let Some(of) = &step.state {
        text += " for ";
        text += &state(of);
    }
    text
}

pub(crate) fn variable(variable: &Variable) -> String {
    let mut text = name(&variable.name);
    if let Some(address) = &variable.address {
        text.push(' ');
        match is_plain_address(address) {
            true => text += address,
            false => text += &in_quotes(address),
        }
    }
    text
}

fn in_quotes(text: &str) -> String {
    format!("\"{}\"", text.replace(['"', '\r', '\n'], "'"))
}

pub(crate) fn instance(instance: &Instance) -> String {
    let text = format!("{} of {}", name(&instance.name), name(&instance.of));
    match instance.arguments.is_empty() {
        true => text,
        false => format!("{text}({})", names(&instance.arguments, ", ")),
    }
}

pub(crate) fn part(part: &Part) -> String {
    let name_of = name(&part.name);
    match &part.kind {
        PartKind::Partial => format!("Partial {name_of}"),
        PartKind::Expansion { entry, exit } => {
            format!("Expansion {name_of}({}, {})", name(entry), name(exit))
        }
        PartKind::Reusable { parameters } if parameters.is_empty() => {
            format!("Reusable {name_of}")
        }
        PartKind::Reusable { parameters } => {
            format!("Reusable {name_of}({})", names(parameters, ", "))
        }
    }
}

/// A transition's rule as a line of the section `Transitions:` of a text that
/// holds `grafcet`.
pub fn transition_rule(it: &Transition, grafcet: &Grafcet) -> String {
    let steps = grafcet.steps().map(|step| step.name.clone()).collect();
    transition(it, &steps)
}

/// An action's rule as a line of the section `Steps:`.
pub fn action_rule(it: &Action) -> String {
    action(it)
}

/// A name as rule texts write it: in quotes where it is not plain, or is one of
/// their words.
pub fn spelled(it: &str) -> String {
    name(it)
}

/// A state of the ladder as rule texts write it: as other names, but the value
/// of a register `Seq=10` without quotes.
pub fn spelled_state(it: &str) -> String {
    state(it)
}

/// A transition's rule, where `steps` are the names of steps.
///
/// A receptivity that begins with a step's variable has it in parentheses,
/// since it would read as a step before the transition.
pub(crate) fn transition(transition: &Transition, steps: &HashSet<Name>) -> String {
    let receptivity = normal(&transition.receptivity);
    let mut left: Vec<String> = transition.from.iter().map(|step| name(step)).collect();
    let is_step = |expr: &Expr| match expr {
        Expr::Atom(Atom::Variable(name)) => steps.contains(name),
        _ => false,
    };
    match &receptivity {
        Expr::Constant(true) if !left.is_empty() => {}
        Expr::And(parts) => {
            for (at, part) in parts.iter().enumerate() {
                left.push(match at == 0 && is_step(part) {
                    true => format!("({})", write(part)),
                    false => write_factor(part),
                });
            }
        }
        alone if is_step(alone) => left.push(format!("({})", write(alone))),
        alone if left.is_empty() => left.push(write(alone)),
        alone => left.push(write_factor(alone)),
    }
    let to: Vec<String> = transition
        .to
        .iter()
        .map(|step| format!("@{}", name(step)))
        .collect();
    let line = format!(
        "{}: {} |- {}",
        name(&transition.name),
        left.join("*"),
        to.join("*")
    );
    line.trim_end().to_owned()
}

pub(crate) fn action(action: &Action) -> String {
    let text = action_text(action);
    let sign = match action.condition {
        Some(_) => "",
        None => "|- ",
    };
    format!("{}: {sign}{text}", name(&action.step))
}

/// What an action does, as its rule says it, without the step: `R`,
/// `set alarm on deactivation`, and with its condition `ls2 |- m`.
pub fn action_text(action: &Action) -> String {
    match &action.condition {
        Some(condition) => format!("{} |- {}", write(&normal(condition)), effect(action)),
        None => effect(action),
    }
}

fn effect(action: &Action) -> String {
    let output = name(&action.output);
    match &action.kind {
        ActionKind::Continuous { delay, limit } => {
            let part = |word: &str, time: &Option<Name>| match time {
                Some(time) => format!(" {word} {time}"),
                None => String::new(),
            };
            format!("{output}{}{}", part("after", delay), part("until", limit))
        }
        ActionKind::Stored { effect, on } => {
            let done = match effect {
                Effect::Set => format!("set {output}"),
                Effect::Reset => format!("reset {output}"),
                Effect::Assign(term) => format!("{output} := {term}"),
            };
            done + &trigger(on)
        }
        ActionKind::Forcing(situation) => {
            let inside = match situation {
                Situation::Steps(steps) => names(steps, ", "),
                Situation::Current => "*".to_owned(),
                Situation::Initial => "INIT".to_owned(),
            };
            format!("force {output}{{{inside}}}")
        }
    }
}

fn trigger(trigger: &Trigger) -> String {
    match trigger {
        Trigger::Activation => String::new(),
        Trigger::Deactivation => " on deactivation".to_owned(),
        Trigger::Event(event) => match normal(event) {
            // A variable of that name must not read as the word.
            Expr::Atom(Atom::Variable(event)) if is_reserved(&event) => format!(" on ({event})"),
            event => format!(" on {}", write(&event)),
        },
    }
}

pub(crate) fn environment(rule: &EnvironmentRule) -> String {
    let left = write(&normal(&rule.left));
    let right = next_scan::print(&normal(&rule.right));
    format!("{}: {left} |- {right}", name(&rule.name))
}

pub(crate) fn property(property: &Property) -> String {
    let condition = write(&normal(&property.condition));
    format!("{}: {condition}", name(&property.name))
}
