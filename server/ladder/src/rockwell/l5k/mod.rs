//! L5K: a whole project as text.
//!
//! Components stand one in the other, each between its word and `END_` with the
//! same word. A component's attributes follow its name in parentheses:
//!
//! ```text
//! CONTROLLER Plant (ProcessorType := "1756-L61", Major := 20)
//!     TAG
//!         Start OF Local:1:I.Data.0 (Description := "start button");
//!         T1 : TIMER := [0,2000,0];
//!     END_TAG
//!     PROGRAM Main (MAIN := "MainRoutine", MODE := 0)
//!         ROUTINE MainRoutine
//!             RC: "The pump";
//!             N: XIC(Start)OTE(Pump);
//!         END_ROUTINE
//!     END_PROGRAM
//!     TASK Slow (Type := PERIODIC, Rate := 100)
//!         Main;
//!     END_TASK
//! END_CONTROLLER
//! ```
//!
//! Components that hold no logic (modules, data types, trends) are passed over
//! by name, whatever they are, so that those of later releases do no harm.

mod scanner;
mod tags;

use std::ops::Range;

use source::{Diagnostic, codes};

use super::listing;
use super::program;
use super::project::{Edits, Inhibition, Project, RoutineSource, Tag, Unit, UnitKind};
use crate::Format;
use crate::reading::{Reading, Source};
use scanner::{Component, Ends, Scanner, first_word};

/// Whether `text`, without blanks before it, is an L5K.
pub(super) fn looks_like_it(text: &str) -> bool {
    match first_word(text) {
        "IE_VER" | "CONTROLLER" => true,
        "PROGRAM" | "ROUTINE" | "ADD_ON_INSTRUCTION_DEFINITION" => text.contains("END_ROUTINE"),
        _ => false,
    }
}

/// Reads an L5K file.
pub(super) fn read(source: Source<'_>) -> Reading {
    let ends = Ends::of(source.text);
    let mut file = File {
        source,
        project: Project::empty(Format::L5k),
        ends: &ends,
        missing_end: None,
        loose: Unit::empty(UnitKind::Program { main: None }, String::new()),
    };
    file.components(0..source.text.len());
    let File {
        mut project,
        loose,
        missing_end,
        ..
    } = file;
    project.diagnostics.extend(missing_end);
    if !loose.routines.is_empty() {
        project.units.push(loose);
    }
    program::program(project)
}

/// A file being read.
struct File<'t, 'e> {
    source: Source<'t>,
    ends: &'e Ends<'t>,
    missing_end: Option<Diagnostic>,
    project: Project<'t>,
    /// Routines that stand in no program.
    loose: Unit<'t>,
}

impl<'t> File<'t, '_> {
    /// Reads the components in `range`. Only a controller holds others of this
    /// kind, and a controller in a controller ends the descent.
    fn components(&mut self, range: Range<usize>) {
        let mut scanner = Scanner::new(self.source.text, range, self.ends);
        while let Some(component) = scanner.component() {
            self.report_missing_end(&component);
            match component.word {
                "CONTROLLER" if self.project.name.is_empty() => {
                    self.project.name = component.name.to_owned();
                    self.components(component.inside);
                }
                "TAG" => {
                    let tags = self.tags(component.inside);
                    self.project.tags.extend(tags);
                }
                "PROGRAM" => self.program(&component),
                "ADD_ON_INSTRUCTION_DEFINITION" => self.definition(&component),
                "ENCODED_DATA" => self.protected(&component),
                "TASK" => self.task(&component),
                "ROUTINE" => {
                    let mut unit = std::mem::replace(
                        &mut self.loose,
                        Unit::empty(UnitKind::Program { main: None }, String::new()),
                    );
                    self.routine(&mut unit, &component);
                    self.loose = unit;
                }
                _ => {}
            }
        }
    }

    fn program(&mut self, component: &Component<'t>) {
        let main = component
            .attribute("MAIN")
            .or_else(|| component.attribute("MainRoutineName"));
        let mut unit = Unit::empty(UnitKind::Program { main }, component.name.to_owned());
        if component.says_yes("TestEdits") {
            unit.edits = Edits::Tested;
        }
        if component.says_yes("DisableFlag") || component.says_yes("Disabled") {
            unit.inhibited = Inhibition::Inhibited;
        }
        self.unit_parts(&mut unit, component);
        self.project.units.push(unit);
    }

    fn definition(&mut self, component: &Component<'t>) {
        let kind = UnitKind::Instruction { passed: Vec::new() };
        let mut unit = Unit::empty(kind, component.name.to_owned());
        self.unit_parts(&mut unit, component);
        self.project.units.push(unit);
    }

    fn unit_parts(&mut self, unit: &mut Unit<'t>, component: &Component<'t>) {
        let mut scanner = Scanner::new(self.source.text, component.inside.clone(), self.ends);
        while let Some(part) = scanner.component() {
            self.report_missing_end(&part);
            match part.word {
                "TAG" | "LOCAL_TAGS" => {
                    let tags = self.tags(part.inside);
                    unit.tags.extend(tags);
                }
                "PARAMETERS" => {
                    let parameters = tags::parameters(self.source, self.statements(part.inside));
                    if let UnitKind::Instruction { passed } = &mut unit.kind {
                        *passed = parameters.passed;
                    }
                    unit.tags.extend(parameters.tags);
                }
                "ENCODED_DATA" => {
                    self.protected(&part);
                    unit.routine_names.extend(part.attribute("Name"));
                }
                _ => self.routine(unit, &part),
            }
        }
    }

    fn tags(&self, range: Range<usize>) -> Vec<Tag> {
        tags::tags(self.source, self.statements(range))
    }

    fn statements(&self, range: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let mut scanner = Scanner::new(self.source.text, range, self.ends);
        std::iter::from_fn(move || scanner.statement())
    }

    fn routine(&mut self, unit: &mut Unit<'t>, component: &Component<'t>) {
        let language = match component.word {
            "ROUTINE" => None,
            "ST_ROUTINE" => Some("ST"),
            "FBD_ROUTINE" => Some("FBD"),
            "SFC_ROUTINE" => Some("SFC"),
            _ => return,
        };
        let place = component.place.clone();
        unit.routine_names.push(component.name.to_owned());
        if let Some(language) = language {
            let message = format!(
                "the routine `{}` is written in {language}, which is not read from L5K",
                component.name
            );
            let head = self.source.span(place.start, component.inside.start);
            self.project.diagnostics.push(
                Diagnostic::new(codes::OTHER_LANGUAGE, head, message)
                    .help("nothing to do; variables that it writes are taken as inputs"),
            );
            return;
        }
        let rungs = listing::rungs(
            self.source,
            component.inside.clone(),
            &mut self.project.diagnostics,
        );
        unit.routines.push(RoutineSource {
            name: component.name.to_owned(),
            rungs,
            span: self.source.span(place.start, place.end),
        });
    }

    fn task(&mut self, component: &Component<'t>) {
        let mut scanner = Scanner::new(self.source.text, component.inside.clone(), self.ends);
        while let Some(statement) = scanner.statement() {
            let program = self.source.text.get(statement).unwrap_or_default();
            let schedule = self.project.schedule.get_or_insert_default();
            schedule.push(program.trim_end_matches(';').trim().to_owned());
        }
    }

    fn protected(&mut self, component: &Component<'t>) {
        let name = component.attribute("Name").unwrap_or_default();
        let message = format!("`{name}` is exported as encoded data, so its logic cannot be read");
        let place = self
            .source
            .span(component.place.start, component.inside.start);
        self.project.diagnostics.push(
            Diagnostic::new(codes::PROTECTED, place, message)
                .help("export it with its source key; its outputs are taken as unknown"),
        );
        let of_instruction = component
            .attribute("EncodedType")
            .is_some_and(|kind| kind.eq_ignore_ascii_case("ADD_ON_INSTRUCTION_DEFINITION"));
        if of_instruction {
            let mut unit = Unit::empty(UnitKind::Instruction { passed: Vec::new() }, name);
            self.unit_parts(&mut unit, component);
            self.project.units.push(unit);
        }
    }

    /// Reports a component without an end; of several, one in the other, the
    /// innermost, where the text breaks off.
    fn report_missing_end(&mut self, component: &Component<'t>) {
        if component.ended {
            return;
        }
        let start = component.place.start;
        let message = format!(
            "`{} {}` has no `END_{}`",
            component.word, component.name, component.word
        );
        let place = self.source.span(start, start + component.word.len());
        let diagnostic = Diagnostic::new(codes::CUT_SHORT, place, message)
            .help("copy or export the file again; what was complete is read");
        self.missing_end = Some(diagnostic);
    }
}
