//! PLCopen TC6 XML: projects of OpenPLC, Beremiz, CODESYS and others.
//!
//! The format stores drawings. A body is a heap of elements with positions and
//! ids, joined by connections that run backwards, from an input to what feeds
//! it. Reading it goes in steps, a file each:
//!
//! * [`xml`]: the text as a tree that knows its bytes;
//! * [`interface`]: units (POUs) and what they declare;
//! * [`names`]: one name for every variable, through case, scope and address;
//! * [`drawing`]: the elements of a body and their connections, a [`diagram`];
//! * [`rungs`]: which elements make a rung, and the order of solving;
//! * [`network`]: rungs as the model's power flow; [`elements`] without pins,
//!   and [`boxes`] by the catalogue [`standard`]: those with a [`memory`],
//!   [`gates`], [`functions`], [`opaque`] ones;
//! * [`signal`] and [`expression`]: what flows, as power or as a term;
//! * [`chart`]: sequential function charts, as drawn;
//! * [`bodies`]: all of this for each body of a unit.
//!
//! Function block diagrams are made of the same elements and are read as
//! ladders without rails. Structured text and instruction lists are not read.

mod bodies;
mod boxes;
mod chart;
mod diagram;
mod drawing;
mod elements;
mod expression;
mod functions;
mod gates;
mod interface;
mod memory;
mod names;
mod network;
mod opaque;
mod rungs;
mod signal;
mod standard;
mod xml;

use foldhash::{HashMap, HashSet};
use logic::Name;
use source::{Diagnostic, codes};

use self::bodies::Project;
use self::interface::{Unit, UnitKind};
use self::names::{Names, key};
use self::xml::Tag;
use crate::reading::{Reading, Source};
use crate::{Format, Program};

/// Reads a PLCopen project, or a unit of one.
pub(crate) fn read(source: Source<'_>) -> Reading {
    let mut diagnostics = Vec::new();
    let document = xml::parse(source, &mut diagnostics);
    let root = document.root();
    let mut program = Program::empty(Format::Plcopen);
    program.name = project_name(root);

    let units = interface::units(root, &mut diagnostics);
    if units.is_empty() {
        diagnostics.push(
            Diagnostic::new(
                codes::NOT_A_PROGRAM,
                first_element(root),
                "this project holds no program, function block or function",
            )
            .help("export the units (POUs) along with the project"),
        );
    }
    let (mut names, declarations) = Names::new(
        &units,
        &interface::globals(root),
        &interface::structures(root),
        &mut diagnostics,
    );
    let mentioned = mentioned(root);
    let mut project = Project {
        names: &mut names,
        declarations: &declarations,
        mentioned: &mentioned,
        diagnostics: &mut diagnostics,
        charts: Vec::new(),
    };
    for at in solving_order(&units, &interface::running_order(root)) {
        if let Some(unit) = units.get(at) {
            let routines = bodies::routines(&mut project, at, unit);
            program.routines.extend(routines);
        }
    }
    program.charts = project.charts;
    program.declarations = declarations;
    Reading {
        program: program.into(),
        diagnostics,
    }
}

fn first_element(root: Tag<'_, '_>) -> source::Span {
    root.children()
        .next()
        .map_or_else(|| root.span(), Tag::span)
}

/// The name in the content header, where there is one.
fn project_name(root: Tag<'_, '_>) -> Name {
    let mut headers = root.inside(|tag| matches!(tag.name(), "contentHeader" | "types"));
    headers
        .next()
        .filter(|tag| tag.name() == "contentHeader")
        .map_or_else(|| "".into(), interface::name_of)
}

/// Programs as the resources run them, then the other programs, then blocks
/// and functions.
fn solving_order(units: &[Unit<'_, '_>], running: &[Name]) -> Vec<usize> {
    let mut turns: HashMap<String, usize> = HashMap::default();
    for name in running {
        let turn = turns.len();
        turns.entry(key(name)).or_insert(turn);
    }
    let mut order: Vec<_> = (0..units.len()).collect();
    order.sort_by_key(|&at| {
        units.get(at).map(|unit| {
            let defined = unit.kind != UnitKind::Program;
            let turn = turns.get(&key(&unit.name)).copied();
            (defined, turn.filter(|_| !defined).unwrap_or(usize::MAX))
        })
    });
    order
}

/// Every path that occurs anywhere, without case.
fn mentioned(root: Tag<'_, '_>) -> HashSet<String> {
    let texts = root.inside(|tag| match tag.name() {
        "ST" | "IL" => true,
        "variable" | "expression" => tag.children().next().is_none(),
        _ => false,
    });
    let mut paths = HashSet::default();
    for text in texts.filter_map(Tag::text) {
        let found = expression::variables(&text.value);
        paths.extend(
            found
                .into_iter()
                .filter_map(|at| Some(key(text.value.get(at)?))),
        );
    }
    paths
}
