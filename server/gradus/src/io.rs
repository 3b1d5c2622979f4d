//! Where a command reads from and answers to.
//!
//! Commands never touch the process's streams themselves: they get an [`Io`].
//! It keeps the two outputs apart, knows which of them may bear colours, and
//! carries the flag that Ctrl-C raises.

use std::io::{BufWriter, IsTerminal, Stdin, Stdout, Write};
use std::path::Path;

use logic::Cancel;

use crate::colour::{Paint, When};
use crate::file::{self, Unreadable};

/// The streams of the process.
pub struct Io {
    input: Stdin,
    answer: BufWriter<Stdout>,
    answer_paint: Paint,
    aside_paint: Paint,
    cancel: Cancel,
}

impl Io {
    /// The standard streams, coloured when `when` says so.
    pub fn of_process(when: When) -> Self {
        let answer = std::io::stdout();
        Self {
            input: std::io::stdin(),
            answer_paint: Paint::choose(when, answer.is_terminal()),
            aside_paint: Paint::choose(when, std::io::stderr().is_terminal()),
            answer: BufWriter::new(answer),
            cancel: Cancel::default(),
        }
    }

    /// Where the answer goes: standard output.
    pub fn answer(&mut self) -> &mut impl Write {
        &mut self.answer
    }

    /// Colours for the answer.
    pub fn answer_paint(&self) -> Paint {
        self.answer_paint
    }

    /// Writes the answer so far.
    pub fn flush(&mut self) -> std::io::Result<()> {
        self.answer.flush()
    }

    /// Says `text`, which is no part of the answer, on standard error. Where
    /// both outputs are one terminal it comes after the answer so far.
    pub fn aside(&mut self, text: &str) -> std::io::Result<()> {
        self.flush()?;
        // Nobody can be told that standard error is gone.
        let _ = std::io::stderr().write_all(text.as_bytes());
        Ok(())
    }

    /// Colours for what is said aside.
    pub fn aside_paint(&self) -> Paint {
        self.aside_paint
    }

    /// Says on standard error what stops the command.
    pub fn complain(&mut self, message: &str) {
        let word = self.aside_paint.error("error");
        let _ = writeln!(std::io::stderr(), "{word}: {message}");
    }

    /// The bytes of the file at `path`, or of standard input for `-`.
    pub fn read(&mut self, path: &Path) -> Result<Vec<u8>, Unreadable> {
        if is_standard_input(path) {
            file::drain(self.input.lock())
        } else {
            file::read(path)
        }
    }

    /// Whether somebody sits at a terminal who can be asked, and can answer.
    pub fn can_ask(&self) -> bool {
        self.input.is_terminal() && std::io::stderr().is_terminal()
    }

    /// The next line of standard input without its end; `None` after the last.
    pub fn line(&mut self) -> std::io::Result<Option<String>> {
        let mut line = String::new();
        let read = self.input.read_line(&mut line)?;
        Ok((read > 0).then(|| line.trim_end_matches(['\r', '\n']).to_owned()))
    }

    /// The flag that Ctrl-C raises. Long work asks it, and stops.
    pub fn cancel(&self) -> &Cancel {
        &self.cancel
    }
}

/// Whether `path` stands for standard input.
pub fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}
