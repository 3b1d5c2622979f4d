//! The thing under the pointer in a ladder.

use ::ladder::{Class, Element, ElementKind};
use logic::{Budget, Name};
use recovery::conditions::Place;
use source::Span;

use super::{Block, Hover, Rungs, WIDTH, coil};
use crate::navigate::state_of;
use crate::{Ladder, Spec, Term, Usage, describe, element, legible};

/// What is known of the thing at the byte `offset` of a ladder: a variable, a
/// box or a rung.
pub fn hover_in_ladder(
    ladder: &Ladder,
    spec: Option<&Spec>,
    offset: usize,
    budget: &Budget,
) -> Option<Hover> {
    let mention = ladder.names().at(offset);
    let place = mention.and_then(|it| it.place);
    let place = place.or_else(|| ladder.names().element_at(offset));
    let at = place.and_then(|place| Some((place, element(ladder.program(), place)?)));
    if let Some((place, (_, element))) = at
        && !is_plain(element)
        && mention.is_none_or(|it| it.place.is_some())
    {
        return Some(of_box(ladder, spec, place, element, budget));
    }
    if let Some(mention) = mention {
        return Some(of_variable(
            ladder,
            spec,
            &mention.name,
            mention.span,
            budget,
        ));
    }
    if let Some((_, (rung, element))) = at
        && let Some(operand) = element
            .kind
            .reads()
            .into_iter()
            .chain(element.kind.writes())
            .next()
    {
        return Some(of_variable(
            ladder,
            spec,
            &operand.name,
            rung.place(element.within),
            budget,
        ));
    }
    let place = ladder.rung_at(offset)?;
    of_rung(ladder, place, budget)
}

/// Whether the element is one variable and no more.
fn is_plain(element: &Element) -> bool {
    matches!(element.kind, ElementKind::Contact(_) | ElementKind::Coil(_))
}

/// What is known of the variable called `name`, wherever it stands.
pub fn hover_of_variable(
    ladder: &Ladder,
    spec: Option<&Spec>,
    name: &Name,
    budget: &Budget,
) -> Hover {
    of_variable(ladder, spec, name, Span::default(), budget)
}

/// What is known of a variable, shown at `span`.
pub(super) fn of_variable(
    ladder: &Ladder,
    spec: Option<&Spec>,
    name: &Name,
    span: Span,
    budget: &Budget,
) -> Hover {
    let analysis = &ladder.analysis;
    let found = analysis
        .conditions
        .find(name)
        .map(|it| crate::coil(it, analysis, budget));
    match found.filter(|coil| !coil.writes.is_empty()) {
        Some(coil) => {
            let mut blocks = coil::blocks(&coil, ladder, spec, budget);
            let mut drawn: Vec<Place> = ladder
                .names()
                .of(name)
                .filter(|it| it.usage == Usage::Written)
                .filter_map(|it| it.place)
                .collect();
            drawn.dedup_by_key(|place| (place.routine, place.rung));
            let drives = rungs(ladder, "Driven by", drawn.iter().copied());
            blocks.extend(
                drawn
                    .iter()
                    .take(MOST_DRAWN)
                    .filter_map(|&place| drawing(ladder, place)),
            );
            blocks.extend(drives);
            Hover {
                span,
                name: name.to_string(),
                address: coil.address.map(str::to_owned),
                summary: coil::summary(&coil, analysis),
                blocks,
                terms: coil::terms(&coil, analysis),
            }
        }
        None => of_input(ladder, name, span),
    }
}

/// Rungs that are drawn for one variable.
const MOST_DRAWN: usize = 3;

/// A variable that no coil writes.
fn of_input(ladder: &Ladder, name: &Name, span: Span) -> Hover {
    let declared = ladder.program().declarations.find(name);
    let class = match declared.map(|it| it.class) {
        Some(Class::Input) => "input",
        Some(Class::Output) => "output that no coil writes",
        Some(Class::InOut) => "input and output that no coil writes",
        Some(Class::Constant) => "constant",
        Some(_) => "no coil writes it",
        None => "no coil writes it, and it is not declared",
    };
    let data_type = declared.and_then(|it| it.data_type.as_deref());
    let kind = match data_type {
        Some(data_type) => format!("{class} ({data_type})"),
        None => class.to_owned(),
    };
    let register = ladder.analysis.registers.iter().find(|it| it.name == *name);
    let summary = match (ladder.analysis.description(name), register) {
        (Some(description), _) => format!("{description}: {kind}"),
        (None, Some(_)) => "counts the steps of a sequence".to_owned(),
        (None, None) => kind,
    };
    let mut blocks = Vec::new();
    if let Some(register) = register {
        let values: Vec<String> = register
            .states
            .iter()
            .map(|state| match &state.title {
                Some(title) => format!("{} {title}", state.value),
                None => state.value.to_string(),
            })
            .collect();
        blocks.push(Block::Text(format!("Steps: {}", values.join(", "))));
    }
    blocks.extend(readers(ladder, name));
    Hover {
        span,
        name: name.to_string(),
        address: declared
            .and_then(|it| it.address.as_deref())
            .map(str::to_owned),
        summary,
        blocks,
        terms: register.map(|_| Term::StepRegister).into_iter().collect(),
    }
}

/// The rungs that read a variable.
fn readers(ladder: &Ladder, name: &Name) -> Option<Block> {
    let read = ladder.names().of(name).filter(|it| it.usage == Usage::Read);
    rungs(ladder, "Read by", read.filter_map(|it| it.place))
}

/// The rungs at these places; `None` if there are none.
fn rungs(
    ladder: &Ladder,
    label: &'static str,
    places: impl Iterator<Item = Place>,
) -> Option<Block> {
    let mut named: Vec<(String, Span)> = places
        .filter_map(|place| Some((rung_title(ladder, place)?, ladder.rung(place)?.1.span)))
        .collect();
    named.dedup();
    let more = named.len().saturating_sub(MOST_NAMED);
    named.truncate(MOST_NAMED);
    (!named.is_empty()).then_some(Block::Rungs(Rungs { label, named, more }))
}

/// Rungs that are named of those that read or write a variable.
const MOST_NAMED: usize = 6;

/// A rung as people name it.
pub(crate) fn rung_title(ladder: &Ladder, place: Place) -> Option<String> {
    let (routine, rung) = ladder.rung(place)?;
    let number = routine.name_of(rung);
    Some(match &rung.comment {
        Some(comment) => format!("{number} ({})", first_line(comment)),
        None => number,
    })
}

fn first_line(text: &str) -> &str {
    text.lines()
        .map(str::trim)
        .find(|line| !line.is_empty())
        .unwrap_or_default()
}

/// A box: what it is, and the rung it stands on. One that compares with or
/// writes a value of a step register is about that state.
fn of_box(
    ladder: &Ladder,
    spec: Option<&Spec>,
    place: Place,
    element: &Element,
    budget: &Budget,
) -> Hover {
    let whole = ladder
        .rung(place)
        .map_or(Span::default(), |(_, rung)| rung.place(element.within));
    let text = ladder.text.get(whole.range()).unwrap_or_default();
    let conditions = &ladder.analysis.conditions;
    let power = ladder.power_at(place, budget);
    let mut blocks = Vec::new();
    if let Some(power) = power.and_then(|it| legible(&it, conditions, budget)) {
        blocks.push(Block::Fields(vec![("powered", power)]));
    }
    let state = state_of(ladder, &element.kind);
    let mut summary = describe::summary(&element.kind);
    let mut terms = Vec::new();
    if let Some(state) = &state {
        terms.extend([Term::StepRegister, Term::Succession]);
        summary = coil::value_summary(state, ladder).unwrap_or(summary);
        blocks.push(Block::Fields(coil::neighbours(state, ladder, spec, budget)));
    }
    blocks.extend(drawing(ladder, place));
    Hover {
        span: whole,
        name: match state {
            Some(state) => state.to_string(),
            None => describe::name(&element.kind, text),
        },
        address: None,
        summary,
        blocks,
        terms,
    }
}

/// A rung: what it drives.
fn of_rung(ladder: &Ladder, place: Place, budget: &Budget) -> Option<Hover> {
    let (_, rung) = ladder.rung(place)?;
    let analysis = &ladder.analysis;
    let mut blocks: Vec<Block> = drawing(ladder, place).into_iter().collect();
    let mut terms = Vec::new();
    for (_, element) in rung.network.elements() {
        let ElementKind::Coil(coil) = &element.kind else {
            continue;
        };
        let Some(variable) = analysis.conditions.find(&coil.operand.name) else {
            continue;
        };
        let coil = crate::coil(variable, analysis, budget);
        for term in coil::terms(&coil, analysis) {
            // Its neighbours are not told here.
            if term != Term::Succession && !terms.contains(&term) {
                terms.push(term);
            }
        }
        blocks.push(Block::Text(format!(
            "{}: {}",
            coil.name,
            coil::summary(&coil, analysis)
        )));
        blocks.extend(
            coil::blocks(&coil, ladder, None, budget)
                .into_iter()
                .take(1),
        );
    }
    Some(Hover {
        span: rung.span,
        name: rung_title(ladder, place)?,
        address: None,
        summary: String::new(),
        blocks,
        terms,
    })
}

/// The rung in characters, or that it cannot be drawn.
fn drawing(ladder: &Ladder, place: Place) -> Option<Block> {
    let (_, rung) = ladder.rung(place)?;
    if rung.network.is_empty() {
        return None;
    }
    Some(match ::ladder::text::draw(&rung.network, WIDTH) {
        Some(lines) => Block::Drawing(lines),
        None => Block::Text(format!(
            "{} is too large to be drawn here.",
            capitalised(&rung_title(ladder, place)?)
        )),
    })
}

fn capitalised(text: &str) -> String {
    let mut signs = text.chars();
    let first = signs.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + signs.as_str()
}
