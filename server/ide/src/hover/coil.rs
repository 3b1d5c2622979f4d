//! What is known of a variable that coils write.

use logic::{Budget, Name};
use recovery::Analysis;
use recovery::states::Holding;
use recovery::successions::{Evidence, Succession};

use super::Block;
use crate::decided::{Decided, Standing};
use crate::{AtRest, Coil, Ladder, Part, Spec, Term};

const TOO_LARGE: &str = "too large to be worked out";

/// What it is, in a line.
pub(super) fn summary(coil: &Coil<'_>, analysis: &Analysis) -> String {
    let part = match coil.part {
        Part::State => match analysis.states().find(coil.name).map(|it| it.holding) {
            Some(Holding::Latch) => "holds a state (latch)",
            _ => "holds a state (seal-in)",
        },
        Part::Repeats => "stored output: states set and reset it",
        Part::Keeps => "keeps its value, but never both starts and ends",
        Part::KeptWhenSkipped => "keeps its value while its rung is skipped",
        Part::Oscillates => "falls in itself",
        Part::Auxiliary => "carries a condition to other rungs",
        Part::Follows => "follows its condition, holds nothing",
        Part::TooLarge => TOO_LARGE,
    };
    match &coil.description {
        Some(description) => format!("{description}: {part}"),
        None => part.to_owned(),
    }
}

/// The words that are said of it, and have a page.
pub(super) fn terms(coil: &Coil<'_>, analysis: &Analysis) -> Vec<Term> {
    let mut terms = match coil.part {
        Part::State => match analysis.states().find(coil.name).map(|it| it.holding) {
            Some(Holding::Latch) => vec![Term::State, Term::Latch],
            _ => vec![Term::State, Term::SealIn],
        },
        Part::Repeats => vec![Term::StoredOutput],
        Part::Keeps | Part::KeptWhenSkipped => vec![Term::Persistent],
        Part::Oscillates => vec![Term::Oscillating],
        Part::Auxiliary => vec![Term::Auxiliary],
        Part::Follows => vec![Term::NonPersistent],
        Part::TooLarge => Vec::new(),
    };
    let further = [
        (!coil.interlocks.is_empty(), Term::Interlock),
        (!coil.opaque.is_empty(), Term::Opaque),
        (!coil.at_rest.is_empty(), Term::AtRest),
        (coil.resolved.is_some(), Term::Auxiliary),
        (coil.part == Part::State, Term::Succession),
    ];
    terms.extend(further.iter().filter(|(is, _)| *is).map(|(_, term)| *term));
    terms
}

/// Its conditions, interlocks and neighbours.
pub(super) fn blocks(
    coil: &Coil<'_>,
    ladder: &Ladder,
    spec: Option<&Spec>,
    budget: &Budget,
) -> Vec<Block> {
    let mut blocks = vec![Block::Fields(conditions(coil))];
    if let Some(resolved) = &coil.resolved {
        blocks.push(Block::Text("With auxiliary coils resolved:".to_owned()));
        blocks.push(Block::Fields(vec![
            ("turns on", resolved.turns_on.clone()),
            ("turns off", resolved.deactivation.clone()),
        ]));
    }
    if coil.part == Part::State {
        blocks.push(Block::Fields(neighbours(coil.name, ladder, spec, budget)));
    }
    blocks
}

fn conditions(coil: &Coil<'_>) -> Vec<(&'static str, String)> {
    let Some(said) = &coil.conditions else {
        return vec![("conditions", TOO_LARGE.to_owned())];
    };
    let mut fields = match coil.part {
        Part::Follows | Part::Auxiliary => vec![("on while", said.activation.clone())],
        _ => vec![
            ("turns on", said.turns_on.clone()),
            ("stays on", said.stays_on.clone()),
            ("turns off", said.deactivation.clone()),
        ],
    };
    if !coil.interlocks.is_empty() {
        fields.push(("interlocks", coil.interlocks.join(", ")));
    }
    if !coil.opaque.is_empty() {
        fields.push(("opaque", coil.opaque.join(", ")));
    }
    let labels = std::iter::once("supposes").chain(std::iter::repeat(""));
    let supposed = coil.at_rest.iter().map(AtRest::in_words);
    fields.extend(labels.zip(supposed));
    fields
}

/// Which states it may follow, and which may follow it, with the evidence and
/// what was decided.
pub(super) fn neighbours(
    name: &Name,
    ladder: &Ladder,
    spec: Option<&Spec>,
    budget: &Budget,
) -> Vec<(&'static str, String)> {
    let decided = spec.map(Decided::of).unwrap_or_default();
    let all = &ladder.analysis.successions();
    let word = |succession: &Succession, other: &Name| {
        let mut words = vec![succession.evidence.word().to_owned()];
        if succession.evidence == Evidence::Handover
            && let Some(condition) = &succession.condition
            && let Some(condition) = crate::legible(condition, &ladder.analysis.conditions, budget)
        {
            words[0] += &format!(" on {condition}");
        }
        if let Some(witness) = &succession.witness
            && witness.scans() <= MOST_SCANS
        {
            words.push(format!("seen after: {}", witness.in_words()));
        }
        match decided.standing(&succession.from, &succession.to) {
            Standing::Open => {}
            Standing::Accepted => words.push("accepted".to_owned()),
            Standing::Rejected => words.push("rejected".to_owned()),
        }
        format!("{other} ({})", words.join(", "))
    };
    let before = all.iter().filter(|it| it.to == *name);
    let after = all.iter().filter(|it| it.from == *name);
    let mut fields: Vec<_> = listed("follows", before.map(|it| word(it, &it.from))).collect();
    fields.extend(listed("followed by", after.map(|it| word(it, &it.to))));
    fields
}

/// What a value of a step register is, in a line; `None` of any other state.
pub(super) fn value_summary(state: &Name, ladder: &Ladder) -> Option<String> {
    let mut registers = ladder.analysis.registers.iter();
    let title = registers.find_map(|register| {
        let mut states = register.states.iter();
        let found = states.find(|it| register.state_name(it.value) == *state)?;
        Some(found.title.clone())
    })?;
    Some(match title {
        Some(title) => format!("{title}: value of a step register"),
        None => "value of a step register".to_owned(),
    })
}

/// A sequence of more scans than this is not shown in a hover.
const MOST_SCANS: usize = 6;

/// Neighbours that are named on each side.
const MOST_NEIGHBOURS: usize = 8;

/// A line for each of a list, the first with the label.
fn listed(
    label: &'static str,
    all: impl Iterator<Item = String>,
) -> impl Iterator<Item = (&'static str, String)> {
    let mut lines: Vec<String> = all.collect();
    let more = lines.len().saturating_sub(MOST_NEIGHBOURS);
    if more > 1 {
        lines.truncate(MOST_NEIGHBOURS);
        lines.push(format!("and {more} more"));
    }
    if lines.is_empty() {
        lines.push("nothing that is known".to_owned());
    }
    let labels = std::iter::once(label).chain(std::iter::repeat(""));
    labels.zip(lines)
}
