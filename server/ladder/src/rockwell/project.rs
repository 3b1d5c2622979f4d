//! A Rockwell project as L5X and L5K both tell it, before names are settled.
//!
//! The two readers fill this; [`program`](super::program) turns it into the
//! model. It keeps Rockwell's own notions (controller scope, programs, Add-On
//! Instructions, pending edits) that the model folds away.

use logic::Name;
use source::{Diagnostic, Span};

use super::passage::Passage;
use crate::{Chart, Class, Format};

/// A project, or the part of one that was exported.
#[derive(Debug)]
pub(super) struct Project<'t> {
    pub(super) format: Format,
    pub(super) name: String,
    /// Tags of the controller's scope.
    pub(super) tags: Vec<Tag>,
    /// Programs and Add-On Instructions in the order of the file.
    pub(super) units: Vec<Unit<'t>>,
    /// Programs in the order in which the tasks run them; `None` where the file
    /// tells of no tasks.
    pub(super) schedule: Option<Vec<String>>,
    /// Whether single routines or rungs were exported, without their program.
    pub(super) extent: Extent,
    pub(super) charts: Vec<Chart>,
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// How much of a project a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Whole programs: what a main routine does not call is not run.
    Programs,
    /// A routine or some rungs: the program around them is not in the file.
    Routine,
}

/// A tag, an AOI's parameter or its local tag.
#[derive(Clone, Debug)]
pub(super) struct Tag {
    pub(super) name: Name,
    pub(super) class: Class,
    pub(super) data_type: Option<Name>,
    pub(super) description: Option<Name>,
    /// What an alias stands for.
    pub(super) alias_for: Option<String>,
    pub(super) initial: Option<Name>,
    /// Presets of timers and counters inside: `.tmr[3]` and the value, in lower
    /// case; the tag itself has an empty path.
    pub(super) presets: Vec<(String, i64)>,
    /// Comments on its parts: `.DATA[3].2` and the text.
    pub(super) comments: Vec<(String, Name)>,
    pub(super) span: Span,
}

/// What a unit is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum UnitKind {
    /// A program; its main routine, where it names one.
    Program { main: Option<String> },
    /// An Add-On Instruction.
    Instruction {
        /// Parameters that calls pass, in the order in which they pass them.
        passed: Vec<(String, Class)>,
    },
}

/// A program or an Add-On Instruction.
#[derive(Debug)]
pub(super) struct Unit<'t> {
    pub(super) kind: UnitKind,
    pub(super) name: String,
    pub(super) tags: Vec<Tag>,
    pub(super) routines: Vec<RoutineSource<'t>>,
    /// Names of all its routines, those included that are not read.
    pub(super) routine_names: Vec<String>,
    /// Which edits the controller executes.
    pub(super) edits: Edits,
    /// Whether a task may run it.
    pub(super) inhibited: Inhibition,
}

/// Whether a program is switched off (`Disabled="true"`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Inhibition {
    Runs,
    Inhibited,
}

/// Which side of pending edits is in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edits {
    /// The rungs as they were.
    Original,
    /// The edits, which are being tested (`TestEdits="true"`).
    Tested,
}

/// A routine in ladder.
#[derive(Debug)]
pub(super) struct RoutineSource<'t> {
    pub(super) name: String,
    pub(super) rungs: Vec<RungSource<'t>>,
    pub(super) span: Span,
}

/// A rung before its text is read.
#[derive(Debug)]
pub(super) struct RungSource<'t> {
    pub(super) number: u32,
    /// `N`, `R`, `IR` and so on.
    pub(super) edit: String,
    pub(super) comment: Option<Name>,
    pub(super) text: Passage<'t>,
    pub(super) span: Span,
}

impl Project<'_> {
    /// A project that holds nothing yet.
    pub(super) fn empty(format: Format) -> Self {
        Self {
            format,
            name: String::new(),
            tags: Vec::new(),
            units: Vec::new(),
            schedule: None,
            extent: Extent::Programs,
            charts: Vec::new(),
            diagnostics: Vec::new(),
        }
    }
}

impl Tag {
    /// A tag of which only the name is known.
    pub(super) fn new(name: impl Into<Name>, class: Class, span: Span) -> Self {
        Self {
            name: name.into(),
            class,
            data_type: None,
            description: None,
            alias_for: None,
            initial: None,
            presets: Vec::new(),
            comments: Vec::new(),
            span,
        }
    }
}

impl Unit<'_> {
    /// A unit that holds nothing yet.
    pub(super) fn empty(kind: UnitKind, name: String) -> Self {
        Self {
            kind,
            name,
            tags: Vec::new(),
            routines: Vec::new(),
            routine_names: Vec::new(),
            edits: Edits::Original,
            inhibited: Inhibition::Runs,
        }
    }

    /// Whether it is an Add-On Instruction.
    pub(super) fn is_instruction(&self) -> bool {
        matches!(self.kind, UnitKind::Instruction { .. })
    }
}

impl Edits {
    /// Whether the controller executes a rung with this edit mark. The marks
    /// are those of the import/export format: `N` as it stands, `R` to be
    /// replaced by the `IR` before it, `I` to be inserted, `D` to be deleted,
    /// `rN`, `rI`, `rR` the same again with a further replacement `er` not yet
    /// downloaded, `e` and `d` an insertion and a deletion not yet downloaded.
    pub(super) fn in_force(self, mark: &str) -> bool {
        match mark {
            "" | "N" | "rN" | "d" => true,
            "R" | "D" => self == Self::Original,
            "I" | "IR" | "rI" | "rR" => self == Self::Tested,
            "e" | "er" => false,
            _ => true,
        }
    }

    /// What a pending edit with this mark is called.
    pub(super) fn describe(mark: &str) -> Option<&'static str> {
        Some(match mark {
            "R" | "rN" => "to be replaced",
            "D" | "d" => "to be deleted",
            "I" | "rI" | "e" => "to be inserted",
            "IR" | "rR" | "er" => "a replacement",
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_rung_and_its_replacement_one_is_in_force() {
        for (before, after) in [("R", "IR"), ("R", "rR"), ("D", "I")] {
            for edits in [Edits::Original, Edits::Tested] {
                assert_ne!(edits.in_force(before), edits.in_force(after));
            }
        }
        assert!(Edits::Original.in_force("R"));
        assert!(Edits::Tested.in_force("IR"));
    }
}
