//! Draws the condition of a rung as a network.
//!
//! A product is contacts in series, a sum is legs in parallel. A complement is
//! pushed down to the contacts (De Morgan), so that `/(a*b)` shows two normally
//! closed contacts; only an edge cannot be complemented in a contact and is
//! inverted on the wire. An edge of more than a variable, `rise(a*b)`, looks at
//! that expression alone, whatever stands left of it in the rung: it is drawn
//! from the rail, and a gate joins it with the power that comes from the left.

use logic::notation::{Node, NodeKind, Token};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span};

use super::drive::drive;
use super::findings::syntax;
use super::names::Names;
use super::syntax::RungText;
use crate::reading::Source;
use crate::{
    Block, Comparison, Contact, ContactKind, Edge, ElementKind, Familiarity, Gate, Network,
    NetworkBuilder, OneShot, Operand, Placed, Port, Wire,
};

/// Draws a rung that stands at `span`.
pub(super) fn network(
    rung: &RungText,
    span: Span,
    source: Source<'_>,
    names: &mut Names<'_>,
    findings: &mut Vec<Diagnostic>,
) -> Placed {
    let mut drawing = Drawing {
        builder: NetworkBuilder::new(place(source, Span::at(span.range().start))),
        source,
        names,
        findings,
    };
    let mut power = vec![Network::rail()];
    if let Some(label) = rung.label {
        let operand = drawing.operand(label);
        power = vec![drawing.after(&power, ElementKind::Label(operand), label.span)];
    }
    drive(&mut drawing, &rung.leg, &power);
    drawing.builder.finish()
}

/// The place in the file of a place in the text.
pub(super) fn place(source: Source<'_>, span: Span) -> Span {
    source.span(span.range().start, span.range().end)
}

/// A network that is being drawn. Places are those of the text; what is drawn
/// gets its place in the file.
pub(super) struct Drawing<'d, 'n> {
    pub(super) builder: NetworkBuilder,
    pub(super) source: Source<'d>,
    pub(super) names: &'d mut Names<'n>,
    pub(super) findings: &'d mut Vec<Diagnostic>,
}

/// Where power comes from: any of these elements. Never empty.
pub(super) type Power = Vec<NodeIndex>;

/// Every leg of a parallel connection is wired to every source, so two sums in
/// series would take as many wires as the product of their legs. Power from
/// more sources than this is joined first.
const MOST_SOURCES: usize = 32;

impl Drawing<'_, '_> {
    /// The variable that a token names.
    pub(super) fn operand(&mut self, token: Token) -> Operand {
        let spelling = token.name(self.source.text);
        self.variable(spelling, token.span)
    }

    fn variable(&mut self, spelling: &str, span: Span) -> Operand {
        Operand::new(self.names.fold(spelling), place(self.source, span))
    }

    /// Draws an element that `power` reaches.
    pub(super) fn after(
        &mut self,
        power: &[NodeIndex],
        kind: ElementKind,
        span: Span,
    ) -> NodeIndex {
        let span = place(self.source, span);
        self.builder.add_after(power, kind, span)
    }

    /// Draws a condition that `from` feeds. `None` if it passes all power on
    /// as it is.
    pub(super) fn condition(&mut self, node: &Node, from: &[NodeIndex]) -> Option<Power> {
        self.part(node, node.span, Sense::Direct, from)
    }

    /// What could not be read, kept as a box that nobody knows.
    pub(super) fn opaque(&mut self, span: Span, shapes_power: bool, from: &[NodeIndex]) -> Power {
        let text = self.source.text.get(span.range()).unwrap_or_default();
        let block = Block {
            name: text.trim().into(),
            instance: None,
            pins: Vec::new(),
            familiarity: Familiarity::Unknown,
            shapes_power,
        };
        vec![self.after(from, ElementKind::Block(block), span)]
    }

    /// `whole` is the place of the node with the complement before it.
    fn part(
        &mut self,
        node: &Node,
        whole: Span,
        sense: Sense,
        from: &[NodeIndex],
    ) -> Option<Power> {
        match (&node.kind, sense) {
            (NodeKind::Not(inner), _) => {
                let place = match inner.kind {
                    NodeKind::And(_) | NodeKind::Or(_) => inner.span,
                    _ => whole,
                };
                self.part(inner, place, sense.opposite(), from)
            }
            (NodeKind::Constant(value), _) => {
                let passes = *value == (sense == Sense::Direct);
                (!passes).then(|| vec![self.after(from, ElementKind::Open, whole)])
            }
            (NodeKind::Variable(name), _) => {
                let kind = match sense {
                    Sense::Direct => ContactKind::Open,
                    Sense::Complement => ContactKind::Closed,
                };
                Some(vec![self.contact(name, node.span, kind, whole, from)])
            }
            (
                NodeKind::Comparison {
                    left,
                    relation,
                    right,
                },
                _,
            ) => {
                let comparison = Comparison {
                    left: self.variable(&left.0, left.1),
                    relation: match sense {
                        Sense::Direct => *relation,
                        Sense::Complement => relation.complement(),
                    },
                    right: self.variable(&right.0, right.1),
                };
                Some(vec![self.after(
                    from,
                    ElementKind::Comparison(comparison),
                    whole,
                )])
            }
            (NodeKind::Rise(inner), _) => Some(self.edge(Edge::Rising, inner, whole, sense, from)),
            (NodeKind::Fall(inner), _) => Some(self.edge(Edge::Falling, inner, whole, sense, from)),
            (NodeKind::Elapsed { time, .. }, _) => {
                let finding = syntax(node.span, "a ladder has no steps whose time could be taken")
                    .help(format!(
                        "drive a timer, `TON(t1, {time})`, and read its output `t1.Q`"
                    ));
                self.findings.push(finding);
                Some(self.opaque(node.span, true, from))
            }
            (NodeKind::And(parts), Sense::Direct) | (NodeKind::Or(parts), Sense::Complement) => {
                self.series(parts, sense, from)
            }
            (NodeKind::Or(parts), Sense::Direct) | (NodeKind::And(parts), Sense::Complement) => {
                self.parallel(parts, node.span, sense, from)
            }
        }
    }

    fn contact(
        &mut self,
        name: &str,
        span: Span,
        kind: ContactKind,
        whole: Span,
        from: &[NodeIndex],
    ) -> NodeIndex {
        let operand = self.variable(name, span);
        let contact = ElementKind::Contact(Contact { operand, kind });
        self.after(from, contact, whole)
    }

    fn series(&mut self, parts: &[Node], sense: Sense, from: &[NodeIndex]) -> Option<Power> {
        let mut power: Option<Power> = None;
        for part in parts {
            let reached = power.as_deref().unwrap_or(from);
            power = self.part(part, part.span, sense, reached).or(power);
        }
        power
    }

    fn parallel(
        &mut self,
        parts: &[Node],
        span: Span,
        sense: Sense,
        from: &[NodeIndex],
    ) -> Option<Power> {
        let joined = self.joined(from, span);
        let first_new = self.builder.len();
        let mut all = Power::new();
        let mut bypassed = false;
        for part in parts {
            let Some(mut power) = self.part(part, part.span, sense, &joined) else {
                bypassed = true;
                continue;
            };
            // A leg may have a bypass of its own; one is enough.
            let legs = power.len();
            power.retain(|source| source.index() >= first_new);
            bypassed |= power.len() < legs;
            all.extend(power);
        }
        if bypassed {
            all.extend(&joined);
        }
        Some(all)
    }

    /// The same power from few enough sources.
    pub(super) fn joined(&mut self, power: &[NodeIndex], span: Span) -> Power {
        if power.len() <= MOST_SOURCES {
            return power.to_vec();
        }
        vec![self.after(power, ElementKind::Gate(Gate::Or), span)]
    }

    fn edge(
        &mut self,
        edge: Edge,
        inner: &Node,
        whole: Span,
        sense: Sense,
        from: &[NodeIndex],
    ) -> Power {
        let rail = [Network::rail()];
        let simple = match &inner.kind {
            NodeKind::Variable(name) => Some(name),
            _ => None,
        };
        let feed: &[NodeIndex] = match (simple, sense) {
            (Some(_), Sense::Direct) => from,
            _ => &rail,
        };
        let mut passed = match simple {
            Some(name) => {
                let kind = match edge {
                    Edge::Rising => ContactKind::Rising,
                    Edge::Falling => ContactKind::Falling,
                };
                self.contact(name, inner.span, kind, whole, feed)
            }
            None => {
                let power = self.condition(inner, feed);
                let shot = OneShot { edge, memory: None };
                self.after(
                    power.as_deref().unwrap_or(feed),
                    ElementKind::OneShot(shot),
                    whole,
                )
            }
        };
        if sense == Sense::Complement {
            passed = self.after(&[passed], ElementKind::Invert, whole);
        }
        if feed == from {
            return vec![passed];
        }
        vec![self.both(from, passed, whole)]
    }

    /// A gate that passes power while both `from` and `other` give some.
    fn both(&mut self, from: &[NodeIndex], other: NodeIndex, whole: Span) -> NodeIndex {
        let gate = self.after(&[], ElementKind::Gate(Gate::And), whole);
        let pin = |name: &str| Wire {
            to: Port::Pin(name.into()),
            ..Wire::default()
        };
        // The gate is the newest element: no wire to it can close a circle.
        for source in from {
            let _ = self.builder.join(*source, gate, pin("IN1"));
        }
        let _ = self.builder.join(other, gate, pin("IN2"));
        gate
    }
}

/// Whether a part is drawn as it is or as its complement.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sense {
    Direct,
    Complement,
}

impl Sense {
    fn opposite(self) -> Self {
        match self {
            Self::Direct => Self::Complement,
            Self::Complement => Self::Direct,
        }
    }
}
