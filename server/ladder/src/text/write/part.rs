//! A part of a condition on its way from a network to text.

use std::collections::VecDeque;

use logic::Name;
use logic::notation::{milliseconds, quoted, quoted_value};
use petgraph::graph::NodeIndex;

use crate::{Comparison, ContactKind, Element, ElementKind};

/// An expression over the elements of a network.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// What an element adds to the power that it gets: a contact, a comparison.
    Element(NodeIndex),
    /// A variable that stands for the output of a box.
    Variable(Name),
    /// `/a`
    Not(Box<Part>),
    /// `rise(a)`
    Rise(Box<Part>),
    /// `fall(a)`
    Fall(Box<Part>),
    /// `a*b`; always on when empty.
    And(VecDeque<Part>),
    /// `a + b`; never on when empty.
    Or(Vec<Part>),
}

/// Always on.
pub(super) fn always() -> Part {
    Part::And(VecDeque::new())
}

/// `first*then`
pub(super) fn series(first: Part, then: Part) -> Part {
    match (first, then) {
        (Part::And(first), Part::And(mut then)) if first.len() < then.len() => {
            first
                .into_iter()
                .rev()
                .for_each(|part| then.push_front(part));
            Part::And(then)
        }
        (Part::And(mut first), Part::And(then)) => {
            first.extend(then);
            Part::And(first)
        }
        (first, Part::And(mut parts)) => {
            parts.push_front(first);
            Part::And(parts)
        }
        (Part::And(mut parts), then) => {
            parts.push_back(then);
            Part::And(parts)
        }
        (first, then) => Part::And([first, then].into()),
    }
}

/// The sum of `legs`.
pub(super) fn parallel(legs: Vec<Part>) -> Part {
    let mut all = Vec::with_capacity(legs.len());
    for leg in legs {
        match leg {
            Part::Or(more) => all.extend(more),
            leg => all.push(leg),
        }
    }
    if all.len() == 1 {
        return all.pop().unwrap_or_else(always);
    }
    Part::Or(all)
}

impl Part {
    /// Whether power passes unchanged.
    pub(super) fn is_always(&self) -> bool {
        match self {
            Self::And(parts) => parts.iter().all(Self::is_always),
            _ => false,
        }
    }

    /// Number of elements and variables in it.
    pub(super) fn size(&self) -> usize {
        match self {
            Self::Element(_) | Self::Variable(_) => 1,
            Self::Not(inner) | Self::Rise(inner) | Self::Fall(inner) => inner.size(),
            Self::And(parts) => parts.iter().map(Self::size).sum::<usize>().max(1),
            Self::Or(parts) => parts.iter().map(Self::size).sum::<usize>().max(1),
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

/// The part as text; `element` gives what a [`Part::Element`] stands for.
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
    match part {
        Part::Variable(name) => text.push_str(&quoted(name)),
        Part::Element(at) => match &element(*at).kind {
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
        Part::Not(inner) => enclosed(around == Around::Complement, text, |text| {
            text.push('/');
            write(inner, Around::Complement, element, text);
        }),
        Part::Rise(inner) | Part::Fall(inner) => {
            text.push_str(if matches!(part, Part::Rise(_)) {
                "rise("
            } else {
                "fall("
            });
            write(inner, Around::Nothing, element, text);
            text.push(')');
        }
        Part::And(parts) => match parts.len() {
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
        Part::Or(parts) if parts.is_empty() => text.push('0'),
        Part::Or(parts) => enclosed(around > Around::Sum, text, |text| {
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
