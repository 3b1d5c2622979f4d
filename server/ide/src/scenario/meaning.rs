use logic::Name;

use crate::navigate::{Pair, Subject, of_state};
use crate::{Ladder, Spec};

/// What a name in a scenario means in the ladder and the spec: the variable that
/// the ladder calls so or has at that address, else a step or a variable of the
/// spec. `None` if neither knows it.
pub fn meaning(pair: Pair<'_>, name: &Name) -> Option<Subject> {
    let in_ladder = pair.ladder.and_then(|ladder| variable(ladder, name));
    in_ladder
        .map(Subject::Variable)
        .or_else(|| in_spec(pair.spec?, name))
}

/// Whether a name in a scenario means `subject`, or a part of it.
pub fn is_meant(pair: Pair<'_>, name: &Name, subject: &Subject) -> bool {
    let Some(meant) = meaning(pair, name) else {
        return false;
    };
    match (&meant, subject) {
        (Subject::Variable(part), Subject::Variable(whole)) => {
            crate::navigate::is_part(part, whole)
        }
        _ => meant == *subject,
    }
}

/// What a ladder calls the variable that a scenario calls `name`.
pub(crate) fn variable(ladder: &Ladder, name: &Name) -> Option<Name> {
    let knows = |name: &str| ladder.names().of(name).next().is_some();
    if knows(name) {
        return Some(name.clone());
    }
    let mut declarations = ladder.program().declarations.iter();
    let addressed = declarations.find(|it| {
        let address = it.address.as_deref();
        address.is_some_and(|address| address.eq_ignore_ascii_case(name))
    });
    if let Some(declaration) = addressed {
        return Some(declaration.name.clone());
    }
    let mut wholes = name.match_indices(['.', '[']).map(|(at, _)| &name[..at]);
    wholes.any(knows).then(|| name.clone())
}

fn in_spec(spec: &Spec, name: &Name) -> Option<Subject> {
    let grafcet = &spec.reading.spec.grafcet;
    if let Some(step) = grafcet.step(name) {
        return Some(match &step.state {
            Some(state) => of_state(state),
            None => Subject::Step(name.clone()),
        });
    }
    let mut variables = grafcet.variables();
    let found = variables.find(|it| {
        let address = it.address.as_deref();
        it.name == *name || address.is_some_and(|address| address.eq_ignore_ascii_case(name))
    })?;
    Some(Subject::Variable(found.name.clone()))
}
