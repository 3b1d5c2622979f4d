//! Colours of text on a terminal.

use source::Severity;

/// When to colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum When {
    /// On a terminal, unless `NO_COLOR` is set or the terminal is dumb.
    Auto,
    /// Always, for example for `less -R`.
    Always,
    /// Never.
    Never,
}

/// Colours text, or leaves it as it is.
#[derive(Clone, Copy, Debug)]
pub struct Paint {
    coloured: bool,
}

impl Paint {
    /// Leaves text as it is.
    pub const PLAIN: Self = Self { coloured: false };

    /// Colours as `when` says, for an output that is a terminal or is not.
    pub fn choose(when: When, terminal: bool) -> Self {
        let coloured = match when {
            When::Always => true,
            When::Never => false,
            When::Auto => terminal && !is_set("NO_COLOR") && !is_dumb(),
        };
        Self { coloured }
    }

    /// `text` in the colour of a severity.
    pub fn severity(self, severity: Severity, text: &str) -> String {
        match severity {
            Severity::Error => self.error(text),
            Severity::Warning => self.wrap("1;33", text),
            Severity::Information => self.wrap("1;36", text),
            Severity::Hint => self.wrap("1;34", text),
        }
    }

    /// `text` in the colour of errors.
    pub fn error(self, text: &str) -> String {
        self.wrap("1;31", text)
    }

    /// `text` in bold.
    pub fn bold(self, text: &str) -> String {
        self.wrap("1", text)
    }

    /// `text` that matters less.
    pub fn faint(self, text: &str) -> String {
        self.wrap("2", text)
    }

    /// `text` that a change adds.
    pub fn added(self, text: &str) -> String {
        self.wrap("32", text)
    }

    /// `text` that a change removes.
    pub fn removed(self, text: &str) -> String {
        self.wrap("31", text)
    }

    fn wrap(self, codes: &str, text: &str) -> String {
        if self.coloured {
            format!("\x1b[{codes}m{text}\x1b[0m")
        } else {
            text.to_owned()
        }
    }
}

fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| !value.is_empty())
}

fn is_dumb() -> bool {
    std::env::var_os("TERM").is_some_and(|value| value == "dumb")
}
