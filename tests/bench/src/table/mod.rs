//! The rows of the table, part by part.

use std::fmt;
use std::time::Duration;

use bench::measure::ratio;

pub mod diagrams;
pub mod memory;
pub mod programs;
pub mod reading;
pub mod successions;

/// The head of the table, in Markdown.
pub const HEAD: &str = "| what | against | ours | peer | ratio | aim |\n|---|---|---|---|---|---|";

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    what: String,
    against: String,
    ours: String,
    peer: String,
    ratio: String,
    aim: Aim,
}

/// What a number is to be, and whether it is.
#[derive(Clone, Debug)]
pub enum Aim {
    /// No aim is set: the number is there to be known.
    None,
    /// At most so much of a unit, which ratios have none of.
    Most {
        limit: f64,
        is: f64,
        unit: &'static str,
    },
    /// At least so many times as fast.
    Least { limit: f64, is: f64 },
}

impl fmt::Display for Aim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (sign, limit, unit, is_met) = match *self {
            Self::None => return f.write_str("none"),
            Self::Most { limit, is, unit } => ("at most", limit, unit, is <= limit),
            Self::Least { limit, is } => ("at least", limit, "", is >= limit),
        };
        let answer = if is_met { "met" } else { "MISSED" };
        write!(f, "{sign} {limit}{unit}: {answer}")
    }
}

impl Row {
    /// A ratio of two times, `ours` to `peer`.
    fn times(
        what: impl Into<String>,
        against: impl Into<String>,
        (ours, peer): (Duration, Duration),
        limit: Option<f64>,
    ) -> Self {
        let is = ratio(ours, peer);
        Self {
            what: what.into(),
            against: against.into(),
            ours: shown(ours),
            peer: shown(peer),
            ratio: format!("{is:.2}"),
            aim: limit.map_or(Aim::None, |limit| Aim::Most {
                limit,
                is,
                unit: "",
            }),
        }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            what,
            against,
            ours,
            peer,
            ratio,
            aim,
        } = self;
        write!(
            f,
            "| {what} | {against} | {ours} | {peer} | {ratio} | {aim} |"
        )
    }
}

/// A time with three digits.
fn shown(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (value, unit) = match seconds {
        s if s >= 1.0 => (s, "s"),
        s if s >= 1e-3 => (s * 1e3, "ms"),
        s => (s * 1e6, "µs"),
    };
    match value {
        v if v >= 100.0 => format!("{v:.0} {unit}"),
        v if v >= 10.0 => format!("{v:.1} {unit}"),
        v => format!("{v:.2} {unit}"),
    }
}
