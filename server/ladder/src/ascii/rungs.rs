//! From symbols and wires to rungs.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use petgraph::graph::NodeIndex;
use petgraph::unionfind::UnionFind;
use source::{Diagnostic, Span, codes};

use super::element;
use super::grid::Grid;
use super::notes::Note;
use super::symbols::Drawing;
use super::wires::{End, Net, Wires};
use crate::{ElementKind, Gate, Network, NetworkBuilder, Operand, Port, Rung, Wire};

/// A net with more wires than this between its ends gets an OR gate in its
/// middle, so that n ends before m do not make n times m wires.
const MOST_WIRES: usize = 256;

/// Symbols that make one rung, in the order of solving.
struct Band {
    symbols: Vec<usize>,
    first_row: usize,
    last_row: usize,
}

/// The rungs of a drawing, from the top.
pub(super) fn rungs(
    grid: &Grid,
    mut drawing: Drawing,
    wires: Wires,
    notes: &[Note],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Rung> {
    let kinds: Vec<ElementKind> = (0..drawing.symbols.len())
        .map(|at| element::kind(grid, &mut drawing, at, diagnostics))
        .collect();
    let nets = nets(&wires);
    let mut labels = drawing.labels.iter().peekable();
    let mut comments = notes
        .iter()
        .filter(|note| note.comment.is_some())
        .peekable();
    let mut rungs = Vec::new();
    for band in bands(&drawing, &wires) {
        let mut drawn = Drawn::new(grid, &drawing, &wires, &nets, &kinds, band.first_row);
        while let Some((row, name, span)) = labels.next_if(|(row, ..)| *row <= band.first_row) {
            drawn.label(*row, name, *span);
        }
        for at in ordered(&band, &wires, &nets, &drawing) {
            drawn.add(at, diagnostics);
        }
        let span = drawn.rows(band.first_row, band.last_row);
        let mut comment = None;
        while let Some(note) = comments.next_if(|note| note.start < span.start as usize) {
            comment = note.comment.as_deref().map(Into::into);
        }
        if !band.symbols.iter().any(|&at| is_output(&kinds[at])) {
            diagnostics.push(
                Diagnostic::new(codes::RUNG_WITHOUT_OUTPUT, span, "the rung writes nothing")
                    .help("end it with a coil, a jump or a box"),
            );
        }
        let number = rungs.len() as u32;
        rungs.push(Rung::new(number, comment, drawn.builder.finish(), span));
    }
    for (row, name, span) in labels {
        let mut drawn = Drawn::new(grid, &drawing, &wires, &nets, &kinds, *row);
        drawn.label(*row, name, *span);
        let number = rungs.len() as u32;
        rungs.push(Rung::new(number, None, drawn.builder.finish(), *span));
    }
    report_words(&drawing, diagnostics);
    rungs
}

fn is_output(kind: &ElementKind) -> bool {
    !matches!(kind, ElementKind::Contact(_) | ElementKind::Comparison(_))
}

/// What feeds a net and how many ends it feeds.
#[derive(Clone, Debug, Default)]
struct NetEnds {
    sources: Vec<(usize, usize)>,
    sinks: Vec<usize>,
}

/// The nets with the right ends that feed them, as symbol and place among
/// its right ends, and the symbols that they feed. The rail needs no list.
fn nets(wires: &Wires) -> HashMap<Net, NetEnds> {
    let mut nets: HashMap<Net, NetEnds> = HashMap::new();
    for (symbol, ends) in wires.ends.iter().enumerate() {
        for (at, end) in ends.right.iter().enumerate() {
            let net = nets.entry(end.net).or_default();
            net.sources.push((symbol, at));
        }
        for end in &ends.left {
            nets.entry(end.net).or_default().sinks.push(symbol);
        }
    }
    nets.remove(&wires.rail);
    nets
}

/// Symbols joined by wires, the rail aside, with all that share rows.
fn bands(drawing: &Drawing, wires: &Wires) -> Vec<Band> {
    let mut parts = UnionFind::new(drawing.symbols.len());
    let mut first_of_net: HashMap<Net, usize> = HashMap::new();
    for (symbol, ends) in wires.ends.iter().enumerate() {
        for end in ends.left.iter().chain(&ends.right) {
            if end.net != wires.rail {
                let first = *first_of_net.entry(end.net).or_insert(symbol);
                parts.union(first, symbol);
            }
        }
    }
    let mut rows: HashMap<usize, (usize, usize)> = HashMap::new();
    for (at, symbol) in drawing.symbols.iter().enumerate() {
        let extent = rows
            .entry(parts.find(at))
            .or_insert((symbol.row, symbol.row));
        extent.0 = extent.0.min(symbol.row);
        extent.1 = extent.1.max(symbol.row);
    }
    let mut symbols: Vec<(usize, usize, usize)> = (0..drawing.symbols.len())
        .map(|at| {
            let (first, last) = rows[&parts.find(at)];
            (first, last, at)
        })
        .collect();
    symbols.sort_unstable();
    let mut bands: Vec<Band> = Vec::new();
    for (first, last, at) in symbols {
        match bands.last_mut() {
            Some(band) if first <= band.last_row => {
                band.last_row = band.last_row.max(last);
                band.symbols.push(at);
            }
            _ => bands.push(Band {
                symbols: vec![at],
                first_row: first,
                last_row: last,
            }),
        }
    }
    bands
}

/// The symbols of a band row by row, each after those that feed it. What
/// feeds itself comes last.
fn ordered(
    band: &Band,
    wires: &Wires,
    nets: &HashMap<Net, NetEnds>,
    drawing: &Drawing,
) -> Vec<usize> {
    let key = |at: usize| {
        let symbol = &drawing.symbols[at];
        Reverse((symbol.row, symbol.columns.start, at))
    };
    let mut unfed: HashMap<usize, usize> = HashMap::new();
    let mut waiting: HashMap<Net, usize> = HashMap::new();
    let mut ready = BinaryHeap::new();
    for &at in &band.symbols {
        let feeds = wires.ends[at]
            .left
            .iter()
            .filter_map(|end| nets.get(&end.net));
        let count = feeds.filter(|net| !net.sources.is_empty()).count();
        unfed.insert(at, count);
        if count == 0 {
            ready.push(key(at));
        }
        for end in &wires.ends[at].right {
            *waiting.entry(end.net).or_default() += 1;
        }
    }
    let mut order = Vec::with_capacity(band.symbols.len());
    while let Some(Reverse((.., at))) = ready.pop() {
        order.push(at);
        unfed.remove(&at);
        for end in &wires.ends[at].right {
            let Some(left) = waiting.get_mut(&end.net) else {
                continue;
            };
            *left -= 1;
            if *left > 0 {
                continue;
            }
            for sink in nets.get(&end.net).map_or(&[][..], |net| &net.sinks) {
                if let Some(count) = unfed.get_mut(sink) {
                    *count -= 1;
                    if *count == 0 {
                        ready.push(key(*sink));
                    }
                }
            }
        }
    }
    let mut circles: Vec<usize> = unfed.into_keys().collect();
    circles.sort_unstable();
    order.extend(circles);
    order
}

/// A rung being drawn.
struct Drawn<'d> {
    grid: &'d Grid,
    drawing: &'d Drawing,
    wires: &'d Wires,
    nets: &'d HashMap<Net, NetEnds>,
    kinds: &'d [ElementKind],
    builder: NetworkBuilder,
    nodes: HashMap<usize, NodeIndex>,
    gates: HashMap<Net, NodeIndex>,
    first_label: Option<usize>,
}

impl<'d> Drawn<'d> {
    fn new(
        grid: &'d Grid,
        drawing: &'d Drawing,
        wires: &'d Wires,
        nets: &'d HashMap<Net, NetEnds>,
        kinds: &'d [ElementKind],
        row: usize,
    ) -> Self {
        let rail = grid.span(row, wires.rail_column..wires.rail_column + 1);
        Self {
            grid,
            drawing,
            wires,
            nets,
            kinds,
            builder: NetworkBuilder::new(rail),
            nodes: HashMap::new(),
            gates: HashMap::new(),
            first_label: None,
        }
    }

    fn label(&mut self, row: usize, name: &str, span: Span) {
        let label = ElementKind::Label(Operand::new(name, span));
        self.builder.add_after(&[Network::rail()], label, span);
        self.first_label.get_or_insert(row);
    }

    fn add(&mut self, at: usize, diagnostics: &mut Vec<Diagnostic>) {
        let span = element::place(self.grid, &self.drawing.symbols[at]);
        let left = &self.wires.ends[at].left;
        let sources: Vec<_> = left.iter().map(|end| self.sources(end)).collect();
        let kind = &self.kinds[at];
        let node = self.builder.add(kind.clone(), span);
        self.nodes.insert(at, node);
        let mut is_fed = false;
        let mut loops = false;
        for (end, sources) in left.iter().zip(sources) {
            let to = element::port(kind, end.pin.as_deref(), true);
            for source in sources {
                let Some((from, port)) = source else {
                    loops = true;
                    continue;
                };
                let wire = Wire {
                    from: port,
                    to: to.clone(),
                    ..Wire::default()
                };
                is_fed = true;
                loops |= !self.builder.join(from, node, wire);
            }
        }
        if loops {
            diagnostics.push(
                Diagnostic::new(
                    codes::NETWORK_LOOP,
                    span,
                    "the wire behind this element leads back to what is before it",
                )
                .help("power flows from left to right; the wire back is not followed"),
            );
        } else if !is_fed {
            diagnostics.push(
                Diagnostic::new(
                    codes::DANGLING_CONNECTION,
                    span,
                    "no wire leads here from the left rail, so it never has power",
                )
                .help("join it with `-`, `|` and `+`; only `+` turns a wire"),
            );
        }
    }

    /// What feeds an end: elements with the port that the wire leaves from,
    /// nothing for one that is not solved yet.
    fn sources(&mut self, end: &End) -> Vec<Option<(NodeIndex, Port)>> {
        if end.net == self.wires.rail {
            return vec![Some((Network::rail(), Port::Power))];
        }
        if let Some(gate) = self.gates.get(&end.net) {
            return vec![Some((*gate, Port::Power))];
        }
        let nets = self.nets;
        let Some(net) = nets.get(&end.net) else {
            return Vec::new();
        };
        let feeds: Vec<_> = net
            .sources
            .iter()
            .map(|source| self.source(*source))
            .collect();
        if net.sinks.len() < 2 || net.sources.len() * net.sinks.len() <= MOST_WIRES {
            return feeds;
        }
        let mut ends = Vec::new();
        if feeds.iter().any(Option::is_none) {
            ends.push(None);
        }
        let at = element::place(self.grid, &self.drawing.symbols[net.sources[0].0]);
        let place = Span::at(at.end as usize);
        let gate = self.builder.add(ElementKind::Gate(Gate::Or), place);
        for (from, port) in feeds.into_iter().flatten() {
            let wire = Wire {
                from: port,
                ..Wire::default()
            };
            let joined = self.builder.join(from, gate, wire);
            debug_assert!(joined, "a gate comes after what feeds it");
        }
        self.gates.insert(end.net, gate);
        ends.push(Some((gate, Port::Power)));
        ends
    }

    fn source(&self, (symbol, end): (usize, usize)) -> Option<(NodeIndex, Port)> {
        let node = *self.nodes.get(&symbol)?;
        let pin = self.wires.ends[symbol].right[end].pin.as_deref();
        Some((node, element::port(&self.kinds[symbol], pin, false)))
    }

    /// The bytes of the rung: the label above it, its rows, and the rows of
    /// the words that belong to it.
    fn rows(&self, first: usize, last: usize) -> Span {
        let taken = |row: &usize| {
            let words = self.drawing.words.get(*row);
            words.is_some_and(|words| words.iter().any(|word| word.taken))
        };
        let boxes = self
            .nodes
            .keys()
            .filter_map(|&at| match &self.drawing.symbols[at].kind {
                super::symbols::SymbolKind::Box(found) => Some(found.rows.clone()),
                _ => None,
            });
        let (mut first, mut last) = boxes.fold((first, last), |(first, last), rows| {
            (first.min(rows.start), last.max(rows.end.saturating_sub(1)))
        });
        if let Some(above) = first.checked_sub(1).filter(taken) {
            first = above;
        }
        if self.compares_in(last) && taken(&(last + 1)) {
            last += 1;
        }
        let rows = self.first_label.unwrap_or(first).min(first)..=last;
        let spans = rows.filter_map(|row| self.grid.row_span(row));
        spans.reduce(Span::cover).unwrap_or_default()
    }

    /// Whether an element of a row has a word below it.
    fn compares_in(&self, row: usize) -> bool {
        self.nodes.keys().any(|&at| {
            self.drawing.symbols[at].row == row
                && matches!(self.kinds[at], ElementKind::Comparison(_))
        })
    }
}

/// Says which words belong to no element.
fn report_words(drawing: &Drawing, diagnostics: &mut Vec<Diagnostic>) {
    for word in drawing.words.iter().flatten().filter(|word| !word.taken) {
        diagnostics.push(
            Diagnostic::new(
                codes::LADDER_SYNTAX,
                word.span,
                format!("`{}` belongs to no element", word.text),
            )
            .help("write a name above its element, touching its columns; comments as `(* text *)`"),
        );
    }
}
