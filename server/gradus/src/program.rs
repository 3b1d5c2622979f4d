//! The ladder that a command is about.
//!
//! A command that reads one ladder says the same about it whatever it then
//! does: why the file cannot be read, that it is something else, that parts of
//! it were not understood. The answer is given all the same wherever there is
//! a program at all; how many errors its text has is said beside it, and
//! counts in the exit status.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ladder::{Format, Program};
use logic::{Budget, Name};
use recovery::Analysis;
use source::{Diagnostic, Severity};

use crate::input::{self, numbered};
use crate::io::Io;
use crate::progress::Progress;
use crate::report::{self, Findings, printable};
use crate::status::Status;
use ide::language;

/// A ladder as it was read.
pub struct Ladder {
    /// Where it came from, or `-`.
    pub path: PathBuf,
    /// What was understood of it.
    pub program: Arc<Program>,
    /// Errors in its text.
    errors: usize,
}

impl Ladder {
    /// How answers name its file.
    pub fn name(&self) -> String {
        input::name(&self.path)
    }

    /// How a command ends that has answered about it.
    pub fn status(&self) -> Status {
        if self.errors > 0 {
            Status::ProblemsFound
        } else {
            Status::Done
        }
    }
}

/// Reads the ladder at `path`. `None` if there is none; the user has been told
/// why, and the command ends with [`Status::Usage`].
pub fn read(path: &Path, io: &mut Io) -> std::io::Result<Option<Ladder>> {
    match bytes(path, io)? {
        Some(bytes) => of_bytes(path, bytes, io),
        None => Ok(None),
    }
}

/// The same of bytes that have been read from there.
pub fn of_bytes(path: &Path, bytes: Vec<u8>, io: &mut Io) -> std::io::Result<Option<Ladder>> {
    let paint = io.aside_paint();
    let name = printable(&input::name(path));
    let other = match language::of(&bytes) {
        language::File::Ladder(_) => None,
        language::File::Spec(_) => Some("spec"),
        language::File::Scenario(_) => Some("scenario"),
    };
    if let Some(other) = other {
        io.complain(&format!(
            "{name}: this is a {other}, and a ladder is needed"
        ));
        return Ok(None);
    }
    let reading = ladder::read(&bytes);
    if reading.program.format == Format::Unknown {
        let findings = Findings::new(path.to_owned(), bytes, reading.diagnostics);
        io.aside(&report::text(&findings, paint))?;
        return Ok(None);
    }
    let errors = tell_errors(&name, &reading.diagnostics, io)?;
    Ok(Some(Ladder {
        path: path.to_owned(),
        program: reading.program,
        errors,
    }))
}

/// The bytes of the file at `path`. `None` if they cannot be had; the user has
/// been told why.
pub fn bytes(path: &Path, io: &mut Io) -> std::io::Result<Option<Vec<u8>>> {
    match io.read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(reason) => {
            let paint = io.aside_paint();
            io.aside(&report::unreadable(path, &reason.diagnostic(), paint))?;
            Ok(None)
        }
    }
}

/// Tells how many errors there are in the text of the file called `name`,
/// which is answered about all the same, and gives their number.
pub fn tell_errors(name: &str, found: &[Diagnostic], io: &mut Io) -> std::io::Result<usize> {
    let errors = found.iter().filter(|it| it.severity == Severity::Error);
    let errors = errors.count();
    if errors > 0 {
        let word = io.aside_paint().severity(Severity::Warning, "warning");
        let errors = numbered(errors, "error");
        io.aside(&format!(
            "{word}: {name}: {errors} in the text; `gradus check` shows them\n"
        ))?;
    }
    Ok(errors)
}

/// All that is recovered from `ladder`; `None` if somebody pressed Ctrl-C.
pub fn analyse(ladder: &Ladder, budget: &Budget) -> Option<Analysis> {
    let _progress = progress("Analysing", ladder);
    let analysis = recovery::analyse(&ladder.program, budget);
    // The states too, while the line moves.
    analysis.groups();
    (!budget.cancel.is_cancelled()).then_some(analysis)
}

/// The usual budget, which ends when Ctrl-C is pressed.
pub fn budget(io: &Io) -> Budget {
    Budget {
        cancel: io.cancel().clone(),
        ..Budget::default()
    }
}

/// A line that moves while something is done to `ladder`.
pub fn progress(activity: &'static str, ladder: &Ladder) -> Progress {
    Progress::of_one(activity, &printable(&ladder.name()))
}

/// What the comments of the ladder say about a state, which may be a value of
/// a register.
pub fn description(analysis: &Analysis, state: &str) -> Option<Name> {
    let title = || {
        analysis.registers.iter().find_map(|register| {
            let mut values = register.states.iter();
            let found = values.find(|it| *register.state_name(it.value) == *state);
            found.and_then(|it| it.title.clone())
        })
    };
    analysis.description(state).or_else(title)
}
