//! A text that is being edited, and what was read from it.
//!
//! Between two keystrokes a text of thousands of rungs changes in one of them.
//! An [`Edition`] keeps beside what was read what reading the next one needs:
//! of a `.ladder` text, where its statements begin and how its variables are
//! spelled. [`reread`] then reads the statements that changed, and takes over
//! the others with their places moved. Whether that is possible is decided by
//! what the change says; where it may concern rungs elsewhere, all is read
//! anew. What comes out is the same as from [`read`](crate::read), always.
//!
//! A rung that says what it said before keeps its [`Network`], the very same
//! value, in every format. Whoever computes something from a network can so
//! tell what is still true.
//!
//! [`Network`]: crate::Network

use std::collections::HashMap;
use std::sync::Arc;

use crate::reading::{Reading, decode, detect, read_source};
use crate::text::{self, Traces};
use crate::{Format, Program, Routine, Rung};

/// A text with what was read from it, and what reading the next one needs.
#[derive(Clone, Debug)]
pub struct Edition {
    /// The text.
    pub text: Arc<str>,
    /// What was read.
    pub reading: Reading,
    /// How many statements were read to have it, the others being those of the
    /// edition before. In formats other than `.ladder` the number of rungs.
    pub read_anew: usize,
    traces: Option<Arc<Traces>>,
}

impl Edition {
    /// Reads a text of any known form.
    pub fn new(text: Arc<str>) -> Self {
        let (reading, traces) = match decode(text.as_bytes()) {
            Ok(source) => read_source(source),
            Err(diagnostic) => (Reading::nothing(*diagnostic), None),
        };
        let read_anew = match &traces {
            Some(traces) => traces.read,
            None => reading.program.rungs().count(),
        };
        Self {
            text,
            reading,
            read_anew,
            traces: traces.map(Arc::new),
        }
    }
}

/// Reads a text that was edited since `previous`: all of it gives the same as
/// [`read`](crate::read).
///
/// Linear in what changed, but for passes over the bytes of the text and over
/// the list of rungs that cost next to nothing for each.
pub fn reread(previous: &Edition, text: Arc<str>) -> Edition {
    if *text == *previous.text {
        return Edition {
            read_anew: 0,
            ..previous.clone()
        };
    }
    if let Some(edition) = of_ladder(previous, &text) {
        return edition;
    }
    let mut edition = Edition::new(text);
    keep_networks(&previous.reading.program, &mut edition.reading.program);
    edition
}

fn of_ladder(previous: &Edition, text: &Arc<str>) -> Option<Edition> {
    let traces = previous.traces.as_deref()?;
    let before = decode(previous.text.as_bytes()).ok()?;
    let after = decode(text.as_bytes()).ok()?;
    if before.base != after.base || detect(after.text) != Some(Format::Ladder) {
        return None;
    }
    let (reading, traces) = text::reread(before, &previous.reading, traces, after)?;
    Some(Edition {
        text: text.clone(),
        reading,
        read_anew: traces.read,
        traces: Some(Arc::new(traces)),
    })
}

/// Gives the rungs of `program` the networks that they had in `before`, where
/// these are equal.
fn keep_networks(before: &Program, program: &mut Arc<Program>) {
    let mut known: HashMap<_, &Routine> = HashMap::new();
    for routine in &before.routines {
        known.entry(&routine.scope).or_insert(routine);
    }
    for routine in &mut Arc::make_mut(program).routines {
        if let Some(before) = known.remove(&routine.scope) {
            Rung::keep_networks(&before.rungs, &mut routine.rungs);
        }
    }
}
