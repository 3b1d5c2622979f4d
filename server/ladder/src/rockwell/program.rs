//! From a Rockwell project to the model's program.
//!
//! Every rung text is read into its tree first; then the names are settled over
//! all operands ([`Names`]); then networks are drawn. Routines come in the order
//! of solving: programs as the tasks schedule them, in each the main routine
//! first; then the Add-On Instructions.

use std::ops::Range;

use foldhash::{HashMap, HashSet};
use source::{Diagnostic, codes};

use super::catalogue::{self, Meaning, SlotKind};
use super::declarations::{all_tags, declarations};
use super::names::{Names, Scope, lower};
use super::neutral::{self, Instruction, Item, Statement};
use super::project::{Edits, Extent, Inhibition, Project, RungSource, Unit, UnitKind};
use super::rung::{self, Callable, Definition, Place, Surroundings};
use crate::reading::Reading;
use crate::{PinDirection, Placed, Program, Role, Routine, Rung};

/// The routines of a unit with their rungs read into trees.
struct Parsed<'p, 't> {
    unit: &'p Unit<'t>,
    scope: Scope,
    callable: Callable<'p>,
    routines: Vec<Vec<ParsedRung<'p, 't>>>,
}

struct ParsedRung<'p, 't> {
    source: &'p RungSource<'t>,
    statements: Vec<Statement>,
}

/// The program that `project` is.
pub(super) fn program(mut project: Project<'_>) -> Reading {
    let mut diagnostics = std::mem::take(&mut project.diagnostics);
    let charts = std::mem::take(&mut project.charts);
    let mut names = Names::declared(&project);
    let units: Vec<Parsed<'_, '_>> = project
        .units
        .iter()
        .enumerate()
        .map(|(place, unit)| parse(unit, place + 1, &mut diagnostics))
        .collect();
    for unit in &units {
        unit.each_instruction(&mut |text, instruction| {
            for operand in &instruction.operands {
                names.note(unit.scope, text.get(operand.clone()).unwrap_or_default());
            }
        });
    }
    names.settle();

    let surroundings = surroundings(&project, &units, &names);
    let mut routines = Vec::new();
    for unit in in_order(&project, &units) {
        let mut of_unit = unit.routines(&project, &surroundings, &mut names, &mut diagnostics);
        of_unit.sort_by_key(|routine| routine.role != Role::Main);
        routines.append(&mut of_unit);
    }
    let declarations = declarations(&project, &names, &mut diagnostics);
    Reading {
        program: Program {
            format: project.format,
            name: project.name.as_str().into(),
            declarations,
            routines,
            charts,
        }
        .into(),
        diagnostics,
    }
}

/// Reads the rungs of a unit that are in force.
fn parse<'p, 't>(
    unit: &'p Unit<'t>,
    scope: Scope,
    diagnostics: &mut Vec<Diagnostic>,
) -> Parsed<'p, 't> {
    let mut routines = Vec::new();
    for routine in &unit.routines {
        let mut rungs = Vec::new();
        for rung in &routine.rungs {
            if let Some(diagnostic) = pending_edit(rung, unit.edits) {
                diagnostics.push(diagnostic);
            }
            if !unit.edits.in_force(&rung.edit) {
                continue;
            }
            let (statements, faults) = neutral::parse(rung.text.text());
            diagnostics.extend(faults.into_iter().map(|fault| {
                let span = rung.text.span(fault.place);
                Diagnostic::new(codes::NEUTRAL_TEXT_SYNTAX, span, fault.message).help(fault.help)
            }));
            rungs.push(ParsedRung {
                source: rung,
                statements,
            });
        }
        routines.push(rungs);
    }
    let mut callable = Callable::default();
    for name in &unit.routine_names {
        callable.entry(lower(name)).or_insert(name);
    }
    Parsed {
        unit,
        scope,
        callable,
        routines,
    }
}

fn pending_edit(rung: &RungSource<'_>, edits: Edits) -> Option<Diagnostic> {
    let what = Edits::describe(&rung.edit)?;
    let outcome = match (edits.in_force(&rung.edit), edits) {
        (true, Edits::Original) => "the controller still executes it, so it is read",
        (true, Edits::Tested) => "edits are being tested, so it is read",
        (false, Edits::Original) => "the controller does not execute it yet, so it is not read",
        (false, Edits::Tested) => "edits are being tested, so it is not read",
    };
    let message = format!("rung {} is {what}: {outcome}", rung.number);
    Some(
        Diagnostic::new(codes::PENDING_EDIT, rung.span, message)
            .help("accept or cancel the edits in the editor, and export again"),
    )
}

impl Parsed<'_, '_> {
    /// Calls `visit` with every instruction and the text it is written in.
    fn each_instruction(&self, visit: &mut impl FnMut(&str, &Instruction)) {
        for rung in self.routines.iter().flatten() {
            for statement in &rung.statements {
                each_instruction(&statement.items, rung.source.text.text(), visit);
            }
        }
    }

    fn routines(
        &self,
        project: &Project<'_>,
        surroundings: &Surroundings,
        names: &mut Names,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Routine> {
        // Only a program that names no main routine begins where no call leads.
        let called = match self.unit.kind {
            UnitKind::Program { main: None } => self.called(),
            _ => HashSet::default(),
        };
        let mut routines = Vec::new();
        for (source, parsed) in self.unit.routines.iter().zip(&self.routines) {
            let mut rungs = Vec::new();
            for rung in parsed {
                rungs.extend(self.rungs(rung, surroundings, names, diagnostics));
            }
            routines.push(Routine {
                scope: scope_name(&self.unit.name, &source.name).into(),
                unit: self.unit.name.as_str().into(),
                name: source.name.as_str().into(),
                role: role(project, self.unit, &source.name, &called),
                rungs,
                span: source.span,
            });
        }
        routines
    }

    /// The model's rungs of one rung: one for every statement of its text,
    /// which is one in every export, and an empty one where it has none.
    fn rungs(
        &self,
        rung: &ParsedRung<'_, '_>,
        surroundings: &Surroundings,
        names: &mut Names,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Rung> {
        let source = rung.source;
        let place = Place {
            scope: self.scope,
            routines: &self.callable,
            text: &source.text,
            span: source.span,
        };
        let mut draw = |statement: &Statement| -> Placed {
            rung::network(statement, place, surroundings, names, diagnostics)
        };
        let networks: Vec<Placed> = if rung.statements.is_empty() {
            vec![draw(&Statement::default())]
        } else {
            rung.statements.iter().map(draw).collect()
        };
        networks
            .into_iter()
            .map(|drawn| Rung::new(source.number, source.comment.clone(), drawn, source.span))
            .collect()
    }

    /// The routines that some rung of the unit calls, in lower case.
    fn called(&self) -> HashSet<String> {
        let mut called = HashSet::default();
        self.each_instruction(&mut |text, instruction| {
            let mnemonic = text.get(instruction.mnemonic.clone()).unwrap_or_default();
            let calls = matches!(
                catalogue::meaning(mnemonic),
                Some(Meaning::Call | Meaning::Loop)
            );
            if let (true, Some(routine)) = (calls, instruction.operands.first()) {
                called.insert(text.get(routine.clone()).unwrap_or_default().to_lowercase());
            }
        });
        called
    }
}

fn each_instruction(items: &[Item], text: &str, visit: &mut impl FnMut(&str, &Instruction)) {
    for item in items {
        match item {
            Item::Instruction(instruction) => visit(text, instruction),
            Item::Branch(branch) => {
                for leg in &branch.legs {
                    each_instruction(leg, text, visit);
                }
            }
            Item::Unreadable(_) => {}
        }
    }
}

fn scope_name(unit: &str, routine: &str) -> String {
    match (unit, routine) {
        ("", routine) => routine.to_owned(),
        (unit, "") => unit.to_owned(),
        (unit, routine) => format!("{unit}/{routine}"),
    }
}

/// The units in the order in which they are solved.
fn in_order<'u, 'p, 't>(
    project: &Project<'_>,
    units: &'u [Parsed<'p, 't>],
) -> Vec<&'u Parsed<'p, 't>> {
    let mut order: HashMap<String, usize> = HashMap::default();
    for name in project.schedule.iter().flatten() {
        let next = order.len();
        order.entry(name.to_lowercase()).or_insert(next);
    }
    let mut sorted: Vec<_> = units.iter().collect();
    sorted.sort_by_key(|parsed| {
        let place = order.get(&parsed.unit.name.to_lowercase());
        (
            parsed.unit.is_instruction(),
            place.copied().unwrap_or(usize::MAX),
        )
    });
    sorted
}

/// When a routine is solved.
///
/// A routine or rungs exported by themselves run every scan: nothing in the file
/// says otherwise. Of a program, the main routine does; a program that names no
/// main routine begins wherever no call leads. A program that no task schedules,
/// or that is inhibited, does not run: its main routine waits for a call that
/// never comes, which is how the model says so.
fn role(project: &Project<'_>, unit: &Unit<'_>, routine: &str, called: &HashSet<String>) -> Role {
    let UnitKind::Program { main } = &unit.kind else {
        return Role::Definition;
    };
    if project.extent == Extent::Routine {
        return Role::Main;
    }
    let scheduled = project.schedule.as_ref().is_none_or(|schedule| {
        schedule
            .iter()
            .any(|name| name.eq_ignore_ascii_case(&unit.name))
    });
    let starts = match main {
        Some(main) => main.eq_ignore_ascii_case(routine),
        None => !called.contains(&routine.to_lowercase()),
    };
    if starts && scheduled && unit.inhibited == Inhibition::Runs {
        Role::Main
    } else {
        Role::Called
    }
}

fn surroundings(project: &Project<'_>, units: &[Parsed<'_, '_>], names: &Names) -> Surroundings {
    let mut surroundings = Surroundings::default();
    for parsed in units {
        if let UnitKind::Instruction { passed } = &parsed.unit.kind {
            let passed = passed
                .iter()
                .map(|(name, class)| (name.clone(), rung::direction(*class)))
                .collect();
            let definition = Definition {
                passed,
                shapes_power: writes_enable_out(parsed),
            };
            let name = parsed.unit.name.to_lowercase();
            surroundings.definitions.entry(name).or_insert(definition);
        }
        parsed.each_instruction(&mut |text, instruction| {
            for range in written(text, instruction) {
                let operand = text.get(range).unwrap_or_default();
                // An alias may stand for a preset; it is written without a dot.
                let may_be_preset = if operand.contains('.') {
                    operand
                        .get(operand.len().saturating_sub(4)..)
                        .is_some_and(|end| end.eq_ignore_ascii_case(".pre"))
                } else {
                    names.has_aliases()
                };
                if !may_be_preset {
                    continue;
                }
                let place = names.place_of(parsed.scope, operand);
                surroundings
                    .written_presets
                    .extend(place.filter(|(.., path)| path.ends_with(".pre")));
            }
        });
    }
    let tags = all_tags(project);
    for (scope, tag) in tags.filter(|(_, tag)| !tag.presets.is_empty()) {
        let key = (scope, tag.name.to_lowercase());
        let presets = tag.presets.iter().cloned().collect();
        surroundings.presets.entry(key).or_insert(presets);
    }
    surroundings
}

fn writes_enable_out(parsed: &Parsed<'_, '_>) -> bool {
    let mut writes = false;
    parsed.each_instruction(&mut |text, instruction| {
        let is_it = |range: &Range<usize>| {
            text.get(range.clone())
                .is_some_and(|operand| operand.eq_ignore_ascii_case("EnableOut"))
        };
        writes |= !writes
            && instruction.operands.iter().any(is_it)
            && written(text, instruction).any(|range| is_it(&range));
    });
    writes
}

/// The operands of an instruction that it writes, as far as the catalogue
/// knows; all of them for one that it does not know.
fn written<'i>(
    text: &str,
    instruction: &'i Instruction,
) -> impl Iterator<Item = Range<usize>> + use<'i> {
    let mnemonic = text.get(instruction.mnemonic.clone()).unwrap_or_default();
    let meaning = catalogue::meaning(mnemonic);
    let operands = instruction.operands.iter().enumerate();
    operands
        .filter(move |(place, _)| writes(meaning, *place))
        .map(|(_, range)| range.clone())
}

/// Whether an instruction of this meaning writes its operand at `place`.
fn writes(meaning: Option<Meaning>, place: usize) -> bool {
    match meaning {
        Some(Meaning::Coil(_) | Meaning::Compute | Meaning::Clear | Meaning::Reset) => place == 0,
        Some(Meaning::Move | Meaning::Unary(_) | Meaning::EdgeOutput(_) | Meaning::Loop) => {
            place == 1
        }
        Some(Meaning::Binary(_)) => place == 2,
        Some(Meaning::Box(slots, _)) => matches!(
            slots.get(place).map(|slot| slot.kind),
            Some(
                SlotKind::Value(PinDirection::Output | PinDirection::InOut)
                    | SlotKind::Array(PinDirection::Output | PinDirection::InOut)
            )
        ),
        Some(Meaning::Call) | None => true,
        Some(_) => false,
    }
}
