//! L5X: a project, or a part of one, as XML.
//!
//! An export of a part carries its surroundings along, marked `Use="Context"`:
//! tags, data types, the program around a routine. Their declarations are read;
//! their rungs are not the subject and are left out. Add-On Instructions are the
//! exception: a call cannot be understood without the definition, so theirs are
//! always read, but for the export of a data type, whose program is empty.

mod chart;
mod tags;

use source::{Diagnostic, codes};

use super::passage::Passage;
use super::program;
use super::project::{
    Edits, Extent, Inhibition, Project, RoutineSource, RungSource, Unit, UnitKind,
};
use super::xml::{self, Element};
use crate::Format;
use crate::reading::{Reading, Source};

/// Reads an L5X file.
pub(super) fn read(source: Source<'_>) -> Reading {
    let mut project = Project::empty(Format::L5x);
    let document = xml::read(source, &mut project.diagnostics);
    if let Some(root) = document.root() {
        fill(&mut project, root);
    }
    program::program(project)
}

fn fill<'t>(project: &mut Project<'t>, root: Element<'_, 't>) {
    let Some(controller) = root.child("Controller") else {
        return;
    };
    project.name = name(root, "TargetName");
    if project.name.is_empty() {
        project.name = name(controller, "Name");
    }
    project.tags = tags::all(controller);
    project.schedule = schedule(controller);
    if root.attribute_is("TargetType", "Routine") || root.attribute_is("TargetType", "Rung") {
        project.extent = Extent::Routine;
    }
    if root.attribute_is("TargetType", "DataType") {
        return;
    }
    let everything = !names_target(controller);
    let subject = Subject {
        whole: everything || is_target(controller),
    };
    for program in inside(controller, "Programs", "Program") {
        add_program(project, program, subject);
    }
    for definition in inside(
        controller,
        "AddOnInstructionDefinitions",
        "AddOnInstructionDefinition",
    ) {
        add_definition(project, definition, UnitSource::Open);
    }
    for encoded in inside(controller, "AddOnInstructionDefinitions", "EncodedData") {
        project.diagnostics.push(protected(encoded));
        add_definition(project, encoded, UnitSource::Encoded);
    }
}

/// What of a file is meant, as far as decided outside an element.
#[derive(Clone, Copy)]
struct Subject {
    /// Whether all that is inside is meant.
    whole: bool,
}

impl Subject {
    fn inside(self, element: Element<'_, '_>) -> Self {
        Self {
            whole: self.whole || is_target(element),
        }
    }
}

/// Whether something that holds rungs is marked as the target. Files that other
/// tools wrote may mark nothing; then all of them is meant.
fn names_target(controller: Element<'_, '_>) -> bool {
    let mut definitions = inside(
        controller,
        "AddOnInstructionDefinitions",
        "AddOnInstructionDefinition",
    );
    let mut programs = inside(controller, "Programs", "Program");
    is_target(controller)
        || definitions.any(is_target)
        || programs.any(|program| {
            is_target(program)
                || inside(program, "Routines", "Routine").any(|routine| {
                    let mut rungs = inside(routine, "RLLContent", "Rung");
                    is_target(routine) || rungs.any(is_target)
                })
        })
}

fn is_target(element: Element<'_, '_>) -> bool {
    element.attribute_is("Use", "Target")
}

/// Whether an Add-On Instruction's logic can be seen.
#[derive(Clone, Copy, PartialEq)]
enum UnitSource {
    Open,
    Encoded,
}

/// The elements called `item` in the list called `list`.
fn inside<'d, 't: 'd>(
    element: Element<'d, 't>,
    list: &'static str,
    item: &'static str,
) -> impl Iterator<Item = Element<'d, 't>> {
    element
        .children_named(list)
        .flat_map(move |list| list.children_named(item))
}

fn name(element: Element<'_, '_>, attribute: &str) -> String {
    element
        .attribute(attribute)
        .unwrap_or_default()
        .into_owned()
}

/// The programs as the tasks run them.
fn schedule(controller: Element<'_, '_>) -> Option<Vec<String>> {
    let programs: Vec<String> = inside(controller, "Tasks", "Task")
        .flat_map(|task| inside(task, "ScheduledPrograms", "ScheduledProgram"))
        .map(|program| name(program, "Name"))
        .collect();
    (!programs.is_empty()).then_some(programs)
}

fn add_program<'t>(project: &mut Project<'t>, element: Element<'_, 't>, subject: Subject) {
    let main = element
        .attribute("MainRoutineName")
        .map(|name| name.into_owned());
    let mut unit = Unit::empty(UnitKind::Program { main }, name(element, "Name"));
    unit.tags = tags::all(element);
    if element.attribute_is("TestEdits", "true") {
        unit.edits = Edits::Tested;
    }
    if element.attribute_is("Disabled", "true") {
        unit.inhibited = Inhibition::Inhibited;
    }
    add_routines(project, &mut unit, element, subject.inside(element));
    project.units.push(unit);
}

fn add_definition<'t>(project: &mut Project<'t>, element: Element<'_, 't>, source: UnitSource) {
    let kind = UnitKind::Instruction {
        passed: tags::passed(element),
    };
    let mut unit = Unit::empty(kind, name(element, "Name"));
    unit.tags = tags::of_definition(element);
    if source == UnitSource::Open {
        add_routines(project, &mut unit, element, Subject { whole: true });
    }
    project.units.push(unit);
}

fn add_routines<'t>(
    project: &mut Project<'t>,
    unit: &mut Unit<'t>,
    element: Element<'_, 't>,
    subject: Subject,
) {
    for encoded in inside(element, "Routines", "EncodedData") {
        project.diagnostics.push(protected(encoded));
        unit.routine_names.push(name(encoded, "Name"));
    }
    for routine in inside(element, "Routines", "Routine") {
        let routine_name = name(routine, "Name");
        unit.routine_names.push(routine_name.clone());
        let subject = subject.inside(routine);
        let is_empty = routine.children().all(|body| body.name() == "Description");
        if subject.whole && is_empty && routine.attribute_is("Type", "RLL") {
            unit.routines.push(RoutineSource {
                name: routine_name,
                rungs: Vec::new(),
                span: routine.span(),
            });
            continue;
        }
        let scope = format!("{}/{routine_name}", unit.name);
        for body in routine.children() {
            match body.name() {
                "RLLContent" => {
                    let rungs = rungs(body, subject);
                    if subject.whole || !rungs.is_empty() {
                        unit.routines.push(RoutineSource {
                            name: routine_name.clone(),
                            rungs,
                            span: routine.span(),
                        });
                    }
                }
                "SFCContent" if subject.whole => {
                    let chart = chart::chart(&scope, body, &mut project.diagnostics);
                    project.charts.push(chart);
                }
                "STContent" if subject.whole => {
                    project.diagnostics.push(other_language(routine, "ST"));
                }
                "FBDContent" if subject.whole => {
                    project.diagnostics.push(other_language(routine, "FBD"));
                }
                _ => {}
            }
        }
    }
}

/// The rungs that are meant. One that the file ends in is left out: the end of
/// the file is reported already.
fn rungs<'t>(content: Element<'_, 't>, subject: Subject) -> Vec<RungSource<'t>> {
    let meant = content
        .children_named("Rung")
        .filter(|rung| rung.is_complete() && (subject.whole || is_target(*rung)));
    meant
        .enumerate()
        .map(|(place, rung)| RungSource {
            number: rung
                .attribute("Number")
                .and_then(|number| number.trim().parse().ok())
                .unwrap_or(u32::try_from(place).unwrap_or(u32::MAX)),
            edit: name(rung, "Type"),
            comment: rung.child("Comment").and_then(text),
            text: rung_text(rung),
            span: rung.span(),
        })
        .collect()
}

fn rung_text<'t>(rung: Element<'_, 't>) -> Passage<'t> {
    match rung.child("Text") {
        Some(text) => text.passage(),
        None => Passage::empty(rung.span().end as usize),
    }
}

/// The text of an element without the blanks around it. A project in several
/// languages has it once for each, and the first is taken.
fn text(element: Element<'_, '_>) -> Option<logic::Name> {
    let said = |element: Element<'_, '_>| -> Option<logic::Name> {
        let passage = element.passage();
        let text = passage.text().trim();
        match text.contains('\r') {
            true => Some(text.replace("\r\n", "\n").into()),
            false => (!text.is_empty()).then(|| text.into()),
        }
    };
    said(element).or_else(|| element.children().next().and_then(said))
}

fn protected(encoded: Element<'_, '_>) -> Diagnostic {
    let message = format!(
        "`{}` is exported as encoded data, so its logic cannot be read",
        name(encoded, "Name")
    );
    Diagnostic::new(codes::PROTECTED, encoded.tag_span(), message)
        .help("export it with its source key; its outputs are taken as unknown")
}

fn other_language(routine: Element<'_, '_>, language: &str) -> Diagnostic {
    let message = format!(
        "the routine `{}` is written in {language}, which is not read",
        name(routine, "Name")
    );
    Diagnostic::new(codes::OTHER_LANGUAGE, routine.tag_span(), message)
        .help("nothing to do; variables that it writes are taken as inputs")
}
