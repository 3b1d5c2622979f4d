//! Renaming in the rule text of a grafcet.

use std::collections::{HashMap, HashSet};

use grafcet::{Mention, Reading, Role, spelled, spelled_state};
use logic::Name;
use source::{Diagnostic, Edit};

use super::derived::Derived;
use super::written::is_part_of;
use super::{Own, Refusal, spelling};
use crate::{Spec, edited};

/// The edits that rename a variable of the ladder: where its value is read or
/// written, where it is the state of a step or of a decision, and in names that
/// a conversion made of it.
pub(super) fn rename_variable(
    spec: &Spec,
    old: &str,
    new: &str,
    derived: &Derived<'_>,
) -> Result<Vec<Edit>, Refusal> {
    let own = |it: &Mention| {
        let name = &*it.name;
        let is_value =
            it.role == Role::State && name.strip_prefix(old).is_some_and(|it| it.starts_with('='));
        matches!(it.role, Role::Variable | Role::State)
            && (name == old || is_part_of(name, old) || is_value)
    };
    let mentions = &spec.reading.places.mentions;
    if !mentions.iter().any(own) {
        return Ok(Vec::new());
    }
    is_free(spec, &own, new)?;
    let variable = |it: &Mention| own(it).then(|| format!("{new}{}", &it.name[old.len()..]));
    let alone = edits(spec, &variable)?;
    let after = Spec::read(edited(&spec.text, &alone).into());
    let mut names = derived.names(spec, &after);
    let taken: HashSet<&Name> = mentions.iter().map(|it| &it.name).collect();
    let is_new = |it: &Name| !taken.contains(it) && **it != *new;
    names.steps.retain(|_, name| is_new(name));
    names.transitions.retain(|_, name| is_new(name));
    let all = |it: &Mention| {
        let made = match it.role {
            Role::Step => names.steps.get(&it.name),
            Role::Transition => {
                let step = names.steps.get(&it.name);
                names.transitions.get(&it.name).or(step)
            }
            _ => None,
        };
        made.map(ToString::to_string).or_else(|| variable(it))
    };
    // Names that people gave may stand in the way of those of a conversion.
    edits(spec, &all).or(Ok(alone))
}

/// The edits that rename something of the spec's own.
pub(super) fn rename(spec: &Spec, own: &Own, new: &str) -> Result<Vec<Edit>, Refusal> {
    spelling::check(::ladder::Format::Ladder, new)?;
    if *new == *own.name {
        return Ok(Vec::new());
    }
    let grafcet = &spec.reading.spec.grafcet;
    let old = &own.name;
    let places = &spec.reading.places;
    // The step `E1` of an instance `d1` is called `d1.E1`.
    let part_of_step = places
        .declaration(old, Role::Step)
        .and_then(|it| it.part.clone());
    let copies: Vec<&Name> = grafcet
        .instances
        .iter()
        .filter(|it| own.role == Role::Step && Some(&it.of) == part_of_step.as_ref())
        .map(|it| &it.name)
        .collect();
    let has_transition = grafcet.transition(old).is_some();
    let renamed = |it: &Mention| -> Option<String> {
        let same = it.name == *old;
        match (own.role, it.role) {
            (Role::Parameter, Role::Parameter) => {
                (same && it.part == own.part).then(|| new.to_owned())
            }
            (Role::Step, Role::Step) if same => Some(new.to_owned()),
            (Role::Step, Role::Step) => {
                let copy = copies
                    .iter()
                    .find(|copy| *it.name == *format!("{copy}.{old}"))?;
                Some(format!("{copy}.{new}"))
            }
            // `keep` names the rules of a step by the step.
            (Role::Step, Role::Transition) => (same && !has_transition).then(|| new.to_owned()),
            (Role::Instance, Role::Step) => {
                let step = it.name.strip_prefix(&**old)?.strip_prefix('.')?;
                Some(format!("{new}.{step}"))
            }
            (role, other) => (same && role == other).then(|| new.to_owned()),
        }
    };
    let is_own = |it: &Mention| renamed(it).is_some();
    is_free(spec, &is_own, new)?;
    edits(spec, &renamed)
}

/// Refuses a name that the spec has already.
fn is_free(spec: &Spec, own: &dyn Fn(&Mention) -> bool, new: &str) -> Result<(), Refusal> {
    let mut others = spec.reading.places.mentions.iter().filter(|it| !own(it));
    match others.find(|it| *it.name == *new || is_part_of(&it.name, new)) {
        Some(taken) => {
            let what = match taken.role {
                Role::Grafcet => "grafcet",
                Role::Step => "step",
                Role::Variable => "variable",
                Role::Transition => "transition",
                Role::Part => "part",
                Role::Parameter => "parameter",
                Role::Instance => "instance",
                Role::Rule => "rule",
                Role::State => "state",
            };
            Err(Refusal(format!(
                "the spec has a {what} `{}` already",
                taken.name
            )))
        }
        None => Ok(()),
    }
}

/// The edits that give mentions the names that `renamed` says.
fn edits(spec: &Spec, renamed: &dyn Fn(&Mention) -> Option<String>) -> Result<Vec<Edit>, Refusal> {
    let places = &spec.reading.places;
    let edit = |it: &Mention| {
        let name = renamed(it)?;
        let text = match it.role {
            Role::State => spelled_state(&name),
            _ => spelled(&name),
        };
        Some(Edit {
            span: it.span,
            text,
        })
    };
    let edits: Vec<Edit> = places.mentions.iter().filter_map(edit).collect();
    let again = grafcet::read(&edited(&spec.text, &edits));
    let wanted = places.mentions.iter().map(|it| {
        let name = renamed(it).map_or_else(|| it.name.clone(), Name::from);
        let part = it.part.as_ref().map(|part| part_name(spec, part, renamed));
        (name, it.role, it.declares, part)
    });
    let found = again.places.mentions.iter();
    let found = found.map(|it| (it.name.clone(), it.role, it.declares, it.part.clone()));
    let says = |it: &Reading| {
        (
            it.spec.decisions.len(),
            it.places.rules.len(),
            codes(&it.diagnostics),
        )
    };
    match wanted.eq(found) && says(&spec.reading) == says(&again) {
        true => Ok(edits),
        false => Err(Refusal(
            "with that name the spec would say something else: it means something there already"
                .to_owned(),
        )),
    }
}

/// The new names of variables and steps after `edits`, by the old ones.
pub(super) fn new_names(spec: &Spec, edits: &[Edit]) -> HashMap<Name, Name> {
    let again = grafcet::read(&edited(&spec.text, edits));
    let pairs = spec.reading.places.mentions.iter();
    let pairs = pairs.zip(&again.places.mentions);
    let values = pairs.filter(|(old, new)| {
        matches!(old.role, Role::Step | Role::Variable) && old.name != new.name
    });
    values
        .map(|(old, new)| (old.name.clone(), new.name.clone()))
        .collect()
}

/// The name of a part after the renaming.
fn part_name(spec: &Spec, part: &Name, renamed: &dyn Fn(&Mention) -> Option<String>) -> Name {
    let declared = spec.reading.places.declaration(part, Role::Part);
    declared
        .and_then(renamed)
        .map_or_else(|| part.clone(), Name::from)
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<String> {
    diagnostics.iter().map(|it| it.code.to_string()).collect()
}
