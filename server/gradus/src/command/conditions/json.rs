//! Coils as JSON. The keys are part of the command line's promise: see the
//! help of `gradus conditions`.

use serde_json::{Value, json as value};
use source::Span;

use crate::program::Ladder;
use ide::{AtRest, Coil, Drawn, Said, kind_word};

/// All coils in one document, in the order of the source.
pub fn json(ladder: &Ladder, coils: &[Coil<'_>]) -> Value {
    let mut drawn: Vec<(&Coil<'_>, &Drawn<'_>)> = coils
        .iter()
        .flat_map(|coil| coil.writes.iter().map(move |write| (coil, write)))
        .collect();
    drawn.sort_by_key(|(_, write)| write.span);
    let rungs: Vec<_> = drawn
        .into_iter()
        .map(|(coil, write)| entry(coil, write))
        .collect();
    value!({
        "file": ladder.name(),
        "format": ladder.program.format.word(),
        "rungs": rungs,
    })
}

fn entry(coil: &Coil<'_>, write: &Drawn<'_>) -> Value {
    let said = coil.conditions.as_ref();
    let is_whole = said.is_some() && write.guard.is_some() && write.solved.is_some();
    value!({
        "scope": &*write.routine.scope,
        "rung": write.rung.number,
        "coil": &**coil.name,
        "address": coil.address,
        "description": coil.description.as_deref(),
        "kind": kind_word(write.kind),
        "persistent": coil.persistent,
        "activation": said.map(|it| &it.activation),
        "turns_on": said.map(|it| &it.turns_on),
        "stays_on": said.map(|it| &it.stays_on),
        "deactivation": said.map(|it| &it.deactivation),
        "interlocks": coil.interlocks.iter().map(|name| &**name).collect::<Vec<_>>(),
        "opaque": coil.opaque,
        "at_rest": coil.at_rest.iter().map(at_rest).collect::<Vec<_>>(),
        "guard": write.guard,
        "solved": write.solved,
        "resolved": coil.resolved.as_ref().map(four),
        "too_large": !is_whole,
        "span": bytes(write.rung.span),
        "coil_span": bytes(write.span),
    })
}

fn at_rest(it: &AtRest<'_>) -> Value {
    value!({
        "name": &*it.name,
        "scope": it.written.map(|(routine, _)| &*routine.scope),
        "rung": it.written.map(|(_, rung)| rung.number),
    })
}

fn four(said: &Said) -> Value {
    value!({
        "activation": said.activation,
        "turns_on": said.turns_on,
        "stays_on": said.stays_on,
        "deactivation": said.deactivation,
    })
}

fn bytes(span: Span) -> Value {
    value!({ "start": span.start, "end": span.end })
}
