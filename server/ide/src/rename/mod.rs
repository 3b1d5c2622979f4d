//! Giving a thing another name, in the ladder and the spec beside it.
//!
//! A name may stand where no reader gives a place for it: in the expression of a
//! box, in the text of a block, in an alias. So every renaming is tried: the
//! edited texts are read again, and unless they say what the old ones said, up
//! to the name, nothing is changed and a sentence tells why.

mod derived;
mod ladder;
mod leftover;
mod same;
mod scenario;
mod spec;
mod spelling;
mod written;

use std::collections::HashMap;

use grafcet::Role;
use logic::{Budget, Name};
use source::{Edit, Span};

use crate::{Ladder, Spec, edited};
pub use scenario::{edits_in_scenario, renamable_in_scenario, rename_in_scenario};
use written::Variable;

/// What can be renamed at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renamable {
    /// The bytes of the name at that place, quotes left out.
    pub span: Span,
    /// The name.
    pub name: String,
}

/// The edits that rename something.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Renaming {
    /// The name so far.
    pub old: String,
    /// The edits of the ladder.
    pub ladder: Vec<Edit>,
    /// The edits of the spec.
    pub spec: Vec<Edit>,
    /// The new names of variables and steps, by the old ones: scenarios that
    /// name them follow.
    pub names: HashMap<Name, Name>,
}

/// Why something cannot be renamed: a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal(pub String);

/// What can be renamed at the byte `offset` of a ladder; `None` where no name
/// stands.
pub fn renamable_in_ladder(ladder: &Ladder, offset: usize) -> Option<Result<Renamable, Refusal>> {
    Some(
        ladder::at(ladder, offset)?.map(|(variable, span)| Renamable {
            span,
            name: variable.local,
        }),
    )
}

/// What can be renamed at the byte `offset` of a spec; `None` where no name
/// stands.
pub fn renamable_in_spec(
    spec: &Spec,
    ladder: Option<&Ladder>,
    offset: usize,
) -> Option<Result<Renamable, Refusal>> {
    Some(target(spec, ladder, offset)?.map(renamable))
}

/// What was found at a place, as it is shown.
fn renamable((target, span): (Target, Span)) -> Renamable {
    let name = match target {
        Target::Variable(variable) => variable.name.to_string(),
        Target::Own(own) => own.name.to_string(),
    };
    Renamable { span, name }
}

/// Renames the variable at the byte `offset` of a ladder, in the spec too.
pub fn rename_in_ladder(
    ladder: &Ladder,
    spec: Option<&Spec>,
    offset: usize,
    new: &str,
    budget: &Budget,
) -> Option<Result<Renaming, Refusal>> {
    let found = ladder::at(ladder, offset)?;
    Some(found.and_then(|(it, _)| variable(&it, ladder, spec, new, budget)))
}

/// Renames what stands at the byte `offset` of a spec; a variable or state in
/// the ladder too.
pub fn rename_in_spec(
    spec: &Spec,
    ladder: Option<&Ladder>,
    offset: usize,
    new: &str,
    budget: &Budget,
) -> Option<Result<Renaming, Refusal>> {
    let target = target(spec, ladder, offset)?;
    Some(target.and_then(|(target, _)| rename_target(&target, ladder, Some(spec), new, budget)))
}

/// Renames what was found in a text, in all texts that have it.
fn rename_target(
    target: &Target,
    ladder: Option<&Ladder>,
    spec: Option<&Spec>,
    new: &str,
    budget: &Budget,
) -> Result<Renaming, Refusal> {
    match (target, ladder, spec) {
        (Target::Variable(it), Some(ladder), spec) => variable(it, ladder, spec, new, budget),
        (Target::Own(own), Some(ladder), _) if own.is_value() && has(ladder, new) => {
            Err(Refusal(format!("the ladder has a `{new}` already")))
        }
        (Target::Own(own), _, Some(spec)) => spec::rename(spec, own, new).map(|edits| Renaming {
            old: own.name.to_string(),
            ladder: Vec::new(),
            names: spec::new_names(spec, &edits),
            spec: edits,
        }),
        (Target::Variable(_), None, _) | (Target::Own(_), _, None) => Ok(Renaming::default()),
    }
}

fn has(ladder: &Ladder, name: &str) -> bool {
    ladder.names().of(name).next().is_some()
}

impl Own {
    /// Whether it has a value that expressions can name, as variables of the
    /// ladder have.
    fn is_value(&self) -> bool {
        matches!(self.role, Role::Step | Role::Variable | Role::Instance)
    }
}

fn variable(
    variable: &Variable,
    ladder: &Ladder,
    spec: Option<&Spec>,
    new: &str,
    budget: &Budget,
) -> Result<Renaming, Refusal> {
    spelling::check(ladder.program().format, new)?;
    if *new == variable.local {
        return Ok(Renaming::default());
    }
    let (edits, name) = ladder::rename(ladder, variable, new)?;
    let in_spec = match spec {
        Some(spec) => {
            let with = derived::Derived {
                old: ladder,
                text: &edited(&ladder.text, &edits),
                budget,
            };
            spec::rename_variable(spec, &variable.name, &name, &with)?
        }
        None => Vec::new(),
    };
    let mut names = spec.map_or_else(HashMap::new, |spec| spec::new_names(spec, &in_spec));
    names.insert(variable.name.clone(), name);
    Ok(Renaming {
        old: variable.local.clone(),
        ladder: edits,
        spec: in_spec,
        names,
    })
}

/// What is renamed from a spec.
enum Target {
    /// A variable of the ladder.
    Variable(Variable),
    /// Something of the spec's own.
    Own(Own),
}

/// Something that only the spec has.
struct Own {
    name: Name,
    role: Role,
    /// The part that a parameter belongs to.
    part: Option<Name>,
}

fn target(
    spec: &Spec,
    ladder: Option<&Ladder>,
    offset: usize,
) -> Option<Result<(Target, Span), Refusal>> {
    let mention = spec.reading.places.mention_at(offset)?;
    let text = spec.text.get(mention.span.range())?;
    let inner = written::within_quotes(text, mention.span);
    let shown = |name: &str| {
        let start = inner.range().start;
        Span::new(start, (start + name.len()).min(inner.range().end))
    };
    if matches!(mention.role, Role::Variable | Role::State)
        && let Some(ladder) = ladder
        && let Some(found) = written::variable_called(ladder, &mention.name)
    {
        return Some(found.map(|variable| {
            let span = shown(&variable.name);
            (Target::Variable(variable), span)
        }));
    }
    if mention.role == Role::State {
        let message = format!("the ladder has no state `{}`", mention.name);
        return Some(Err(Refusal(message)));
    }
    if mention.role == Role::Step && spec.reading.spec.grafcet.step(&mention.name).is_none() {
        let message = format!(
            "`{}` is a step of an instance: rename the instance, or the step in its part",
            mention.name
        );
        return Some(Err(Refusal(message)));
    }
    let own = Own {
        name: mention.name.clone(),
        role: mention.role,
        part: mention.part.clone(),
    };
    Some(Ok((Target::Own(own), inner)))
}

#[cfg(test)]
mod tests;
