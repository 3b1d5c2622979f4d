//! Sorts rungs into routines.
//!
//! `program NAME` begins a program, `routine NAME` a routine of it. Rungs
//! before the first `routine` line are the program's main routine, which bears
//! the program's name.

use std::collections::HashMap;

use logic::Name;
use logic::notation::Token;
use source::{Diagnostic, Span, codes};

use super::network::place;
use crate::reading::Source;
use crate::{Role, Routine};

/// The name of the main routine of a text that names no program.
const NAMELESS: &str = "main";

/// The routines so far, the last of which takes the next rung.
pub(super) struct Sections {
    /// The name of the first program, empty where none has one.
    pub(super) program: Name,
    /// All routines.
    pub(super) routines: Vec<Routine>,
    unit: Name,
    /// Whether the last routine belongs to the program that is being read.
    open: bool,
    begun: HashMap<Name, Span>,
}

impl Sections {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        Self {
            program: "".into(),
            routines: Vec::new(),
            unit: "".into(),
            open: false,
            begun: HashMap::new(),
        }
    }

    /// A `program` line.
    pub(super) fn begin_program(
        &mut self,
        source: Source<'_>,
        name: Token,
        findings: &mut Vec<Diagnostic>,
    ) {
        self.unit = name.name(source.text).into();
        if self.program.is_empty() {
            self.program = self.unit.clone();
        }
        self.open = false;
        self.begins_once(self.unit.clone(), "program", name.span, findings);
    }

    /// A `routine` line, standing at `span`.
    pub(super) fn begin_routine(
        &mut self,
        source: Source<'_>,
        name: Token,
        role: Role,
        span: Span,
        findings: &mut Vec<Diagnostic>,
    ) {
        let routine = Name::from(name.name(source.text));
        let scope = if self.unit.is_empty() {
            routine.clone()
        } else {
            format!("{}/{routine}", self.unit).into()
        };
        self.begins_once(scope.clone(), "routine", name.span, findings);
        self.routines.push(Routine {
            scope,
            unit: self.unit.clone(),
            name: routine,
            role,
            rungs: Vec::new(),
            span: place(source, span),
        });
        self.open = true;
    }

    /// The routine that a rung at `span` belongs to.
    pub(super) fn routine_of_rung(&mut self, span: Span) -> &mut Routine {
        if !self.open || self.routines.is_empty() {
            let name = if self.unit.is_empty() {
                NAMELESS.into()
            } else {
                self.unit.clone()
            };
            self.routines.push(Routine {
                scope: name.clone(),
                unit: self.unit.clone(),
                name,
                role: Role::Main,
                rungs: Vec::new(),
                span,
            });
            self.open = true;
        }
        let last = self.routines.len() - 1;
        &mut self.routines[last]
    }

    fn begins_once(&mut self, scope: Name, what: &str, span: Span, findings: &mut Vec<Diagnostic>) {
        if let Some(first) = self.begun.get(&scope) {
            let finding = Diagnostic::new(
                codes::DECLARED_TWICE,
                span,
                format!("the {what} `{scope}` begins twice"),
            )
            .related(*first, "begins here")
            .help("give one of them another name; until then calls lead to the first");
            findings.push(finding);
            return;
        }
        self.begun.insert(scope, span);
    }
}
