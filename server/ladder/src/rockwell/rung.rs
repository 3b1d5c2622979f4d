//! From the tree of a rung's text to its network of power flow.
//!
//! A series is walked with the set of elements that power comes from: an
//! instruction takes power from all of them and is the only one afterwards; the
//! legs of a branch all begin at the same set, and the ends of all legs are the
//! set after it. So a leg without an element passes its sources through, which
//! is what `[,XIO(c)]` means, and the order of adding elements is Rockwell's
//! order of solving: left to right, top leg first.

use std::borrow::Cow;
use std::ops::Range;

use foldhash::{HashMap, HashSet};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span, codes};

use super::names::{Names, Scope};
use super::neutral::{Instruction, Item, Statement};
use super::passage::Passage;
use crate::{
    Block, Class, ElementKind, Familiarity, Gate, Network, NetworkBuilder, Operand, PinDirection,
    Placed,
};

/// Most elements that power comes from at one place. More are gathered by one
/// OR before the next element, so that wires stay proportional to the text.
const MOST_SOURCES: usize = 32;

/// What reading a rung needs to know of its surroundings.
#[derive(Debug, Default)]
pub(super) struct Surroundings {
    /// Add-On Instructions of the file by their name in lower case.
    pub(super) definitions: HashMap<String, Definition>,
    /// Presets by scope and tag, then by path within the tag, in lower case.
    pub(super) presets: HashMap<(Scope, String), HashMap<String, i64>>,
    /// Presets that some rung writes: then their value in the file is no
    /// constant.
    pub(super) written_presets: HashSet<(Scope, String, String)>,
}

/// An Add-On Instruction as its calls see it.
#[derive(Debug)]
pub(super) struct Definition {
    /// The parameters that a call passes after the instance.
    pub(super) passed: Vec<(String, PinDirection)>,
    /// Whether its logic writes `EnableOut`, the power that it passes on.
    pub(super) shapes_power: bool,
}

/// Routines that a rung may call, by their names in lower case.
pub(super) type Callable<'p> = HashMap<Cow<'p, str>, &'p str>;

/// Where a rung stands.
#[derive(Clone, Copy)]
pub(super) struct Place<'p, 't> {
    pub(super) scope: Scope,
    pub(super) routines: &'p Callable<'p>,
    pub(super) text: &'p Passage<'t>,
    /// The whole rung.
    pub(super) span: Span,
}

/// The network of a rung.
pub(super) fn network(
    statement: &Statement,
    place: Place<'_, '_>,
    surroundings: &Surroundings,
    names: &mut Names,
    diagnostics: &mut Vec<Diagnostic>,
) -> Placed {
    let start = statement.place.start;
    let mut drawing = Drawing {
        builder: NetworkBuilder::new(place.text.span(start..start)),
        place,
        surroundings,
        names,
        diagnostics,
        unknown: HashSet::default(),
    };
    drawing.series(&statement.items, vec![Network::rail()]);
    let Drawing {
        builder,
        diagnostics,
        ..
    } = drawing;
    let placed = builder.finish();
    let network = &placed.network;
    if !network.is_empty()
        && network
            .elements()
            .all(|(_, element)| only_looks(&element.kind))
    {
        diagnostics.push(
            Diagnostic::new(
                codes::RUNG_WITHOUT_OUTPUT,
                place.span,
                "the rung has conditions but no output",
            )
            .help("add a coil or another output, or remove the rung"),
        );
    }
    placed
}

/// Whether an element only decides about power.
fn only_looks(kind: &ElementKind) -> bool {
    match kind {
        ElementKind::Rail
        | ElementKind::Contact(_)
        | ElementKind::Comparison(_)
        | ElementKind::Open
        | ElementKind::OneShot(_)
        | ElementKind::Gate(_) => true,
        ElementKind::Block(block) => block.shapes_power && block.familiarity == Familiarity::Known,
        _ => false,
    }
}

/// A network in the making.
pub(super) struct Drawing<'a, 'p, 't> {
    pub(super) builder: NetworkBuilder,
    pub(super) place: Place<'p, 't>,
    pub(super) surroundings: &'a Surroundings,
    pub(super) names: &'a mut Names,
    pub(super) diagnostics: &'a mut Vec<Diagnostic>,
    /// Mnemonics of this rung that have been reported as unknown.
    pub(super) unknown: HashSet<String>,
}

impl<'p> Drawing<'_, 'p, '_> {
    fn series(&mut self, items: &[Item], mut sources: Vec<NodeIndex>) -> Vec<NodeIndex> {
        for item in items {
            sources = self.gather(sources);
            sources = match item {
                Item::Instruction(instruction) => self.instruction(instruction, sources),
                Item::Branch(branch) => self.branch(&branch.legs, &sources),
                Item::Unreadable(range) => self.unreadable(range.clone(), sources),
            };
        }
        sources
    }

    fn branch(&mut self, legs: &[Vec<Item>], sources: &[NodeIndex]) -> Vec<NodeIndex> {
        let mut ends = Vec::new();
        let mut seen = HashSet::default();
        for leg in legs {
            let leg_ends = self.series(leg, sources.to_vec());
            ends.extend(leg_ends.into_iter().filter(|&end| seen.insert(end)));
        }
        ends
    }

    fn gather(&mut self, sources: Vec<NodeIndex>) -> Vec<NodeIndex> {
        if sources.len() <= MOST_SOURCES {
            return sources;
        }
        let span = Span::at(self.place.span.end as usize);
        vec![
            self.builder
                .add_after(&sources, ElementKind::Gate(Gate::Or), span),
        ]
    }

    /// Text that is no instruction stands for a box of unknown effect.
    fn unreadable(&mut self, range: Range<usize>, sources: Vec<NodeIndex>) -> Vec<NodeIndex> {
        let block = Block {
            name: self.text(&range).into(),
            instance: None,
            pins: Vec::new(),
            familiarity: Familiarity::Unknown,
            shapes_power: true,
        };
        self.add(sources, ElementKind::Block(block), range)
    }

    /// Adds an element in series.
    pub(super) fn add(
        &mut self,
        mut sources: Vec<NodeIndex>,
        kind: ElementKind,
        range: Range<usize>,
    ) -> Vec<NodeIndex> {
        let span = self.place.text.span(range);
        let element = self.builder.add_after(&sources, kind, span);
        sources.clear();
        sources.push(element);
        sources
    }

    /// The text at `range`.
    pub(super) fn text(&self, range: &Range<usize>) -> &'p str {
        self.place
            .text
            .text()
            .get(range.clone())
            .unwrap_or_default()
    }

    /// The operand of an instruction at `place`. Where there is none, or a `?`,
    /// it gets a name that nothing else has.
    pub(super) fn operand(&mut self, instruction: &Instruction, place: usize) -> Operand {
        if let Some(range) = instruction.operands.get(place)
            && let Some(operand) = self.operand_at(range.clone())
        {
            return operand;
        }
        let range = match instruction.operands.get(place) {
            Some(range) if !range.is_empty() => range.clone(),
            _ => instruction.place.clone(),
        };
        let span = self.place.text.span(range);
        let mnemonic = self.text(&instruction.mnemonic);
        let message = format!("operand {} of `{mnemonic}` is missing", place + 1);
        self.diagnostics.push(
            Diagnostic::new(codes::NAMELESS, span, message)
                .help("assign a tag; until then it stands for a variable of its own"),
        );
        Operand::new(format!("?{}", span.start), span)
    }

    /// The operand written at `range`, if something is.
    pub(super) fn operand_at(&mut self, range: Range<usize>) -> Option<Operand> {
        let place = self.place;
        let text = place.text.text().get(range.clone())?;
        if text.is_empty() || text == "?" {
            return None;
        }
        let span = place.text.span(range);
        let name = self.names.canonical(place.scope, text, span);
        Some(Operand::new(name, span))
    }
}

/// Which way a pin for a parameter of this class points.
pub(super) fn direction(class: Class) -> PinDirection {
    match class {
        Class::Input => PinDirection::Input,
        Class::Output => PinDirection::Output,
        _ => PinDirection::InOut,
    }
}
