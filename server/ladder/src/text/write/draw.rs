//! Draws a rung with characters, as ladders are drawn on paper.
//!
//! ```text
//! ┬──[ v2 ]────────────┬──[/ls3]──┬──[/tl]──┬──( v2 )
//! └──[ ls2 ]────[/as]──┘          └──[/as]──┘
//! ```

use std::borrow::Cow;

use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use super::legs::{Driven, Leg, legs};
use super::output::output;
use super::part::{self, Kind, Part};
use crate::{CoilKind, ContactKind, ElementKind, Network};

/// Higher rungs are not drawn: nobody could take them in.
const HIGHEST: usize = 60;

/// The rung as lines of characters, none wider than `width` columns, without a
/// line end at the end; `None` if it is empty, or too large or too tangled to be
/// drawn. What is wider goes on below, as on paper: `─→` leaves a line, `→─`
/// takes it up. Long names and boxes are cut.
///
/// ```text
/// ──[ Start ]────[/Stop]───→
/// →───[ Ready ]────( Run )
/// ```
pub fn draw(network: &Network, width: usize) -> Option<String> {
    if network.is_empty() {
        return None;
    }
    let legs = legs(network).ok()?;
    let drawing = Drawing::of(&legs, network, width)?;
    let picture = drawing.leg(0, width)?;
    let fits = picture.width <= width && picture.lines.len() <= HIGHEST;
    fits.then(|| {
        let lines = picture.lines.iter().map(|line| line.trim_end());
        lines.collect::<Vec<_>>().join("\n")
    })
}

/// The legs of a rung, of which each is sketched.
struct Drawing<'n> {
    network: &'n Network,
    legs: &'n [Leg],
    sketches: Vec<Sketch>,
    /// Of the whole drawing.
    width: usize,
}

/// A leg before it is laid out in lines.
struct Sketch {
    /// What power goes through, one after the other. A line can be broken
    /// between them, where one wire alone goes on.
    pieces: Vec<Picture>,
    /// How wide the leg is with all that it drives, in one line.
    width: usize,
}

/// What leaves a line that goes on below, and what takes it up there.
const ONWARD: &str = "─→";
const TAKEN_UP: &str = "→─";
const ARROW: usize = 2;

impl<'n> Drawing<'n> {
    fn of(legs: &'n [Leg], network: &'n Network, width: usize) -> Option<Self> {
        let mut sketches: Vec<Sketch> = Vec::with_capacity(legs.len());
        // A leg has a smaller number than those that it drives.
        for leg in legs.iter().rev() {
            let pieces = match &leg.condition.kind {
                Kind::And(parts) if parts.is_empty() => vec![Picture::of("──".to_owned())],
                Kind::And(parts) => {
                    let all = parts.iter().map(|it| condition(it, network, width));
                    all.collect::<Option<Vec<_>>>()?
                }
                _ => vec![condition(&leg.condition, network, width)?],
            };
            let driven = leg.drives.iter().map(|it| match it {
                Driven::Output(at) => drawn_output(&network.element(*at).kind, width).width,
                Driven::Leg(inner) => {
                    let behind = legs.len().checked_sub(inner + 1);
                    let sketch = behind.and_then(|behind| sketches.get(behind));
                    sketch.map_or(usize::MAX, |it| it.width)
                }
            });
            let driven = driven.max().unwrap_or_default();
            let connection = usize::from(leg.drives.len() > 1);
            let condition: usize = pieces.iter().map(|it| it.width).sum();
            sketches.push(Sketch {
                pieces,
                width: condition.saturating_add(driven).saturating_add(connection),
            });
        }
        sketches.reverse();
        Some(Self {
            network,
            legs,
            sketches,
            width,
        })
    }

    /// A leg with all that it drives, in lines of at most `width` where that is
    /// possible.
    fn leg(&self, at: usize, width: usize) -> Option<Picture> {
        let (leg, sketch) = (self.legs.get(at)?, self.sketches.get(at)?);
        let condition: usize = sketch.pieces.iter().map(|it| it.width).sum();
        let mut bands = Vec::new();
        let mut band = Picture::wire();
        for piece in &sketch.pieces {
            // More follows for sure, if only what is driven.
            if band.width > ARROW && band.width + piece.width + ARROW > width {
                bands.push(series(band, Picture::of(ONWARD.to_owned())));
                band = Picture::of(TAKEN_UP.to_owned());
            }
            band = series(band, piece.clone());
        }
        let driven = sketch.width.saturating_sub(condition);
        if band.width > ARROW && band.width.saturating_add(driven) > width {
            bands.push(series(band, Picture::of(ONWARD.to_owned())));
            band = Picture::of(TAKEN_UP.to_owned());
        }
        let rest = width.checked_sub(band.width)?;
        let driven = self.drives(leg, rest)?;
        bands.push(series(band, driven));
        Some(stack(bands))
    }

    /// What a leg drives, in lines of at most `width` where that is possible.
    fn drives(&self, leg: &Leg, width: usize) -> Option<Picture> {
        let connection = usize::from(leg.drives.len() > 1);
        let width = width.checked_sub(connection)?;
        let mut driven = Vec::with_capacity(leg.drives.len());
        for drive in &leg.drives {
            driven.push(match drive {
                Driven::Output(at) => drawn_output(&self.network.element(*at).kind, self.width),
                // An inner leg has a greater number, so this comes to an end.
                Driven::Leg(inner) => self.leg(*inner, width)?,
            });
        }
        match driven.len() {
            0 => Some(Picture::wire()),
            1 => driven.pop(),
            _ => Some(parallel(driven, Joined::No)),
        }
    }
}

/// A part of a rung. Power comes in at the left of the first line, and goes on
/// at its right. All lines are equally wide.
#[derive(Clone)]
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

/// Lines of one drawing that go on below each other.
fn stack(bands: Vec<Picture>) -> Picture {
    let width = bands.iter().map(|it| it.width).max().unwrap_or_default();
    let filled = bands.into_iter().flat_map(|band| {
        let fill = blank(width - band.width);
        band.lines.into_iter().map(move |line| line + &fill)
    });
    Picture {
        lines: filled.collect(),
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

/// A condition, if it is not wider than `width`. Nests as deep as its part does,
/// which the writer bounds.
fn condition(part: &Part, network: &Network, width: usize) -> Option<Picture> {
    match &part.kind {
        Kind::And(parts) => {
            let mut all = Picture::wire();
            for part in parts {
                all = series(all, condition(part, network, width)?);
                if all.width > width {
                    return None;
                }
            }
            Some(all)
        }
        Kind::Or(parts) if !parts.is_empty() => {
            let legs: Option<Vec<Picture>> = parts
                .iter()
                .map(|part| condition(part, network, width))
                .collect();
            let legs = legs?;
            let height: usize = legs.iter().map(|leg| leg.lines.len()).sum();
            (height <= HIGHEST).then(|| parallel(legs, Joined::Yes))
        }
        Kind::Element(at) => Some(contact(&network.element(*at).kind, part, network, width)),
        _ => Some(Picture::of(format!("──{}──", boxed(part, network, width)))),
    }
}

fn contact(kind: &ElementKind, part: &Part, network: &Network, width: usize) -> Picture {
    let spelled = match kind {
        ElementKind::Contact(contact) => {
            let name = cut(&contact.operand.name, width);
            match contact.kind {
                ContactKind::Open => format!("[ {name} ]"),
                ContactKind::Closed => format!("[/{name}]"),
                ContactKind::Rising => format!("[P {name}]"),
                ContactKind::Falling => format!("[N {name}]"),
            }
        }
        _ => boxed(part, network, width),
    };
    Picture::of(format!("──{spelled}──"))
}

/// A condition that is no contact.
fn boxed(part: &Part, network: &Network, width: usize) -> String {
    let text = part::text(part, &|at| network.element(at));
    format!("[ {} ]", cut(&text, width))
}

/// An output as it is drawn.
fn drawn_output(kind: &ElementKind, width: usize) -> Picture {
    let spelled = match kind {
        ElementKind::Coil(coil) => {
            let name = cut(&coil.operand.name, width);
            match coil.kind {
                CoilKind::Plain => format!("( {name} )"),
                CoilKind::Negated => format!("(/{name})"),
                CoilKind::Set => format!("(S {name})"),
                CoilKind::Reset => format!("(R {name})"),
                CoilKind::Rising => format!("(P {name})"),
                CoilKind::Falling => format!("(N {name})"),
            }
        }
        kind => format!("[ {} ]", cut(&output(kind).0, width)),
    };
    Picture::of(format!("──{spelled}"))
}

/// What stands in one element of a drawing of that width: the source holds all
/// of it.
fn cut(text: &str, width: usize) -> Cow<'_, str> {
    let most = width / 2;
    if text.width() <= most {
        return text.into();
    }
    let mut kept = String::new();
    for sign in text.chars() {
        if kept.width() + sign.width().unwrap_or_default() >= most {
            break;
        }
        kept.push(sign);
    }
    (kept + "…").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(rung: &str, width: usize) -> Option<String> {
        let program = crate::read(rung.as_bytes()).program;
        draw(&program.routines[0].rungs[0].network, width)
    }

    #[track_caller]
    fn check_within(width: usize, rung: &str, wanted: &[&str]) {
        let drawn = drawn(rung, width).expect("a drawing");
        assert_eq!(drawn.lines().collect::<Vec<_>>(), wanted, "\n{drawn}");
    }

    #[track_caller]
    fn check(rung: &str, wanted: &[&str]) {
        check_within(76, rung, wanted);
    }

    #[test]
    fn what_is_too_wide_goes_on_below() {
        let rung = "rung: (a + b) * /c * d * (e + f) -> x";
        check(
            rung,
            &[
                "┬──[ a ]──┬──[/c]────[ d ]──┬──[ e ]──┬──( x )",
                "└──[ b ]──┘                 └──[ f ]──┘",
            ],
        );
        check_within(
            30,
            rung,
            &[
                "┬──[ a ]──┬──[/c]────[ d ]───→",
                "└──[ b ]──┘",
                "→─┬──[ e ]──┬──( x )",
                "  └──[ f ]──┘",
            ],
        );
        check_within(
            18,
            rung,
            &[
                "┬──[ a ]──┬─→",
                "└──[ b ]──┘",
                "→───[/c]───→",
                "→───[ d ]───→",
                "→─┬──[ e ]──┬─→",
                "  └──[ f ]──┘",
                "→───( x )",
            ],
        );
    }

    #[test]
    fn what_is_driven_goes_on_below_too() {
        check_within(
            26,
            "rung: a * b -> set x, (c * d -> /y), TON(t1, 5s)",
            &[
                "──[ a ]────[ b ]───→",
                "→─┬──(S x)",
                "  ├──[ c ]────[ d ]───→",
                "  │→───(/y)",
                "  └──[ TON(t1, 5s) ]",
            ],
        );
    }

    #[test]
    fn long_words_are_cut() {
        check_within(
            30,
            "rung: a -> set a_name_of_many_letters, TON(timer, 5s)",
            &[
                "──[ a ]───→",
                "→─┬──(S a_name_of_many…)",
                "  └──[ TON(timer, 5s) ]",
            ],
        );
    }

    #[test]
    fn what_cannot_be_broken_is_not_drawn() {
        assert_eq!(drawn("rung: (a * b * c + d) -> x", 20), None);
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
