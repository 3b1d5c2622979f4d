//! The file that holds the spec: what it says now, and replacing it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use source::codes;

use crate::colour::Paint;
use crate::file::{self, Unreadable};
use crate::input;
use crate::report::{self, printable};
use ide::language;

/// A spec and where it is.
pub struct SpecFile {
    /// The file; `None` for standard output.
    pub path: Option<PathBuf>,
    /// What it says; nothing if there is no file yet.
    pub text: String,
    exists: bool,
    /// What has become of it since it was opened.
    written: Option<State>,
}

/// What becomes of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It is made.
    New,
    /// It is replaced.
    Changed,
    /// It says all that already.
    Unchanged,
    /// It would be made or replaced.
    WouldChange,
    /// There is none: the spec goes to standard output.
    Printed,
}

impl State {
    /// The word used in JSON.
    pub fn word(self) -> &'static str {
        match self {
            Self::New => "new",
            Self::Changed => "changed",
            Self::Unchanged => "unchanged",
            Self::WouldChange => "would_change",
            Self::Printed => "printed",
        }
    }
}

/// Why a file is not touched.
#[derive(Debug)]
pub enum Refusal {
    /// It cannot be read.
    Unreadable(Unreadable),
    /// It holds something else.
    NoSpec,
}

impl Refusal {
    /// What to tell the user.
    pub fn text(&self, path: &Path, paint: Paint) -> String {
        match self {
            Self::Unreadable(reason) => report::unreadable(path, &reason.diagnostic(), paint),
            Self::NoSpec => format!(
                "{}: {}: this is no spec, and is left as it is; name another file with -o\n",
                paint.error("error"),
                printable(&input::name(path))
            ),
        }
    }
}

impl SpecFile {
    /// A new spec that nobody keeps.
    pub fn on_standard_output() -> Self {
        Self {
            path: None,
            text: String::new(),
            exists: false,
            written: None,
        }
    }

    /// The spec at `path`, or a new one if there is no such file.
    pub fn open(path: &Path) -> Result<Self, Refusal> {
        let found = match file::read(path) {
            Ok(bytes) => Some(bytes),
            Err(Unreadable::Refused(error)) if error.kind() == ErrorKind::NotFound => None,
            Err(reason) => return Err(Refusal::Unreadable(reason)),
        };
        let exists = found.is_some();
        let text = String::from_utf8(found.unwrap_or_default()).map_err(|_| Refusal::NoSpec)?;
        if !is_spec(&text) {
            return Err(Refusal::NoSpec);
        }
        Ok(Self {
            path: Some(path.to_owned()),
            text,
            exists,
            written: None,
        })
    }

    /// How answers name it.
    pub fn name(&self) -> String {
        match &self.path {
            Some(path) => input::name(path),
            None => "<stdout>".to_owned(),
        }
    }

    /// Whether it says `new` already; what goes to standard output never does.
    pub fn says(&self, new: &str) -> bool {
        self.exists && self.text == new
    }

    /// What became of it.
    pub fn state(&self) -> State {
        match &self.path {
            None => State::Printed,
            Some(_) => self.written.unwrap_or(State::Unchanged),
        }
    }

    /// Makes the file say `new`, if it does not, and if nobody has written to
    /// it since it was read. The error says why it was left as it is.
    pub fn save(&mut self, new: &str) -> Result<(), String> {
        let path = match &self.path {
            Some(path) if !self.says(new) => path,
            _ => return Ok(()),
        };
        let name = printable(&input::name(path));
        let now = Self::open(path).map_err(|_| changed_meanwhile(&name))?;
        if now.exists != self.exists || now.text != self.text {
            return Err(changed_meanwhile(&name));
        }
        file::replace(path, new.as_bytes())
            .map_err(|error| format!("{name}: cannot be written: {error}"))?;
        let before = if self.exists {
            State::Changed
        } else {
            State::New
        };
        self.written.get_or_insert(before);
        new.clone_into(&mut self.text);
        self.exists = true;
        Ok(())
    }
}

fn changed_meanwhile(name: &str) -> String {
    format!("{name}: somebody else has just changed it, so it is left as it is; run again")
}

/// Whether `text` is a spec, or nothing yet: blank, or only comments.
fn is_spec(text: &str) -> bool {
    if matches!(language::of(text.as_bytes()), language::File::Spec(_)) {
        return true;
    }
    let reading = grafcet::read(text);
    let is_understood = |found: &source::Diagnostic| found.code != codes::SPEC_SYNTAX;
    let is_empty = reading.spec.grafcet == grafcet::Grafcet::default();
    is_empty && reading.diagnostics.iter().all(is_understood)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_of_comments_is_a_spec_that_says_nothing_yet() {
        assert!(is_spec(""));
        assert!(is_spec("\u{feff}// to be decided\n//! accept v1 -> v2\n"));
        assert!(is_spec("Step X1\nMarking X1\n"));
    }

    #[test]
    fn other_texts_are_none() {
        assert!(!is_spec("rung: a -> b\n"));
        assert!(!is_spec("Dear colleague,\n"));
        assert!(!is_spec("<project/>"));
    }
}
