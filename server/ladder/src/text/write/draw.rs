//! Draws a rung with characters, as ladders are drawn on paper.
//!
//! ```text
//! ┬──[ v2 ]────────────┬──[/ls3]──┬──[/tl]──┬──( v2 )
//! └──[ ls2 ]────[/as]──┘          └──[/as]──┘
//! ```

use petgraph::graph::NodeIndex;
use unicode_width::UnicodeWidthStr;

use super::cuts::TooTangled;
use super::legs::{Driven, Leg, legs};
use super::output::output;
use super::part::{self, Kind, Part};
use crate::{CoilKind, ContactKind, Element, ElementKind, Network};

/// Wider or higher rungs are not drawn: nobody could take them in.
const WIDEST: usize = 400;
const HIGHEST: usize = 60;

/// The rung as lines of characters without line ends at the end; `None` if it
/// is empty, or too large or too tangled to be drawn.
pub fn draw(network: &Network) -> Option<String> {
    if network.is_empty() {
        return None;
    }
    let legs: Result<Vec<Leg>, TooTangled> = legs(network);
    let legs = legs.ok()?;
    let element = |at: NodeIndex| network.element(at);
    let picture = leg(legs.first()?, &legs, &element)?;
    let fits = picture.width <= WIDEST && picture.lines.len() <= HIGHEST;
    fits.then(|| {
        let lines = picture.lines.iter().map(|line| line.trim_end());
        lines.collect::<Vec<_>>().join("\n")
    })
}

/// A part of a rung. Power comes in at the left of the first line, and goes on
/// at its right. All lines are equally wide.
struct Picture {
    lines: Vec<String>,
    width: usize,
}

impl Picture {
    fn of(text: String) -> Self {
        Self {
            width: text.width(),
            lines: vec![text],
        }
    }

    fn wire() -> Self {
        Self::of(String::new())
    }
}

/// What stands before a line of something that has several: nothing goes on
/// there.
fn blank(width: usize) -> String {
    " ".repeat(width)
}

fn dashes(width: usize) -> String {
    "─".repeat(width)
}

/// One after the other.
fn series(first: Picture, then: Picture) -> Picture {
    let height = first.lines.len().max(then.lines.len());
    let width = first.width + then.width;
    let line = |picture: &Picture, at: usize| {
        let line = picture.lines.get(at).cloned();
        line.unwrap_or_else(|| blank(picture.width))
    };
    Picture {
        lines: (0..height)
            .map(|at| line(&first, at) + &line(&then, at))
            .collect(),
        width,
    }
}

/// One above the other. Power comes in to all; where they are `joined` it goes
/// on from all.
fn parallel(legs: Vec<Picture>, joined: Joined) -> Picture {
    let inner = legs.iter().map(|leg| leg.width).max().unwrap_or_default();
    let last = legs.len().saturating_sub(1);
    let mut lines = Vec::new();
    for (place, leg) in legs.into_iter().enumerate() {
        for (at, line) in leg.lines.into_iter().enumerate() {
            let (left, right) = match (place, at) {
                (0, 0) => ('┬', '┬'),
                (place, 0) if place == last => ('└', '┘'),
                (_, 0) => ('├', '┤'),
                (place, _) if place == last => (' ', ' '),
                _ => ('│', '│'),
            };
            let fill = inner - leg.width;
            lines.push(match (joined, at) {
                (Joined::Yes, 0) => format!("{left}{line}{}{right}", dashes(fill)),
                (Joined::Yes, _) => format!("{left}{line}{}{right}", blank(fill)),
                (Joined::No, _) => format!("{left}{line}{}", blank(fill)),
            });
        }
    }
    let connections = match joined {
        Joined::Yes => 2,
        Joined::No => 1,
    };
    Picture {
        lines,
        width: inner + connections,
    }
}

/// Whether legs come together again.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Joined {
    Yes,
    No,
}

/// A leg with all that it drives.
fn leg<'n>(it: &Leg, legs: &[Leg], element: &impl Fn(NodeIndex) -> &'n Element) -> Option<Picture> {
    let condition = match it.condition.is_always() {
        true => Picture::of("──".to_owned()),
        false => condition(&it.condition, element)?,
    };
    let mut driven = Vec::with_capacity(it.drives.len());
    for drive in &it.drives {
        driven.push(match drive {
            Driven::Output(at) => Picture::of(format!("──{}", spelled(&element(*at).kind))),
            // An inner leg has a greater number, so this comes to an end.
            Driven::Leg(inner) => leg(legs.get(*inner)?, legs, element)?,
        });
    }
    Some(match driven.len() {
        0 => condition,
        1 => series(condition, driven.pop()?),
        _ => series(condition, parallel(driven, Joined::No)),
    })
}

/// A condition. Nests as deep as its part does, which the writer bounds.
fn condition<'n>(part: &Part, element: &impl Fn(NodeIndex) -> &'n Element) -> Option<Picture> {
    match &part.kind {
        Kind::And(parts) => {
            let mut all = Picture::wire();
            for part in parts {
                all = series(all, condition(part, element)?);
                if all.width > WIDEST {
                    return None;
                }
            }
            Some(all)
        }
        Kind::Or(parts) if !parts.is_empty() => {
            let legs: Option<Vec<Picture>> =
                parts.iter().map(|part| condition(part, element)).collect();
            let legs = legs?;
            let height: usize = legs.iter().map(|leg| leg.lines.len()).sum();
            (height <= HIGHEST).then(|| parallel(legs, Joined::Yes))
        }
        Kind::Element(at) => Some(contact(&element(*at).kind, part, element)),
        _ => Some(Picture::of(format!(
            "──[ {} ]──",
            part::text(part, element)
        ))),
    }
}

fn contact<'n>(
    kind: &ElementKind,
    part: &Part,
    element: &impl Fn(NodeIndex) -> &'n Element,
) -> Picture {
    Picture::of(match kind {
        ElementKind::Contact(contact) => {
            let name = &contact.operand.name;
            match contact.kind {
                ContactKind::Open => format!("──[ {name} ]──"),
                ContactKind::Closed => format!("──[/{name}]──"),
                ContactKind::Rising => format!("──[P {name}]──"),
                ContactKind::Falling => format!("──[N {name}]──"),
            }
        }
        _ => format!("──[ {} ]──", part::text(part, element)),
    })
}

/// An output as it is drawn.
fn spelled(kind: &ElementKind) -> String {
    match kind {
        ElementKind::Coil(coil) => {
            let name = &coil.operand.name;
            match coil.kind {
                CoilKind::Plain => format!("( {name} )"),
                CoilKind::Negated => format!("(/{name})"),
                CoilKind::Set => format!("(S {name})"),
                CoilKind::Reset => format!("(R {name})"),
                CoilKind::Rising => format!("(P {name})"),
                CoilKind::Falling => format!("(N {name})"),
            }
        }
        kind => format!("[ {} ]", output(kind).0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(rung: &str, wanted: &[&str]) {
        let program = crate::read(rung.as_bytes()).program;
        let network = &program.routines[0].rungs[0].network;
        let drawn = draw(network).expect("a drawing");
        assert_eq!(drawn.lines().collect::<Vec<_>>(), wanted, "\n{drawn}");
    }

    #[test]
    fn legs_come_together_again() {
        check(
            "rung: (v2 + ls2*/as) * /ls3 * (/tl + /as) -> v2",
            &[
                "┬──[ v2 ]────────────┬──[/ls3]──┬──[/tl]──┬──( v2 )",
                "└──[ ls2 ]────[/as]──┘          └──[/as]──┘",
            ],
        );
    }

    #[test]
    fn outputs_branch_off() {
        check(
            "rung: a -> set x, (b -> /y), TON(t1, 5s)",
            &[
                "──[ a ]──┬──(S x)",
                "         ├──[ b ]────(/y)",
                "         └──[ TON(t1, 5s) ]",
            ],
        );
    }

    #[test]
    fn branches_stand_in_branches() {
        check(
            "rung: (a * (b + c) + d) -> x",
            &[
                "┬──[ a ]──┬──[ b ]──┬┬──( x )",
                "│         └──[ c ]──┘│",
                "└──[ d ]─────────────┘",
            ],
        );
    }

    #[test]
    fn comparisons_and_edges_stand_in_brackets() {
        check(
            "rung: rise(a + b) * n > 3 -> x",
            &["──[ rise(a + b) ]────[ n > 3 ]────( x )"],
        );
    }

    #[test]
    fn a_rung_that_is_always_on_is_a_wire() {
        check("rung: 1 -> x", &["────( x )"]);
    }
}
