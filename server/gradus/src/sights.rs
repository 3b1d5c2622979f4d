//! The search for sequences of inputs that show which state follows which.

use std::path::{Path, PathBuf};

use grafcet::EnvironmentRule;
use ide::language;
use proof::Limits;
use recovery::Analysis;
use verification::witness::sights;

use crate::input::{self, numbered};
use crate::io::{Io, is_standard_input};
use crate::program::{self, Ladder};
use crate::report::printable;

/// Millions of small steps that are worth it without being asked: a second or
/// two where it is hard, and no time to speak of where it is not.
pub const EFFORT: u64 = 200;

/// The analysis with what is seen in plants that obey these rules, and what there
/// is to say about the search.
pub fn seeing(
    ladder: &Ladder,
    analysis: Analysis,
    environment: &[EnvironmentRule],
    effort: u64,
    io: &Io,
) -> (Analysis, Option<String>) {
    if effort == 0 {
        return (analysis, None);
    }
    let limits = Limits {
        steps: effort.saturating_mul(1_000_000),
        cancel: io.cancel().clone(),
        ..Limits::default()
    };
    let found = {
        let _progress = program::progress("Searching", ladder);
        sights(&analysis, environment, &limits)
    };
    match found {
        Ok(sights) => {
            let rules = sights.environment.len();
            let under = (rules > 0).then(|| {
                let rules = numbered(rules, "environment rule");
                format!("seen in plants that obey {rules}")
            });
            let some = "not all sequences were searched; --effort N searches more";
            let some = (!sights.is_whole).then(|| some.to_owned());
            let notes: Vec<String> = under.into_iter().chain(some).collect();
            let note = (!notes.is_empty()).then(|| notes.join("; "));
            (analysis.seeing(sights), note)
        }
        Err(refusal) => {
            let reason = printable(&refusal.to_string());
            let note = format!("no sequences were searched: {reason}");
            (analysis, Some(note))
        }
    }
}

/// The rules of the environment that the spec at `path` gives, or, without one,
/// the spec beside the ladder. `None` if a spec that was named cannot be read; the
/// user has been told.
pub fn environment(
    ladder: &Path,
    path: Option<&PathBuf>,
    io: &mut Io,
) -> std::io::Result<Option<Vec<EnvironmentRule>>> {
    let bytes = match path {
        Some(path) => match program::bytes(path, io)? {
            Some(bytes) => bytes,
            None => return Ok(None),
        },
        None if is_standard_input(ladder) => return Ok(Some(Vec::new())),
        // What is not there gives no rules.
        None => std::fs::read(ladder.with_extension("grafcet")).unwrap_or_default(),
    };
    match (language::of(&bytes), path) {
        (language::File::Spec(text), _) => Ok(Some(grafcet::read(text).spec.environment)),
        (_, None) => Ok(Some(Vec::new())),
        (_, Some(path)) => {
            let name = printable(&input::name(path));
            io.complain(&format!("{name}: this is no spec"));
            Ok(None)
        }
    }
}
