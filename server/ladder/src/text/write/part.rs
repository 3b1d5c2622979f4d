//! A part of a condition on its way from a network to text.

use std::collections::VecDeque;

use logic::Name;
use logic::notation::{milliseconds, quoted, quoted_value};
use petgraph::graph::NodeIndex;

use crate::{Comparison, ContactKind, Edge, Element, ElementKind};

/// An expression over the elements of a network, and how deep it nests.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) kind: Kind,
    /// How many levels lie below; counted as it is built, since a network may
    /// nest deeper than the stack is.
    pub(super) nested: usize,
}

/// What an expression is.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// What an element adds to the power that it gets: a contact, a comparison.
    Element(NodeIndex),
    /// A variable that stands for the output of a box.
    Variable(Name),
    /// `/a`
    Not(Box<Part>),
    /// `rise(a)` or `fall(a)`
    Edge(Edge, Box<Part>),
    /// `a*b`; always on when empty.
    And(VecDeque<Part>),
    /// `a + b`; never on when empty.
    Or(Vec<Part>),
}

/// Always on.
pub(super) fn always() -> Part {
    leaf(Kind::And(VecDeque::new()))
}

/// Never on.
pub(super) fn never() -> Part {
    leaf(Kind::Or(Vec::new()))
}

/// An element of the network.
pub(super) fn element(at: NodeIndex) -> Part {
    leaf(Kind::Element(at))
}

/// A variable.
pub(super) fn variable(name: Name) -> Part {
    leaf(Kind::Variable(name))
}

fn leaf(kind: Kind) -> Part {
    Part { kind, nested: 0 }
}

/// `/part`
pub(super) fn complement(part: Part) -> Part {
    Part {
        nested: part.nested + 1,
        kind: Kind::Not(Box::new(part)),
    }
}

/// `rise(part)` or `fall(part)`
pub(super) fn edge_of(edge: Edge, part: Part) -> Part {
    Part {
        nested: part.nested + 1,
        kind: Kind::Edge(edge, Box::new(part)),
    }
}

/// `first*then`
pub(super) fn series(first: Part, then: Part) -> Part {
    let level = |part: &Part| match part.kind {
        Kind::And(_) => part.nested,
        _ => part.nested + 1,
    };
    let nested = level(&first).max(level(&then));
    let parts = match (first.kind, then.kind) {
        (Kind::And(first), Kind::And(mut then)) if first.len() < then.len() => {
            first
                .into_iter()
                .rev()
                .for_each(|part| then.push_front(part));
            then
        }
        (Kind::And(mut first), Kind::And(then)) => {
            first.extend(then);
            first
        }
        (kind, Kind::And(mut then)) => {
            then.push_front(Part {
                kind,
                nested: first.nested,
            });
            then
        }
        (Kind::And(mut first), kind) => {
            first.push_back(Part {
                kind,
                nested: then.nested,
            });
            first
        }
        (a, b) => [(a, first.nested), (b, then.nested)]
            .map(|(kind, nested)| Part { kind, nested })
            .into(),
    };
    Part {
        kind: Kind::And(parts),
        nested,
    }
}

/// The sum of `legs`.
pub(super) fn parallel(legs: Vec<Part>) -> Part {
    let mut all = Vec::with_capacity(legs.len());
    for leg in legs {
        match leg.kind {
            Kind::Or(more) => all.extend(more),
            kind => all.push(Part {
                kind,
                nested: leg.nested,
            }),
        }
    }
    if all.len() == 1 {
        return all.pop().unwrap_or_else(never);
    }
    Part {
        nested: all.iter().map(|leg| leg.nested + 1).max().unwrap_or(0),
        kind: Kind::Or(all),
    }
}

impl Part {
    /// Whether power passes unchanged.
    pub(super) fn is_always(&self) -> bool {
        match &self.kind {
            Kind::And(parts) => parts.iter().all(Self::is_always),
            _ => false,
        }
    }

    /// Number of elements and variables in it.
    pub(super) fn size(&self) -> usize {
        match &self.kind {
            Kind::Element(_) | Kind::Variable(_) => 1,
            Kind::Not(inner) | Kind::Edge(_, inner) => inner.size(),
            Kind::And(parts) => parts.iter().map(Self::size).sum::<usize>().max(1),
            Kind::Or(parts) => parts.iter().map(Self::size).sum::<usize>().max(1),
        }
    }
}

/// What stands around a part, loosest first.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Around {
    Nothing,
    Sum,
    Product,
    Complement,
}

/// The part as text; `element` gives what a [`Kind::Element`] stands for.
pub(super) fn text<'n>(part: &Part, element: &impl Fn(NodeIndex) -> &'n Element) -> String {
    let mut text = String::new();
    write(part, Around::Nothing, element, &mut text);
    text
}

fn write<'n>(
    part: &Part,
    around: Around,
    element: &impl Fn(NodeIndex) -> &'n Element,
    text: &mut String,
) {
    match &part.kind {
        Kind::Variable(name) => text.push_str(&quoted(name)),
        Kind::Element(at) => match &element(*at).kind {
            ElementKind::Contact(contact) => {
                let name = quoted(&contact.operand.name);
                text.push_str(&match contact.kind {
                    ContactKind::Open => name,
                    // Two slashes would begin a comment.
                    ContactKind::Closed if around == Around::Complement => format!("(/{name})"),
                    ContactKind::Closed => format!("/{name}"),
                    ContactKind::Rising => format!("rise({name})"),
                    ContactKind::Falling => format!("fall({name})"),
                });
            }
            ElementKind::Comparison(comparison) => {
                enclosed(around > Around::Nothing, text, |text| {
                    text.push_str(&compared(comparison));
                });
            }
            ElementKind::Open => text.push('0'),
            _ => text.push('1'),
        },
        Kind::Not(inner) => enclosed(around == Around::Complement, text, |text| {
            text.push('/');
            write(inner, Around::Complement, element, text);
        }),
        Kind::Edge(edge, inner) => {
            text.push_str(match edge {
                Edge::Rising => "rise(",
                Edge::Falling => "fall(",
            });
            write(inner, Around::Nothing, element, text);
            text.push(')');
        }
        Kind::And(parts) => match parts.len() {
            0 => text.push('1'),
            1 => parts
                .iter()
                .for_each(|part| write(part, around, element, text)),
            _ => enclosed(around > Around::Product, text, |text| {
                for (at, part) in parts.iter().enumerate() {
                    if at > 0 {
                        text.push('*');
                    }
                    write(part, Around::Product, element, text);
                }
            }),
        },
        Kind::Or(parts) if parts.is_empty() => text.push('0'),
        Kind::Or(parts) => enclosed(around > Around::Sum, text, |text| {
            for (at, part) in parts.iter().enumerate() {
                if at > 0 {
                    text.push_str(" + ");
                }
                write(part, Around::Sum, element, text);
            }
        }),
    }
}

fn enclosed(parentheses: bool, text: &mut String, write: impl FnOnce(&mut String)) {
    if parentheses {
        text.push('(');
    }
    write(text);
    if parentheses {
        text.push(')');
    }
}

/// A comparison; a time stands on its right.
fn compared(comparison: &Comparison) -> String {
    let (left, right) = (&comparison.left.name, &comparison.right.name);
    let (left, relation, right) = if milliseconds(left).is_some() {
        (right, comparison.relation.mirrored(), left)
    } else {
        (left, comparison.relation, right)
    };
    format!(
        "{} {} {}",
        quoted_value(left),
        relation.sign(),
        quoted_value(right)
    )
}
