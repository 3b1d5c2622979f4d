//! Sequential function charts: read as drawn, to compare with.
//!
//! Steps and transitions are joined through divergences and convergences that
//! are elements of their own. Walking against the flow through these gives the
//! steps before a transition, and the transitions before a step. Whether a
//! junction is a selection or simultaneous needs no asking: what a transition
//! finds are steps that must all be active, what a step finds are transitions
//! each of which activates it.

use std::borrow::Cow;

use foldhash::{HashMap, HashSet};
use logic::Name;
use source::{Diagnostic, Span, codes};

use super::interface::name_of;
use super::names::key;
use super::xml::{Tag, Text};
use crate::{Chart, ChartAction, ChartStep, ChartTransition};

/// What an element of a chart is.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// A step, by its place in the chart; a jump is the step it leads to.
    Step(usize),
    /// A transition, by its place in the chart.
    Transition(usize),
    Junction,
}

struct Drawn<'d, 't> {
    part: Part,
    tag: Tag<'d, 't>,
}

/// Reads an `SFC` body. `drawn` holds what the conditions say that are drawn
/// as a ladder beside the chart, by the transition's place.
pub(super) fn read(
    body: Tag<'_, '_>,
    scope: Name,
    drawn: &HashMap<Span, Name>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Chart {
    let mut chart = Chart {
        scope,
        span: body.span(),
        ..Chart::default()
    };
    let mut parts = steps(body, &mut chart, diagnostics);
    transitions(body, &mut chart, &mut parts, drawn);
    let places: HashMap<Cow<'_, str>, usize> = parts
        .iter()
        .enumerate()
        .filter_map(|(at, part)| Some((id(part.tag, "localId")?, at)))
        .collect();
    join(&mut chart, &parts, &places, diagnostics);
    actions(body, &mut chart, &parts, &places);
    chart
}

fn id<'t>(tag: Tag<'_, 't>, attribute: &str) -> Option<Cow<'t, str>> {
    let found = tag.attribute(attribute)?.trimmed();
    (!found.is_empty()).then_some(found)
}

fn steps<'d, 't>(
    body: Tag<'d, 't>,
    chart: &mut Chart,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Drawn<'d, 't>> {
    let mut parts = Vec::new();
    let mut named = HashMap::default();
    let is_step = |tag: &Tag<'_, '_>| matches!(tag.name(), "step" | "macroStep");
    for tag in body.children().filter(is_step) {
        let place = chart.steps.len();
        named.entry(key(&name_of(tag))).or_insert(place);
        parts.push(Drawn {
            part: Part::Step(place),
            tag,
        });
        chart.steps.push(ChartStep {
            name: name_of(tag),
            initial: tag.says("initialStep"),
            actions: Vec::new(),
            span: tag.span(),
        });
        if tag.name() == "macroStep" {
            let message = format!(
                "the inside of the macro step `{}` is not read",
                name_of(tag)
            );
            diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_BOX, tag.span(), message)
                    .help("draw its steps in the chart itself"),
            );
        }
    }
    for tag in body.children() {
        match tag.name() {
            "jumpStep" => {
                let target = tag.attribute("targetName");
                let target = target.map_or(Cow::Borrowed(""), Text::trimmed);
                match named.get(&key(&target)) {
                    Some(&place) => parts.push(Drawn {
                        part: Part::Step(place),
                        tag,
                    }),
                    None => diagnostics.push(
                        Diagnostic::new(
                            codes::DANGLING_CONNECTION,
                            tag.span(),
                            format!("this chart has no step `{target}` to jump to"),
                        )
                        .help("name a step of the same chart"),
                    ),
                }
            }
            "selectionDivergence"
            | "selectionConvergence"
            | "simultaneousDivergence"
            | "simultaneousConvergence" => parts.push(Drawn {
                part: Part::Junction,
                tag,
            }),
            _ => {}
        }
    }
    parts
}

fn transitions<'d, 't>(
    body: Tag<'d, 't>,
    chart: &mut Chart,
    parts: &mut Vec<Drawn<'d, 't>>,
    drawn: &HashMap<Span, Name>,
) {
    for tag in body.children().filter(|tag| tag.name() == "transition") {
        parts.push(Drawn {
            part: Part::Transition(chart.transitions.len()),
            tag,
        });
        chart.transitions.push(ChartTransition {
            name: name_of(tag),
            from: Vec::new(),
            to: Vec::new(),
            condition: condition(tag, &chart.scope, drawn),
            span: tag.span(),
        });
    }
}

/// What a transition waits for: the text of its structured text, else the name
/// under which its condition is written elsewhere.
fn condition(tag: Tag<'_, '_>, unit: &str, drawn: &HashMap<Span, Name>) -> Name {
    if let Some(said) = drawn.get(&tag.span()) {
        return said.clone();
    }
    let Some(condition) = tag.child("condition") else {
        return "".into();
    };
    if let Some(reference) = condition.child("reference") {
        return name_of(reference);
    }
    let inline = condition.child("inline").unwrap_or(condition);
    let language = inline.children().find(|tag| tag.name() != "addData");
    let drawing = matches!(language.map(Tag::name), Some("LD" | "FBD"));
    let text = inline.text().filter(|_| !drawing);
    match (text, id(tag, "name"), id(tag, "localId")) {
        (Some(text), _, _) => text.value.into(),
        (None, Some(name), _) => name.into(),
        (None, None, Some(id)) if drawing => format!("{unit}.transition{id}").into(),
        _ => "".into(),
    }
}

/// Fills in the steps before and after every transition.
fn join(
    chart: &mut Chart,
    parts: &[Drawn<'_, '_>],
    places: &HashMap<Cow<'_, str>, usize>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for part in parts {
        for before in upstream(part.tag, parts, places, diagnostics) {
            let (transition, step, leaves) = match (part.part, before) {
                (Part::Transition(transition), Part::Step(step)) => (transition, step, true),
                (Part::Step(step), Part::Transition(transition)) => (transition, step, false),
                (Part::Junction, _) | (_, Part::Junction) => continue,
                _ => {
                    diagnostics.push(
                        Diagnostic::new(
                            codes::DANGLING_CONNECTION,
                            part.tag.span(),
                            "a step follows a step, or a transition a transition",
                        )
                        .help("put a transition between steps and a step between transitions"),
                    );
                    continue;
                }
            };
            let Some(transition) = chart.transitions.get_mut(transition) else {
                continue;
            };
            let side = if leaves {
                &mut transition.from
            } else {
                &mut transition.to
            };
            if !side.contains(&step) {
                side.push(step);
            }
        }
    }
}

/// The steps and transitions that a tag is fed by, through junctions.
fn upstream(
    tag: Tag<'_, '_>,
    parts: &[Drawn<'_, '_>],
    places: &HashMap<Cow<'_, str>, usize>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Part> {
    let mut found = Vec::new();
    if matches!(tag.name(), name if name.ends_with("vergence")) {
        return found;
    }
    let mut seen = HashSet::default();
    let mut open: Vec<_> = connections(tag).collect();
    open.reverse();
    while let Some((id, span)) = open.pop() {
        let Some(part) = places.get(&id).and_then(|&at| parts.get(at)) else {
            diagnostics.push(
                Diagnostic::new(
                    codes::DANGLING_CONNECTION,
                    span,
                    format!("no element of this chart has the id `{id}`"),
                )
                .help("draw the connection again"),
            );
            continue;
        };
        if part.part != Part::Junction {
            found.push(part.part);
        } else if seen.insert(id) {
            let before = open.len();
            open.extend(connections(part.tag));
            open[before..].reverse();
        }
    }
    found
}

fn connections<'d, 't>(
    tag: Tag<'d, 't>,
) -> impl Iterator<Item = (Cow<'t, str>, Span)> + use<'d, 't> {
    tag.children()
        .filter(|point| point.name() == "connectionPointIn")
        .flat_map(Tag::children)
        .filter(|part| part.name() == "connection")
        .filter_map(|part| Some((id(part, "refLocalId")?, part.span())))
}

/// Hands the actions of every action block to the step it hangs on.
fn actions(
    body: Tag<'_, '_>,
    chart: &mut Chart,
    parts: &[Drawn<'_, '_>],
    places: &HashMap<Cow<'_, str>, usize>,
) {
    for block in body.children().filter(|tag| tag.name() == "actionBlock") {
        let step = connections(block).find_map(|(id, _)| {
            let part = places.get(&id).and_then(|&at| parts.get(at))?;
            match part.part {
                Part::Step(step) => Some(step),
                _ => None,
            }
        });
        let Some(step) = step.and_then(|at| chart.steps.get_mut(at)) else {
            continue;
        };
        let blocks = block.children().filter(|tag| tag.name() == "action");
        step.actions.extend(blocks.map(action));
    }
}

fn action(tag: Tag<'_, '_>) -> ChartAction {
    let word = |name: &str| id(tag, name).unwrap_or_default();
    let qualifier = match (word("qualifier"), word("duration")) {
        (qualifier, duration) if duration.is_empty() => qualifier,
        (qualifier, duration) => Cow::Owned(format!("{qualifier} {duration}")),
    };
    let body = match tag.child("reference") {
        Some(reference) => name_of(reference),
        None => tag
            .text()
            .map_or_else(|| "".into(), |text| text.value.into()),
    };
    ChartAction {
        qualifier: qualifier.into(),
        body,
    }
}
