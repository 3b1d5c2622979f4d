//! The bodies of a unit as routines and charts.
//!
//! A unit has one body or several worksheets, and beside them the bodies of
//! its transitions and actions; a chart holds further ones inline. Each ladder
//! becomes a routine of its own: what runs together in a scan stands together.

use std::borrow::Cow;

use foldhash::{HashMap, HashSet};
use logic::Name;
use source::{Diagnostic, Span, codes};

use super::chart;
use super::diagram::{Diagram, Node, NodeKind};
use super::drawing;
use super::interface::{Unit, UnitKind, name_of};
use super::names::Names;
use super::network::{self, Body};
use super::rungs::{self, Plan};
use super::standard::standard;
use super::xml::{Tag, Text};
use crate::{Chart, Declarations, Role, Routine, Rung};

/// What reading the bodies of a project needs and gives.
pub(super) struct Project<'a> {
    pub(super) names: &'a mut Names,
    pub(super) declarations: &'a Declarations,
    pub(super) mentioned: &'a HashSet<String>,
    pub(super) diagnostics: &'a mut Vec<Diagnostic>,
    pub(super) charts: Vec<Chart>,
}

/// How a body is called: `POU`, `POU/transition NAME`.
struct Place<'t> {
    scope: Name,
    name: Name,
    role: Role,
    /// The transition whose condition it is: its name and id.
    transition: Option<(Option<Text<'t>>, Cow<'t, str>)>,
}

/// The routines of a unit; its charts go to the project.
pub(super) fn routines(project: &mut Project<'_>, at: usize, unit: &Unit<'_, '_>) -> Vec<Routine> {
    let role = match unit.kind {
        UnitKind::Program => Role::Main,
        UnitKind::FunctionBlock | UnitKind::Function => Role::Definition,
    };
    let main = Place {
        scope: unit.name.clone(),
        name: unit.name.clone(),
        role,
        transition: None,
    };
    let mut reading = UnitReading {
        project,
        at,
        unit,
        routines: Vec::new(),
    };
    let bodies = unit.tag.children().filter(|tag| tag.name() == "body");
    reading.bodies(&main, bodies);
    for tag in unit.tag.inside(has_body) {
        let place = reading.place(tag, &name_of(tag));
        reading.bodies(&place, tag.children().filter(|tag| tag.name() == "body"));
    }
    reading.routines
}

/// Whether a tag is a transition, action or method with a body of its own.
fn has_body(tag: Tag<'_, '_>) -> bool {
    matches!(tag.name(), "transition" | "action" | "Method") && tag.child("body").is_some()
}

struct UnitReading<'r, 'a, 'd, 't> {
    project: &'r mut Project<'a>,
    at: usize,
    unit: &'r Unit<'d, 't>,
    routines: Vec<Routine>,
}

impl UnitReading<'_, '_, '_, '_> {
    /// A transition or action of the unit.
    fn place<'t>(&self, tag: Tag<'_, 't>, name: &str) -> Place<'t> {
        let kind = tag.name();
        let named = tag.attribute("name");
        let named = named.filter(|text| !text.value.trim().is_empty());
        Place {
            scope: format!("{}/{} {name}", self.unit.name, kind.to_lowercase()).into(),
            name: name.into(),
            role: match self.unit.kind {
                UnitKind::Program => Role::Called,
                UnitKind::FunctionBlock | UnitKind::Function => Role::Definition,
            },
            transition: (kind == "transition").then(|| (named, id_of(tag))),
        }
    }

    /// Reads worksheets that make one routine.
    fn bodies<'d, 't: 'd>(&mut self, place: &Place<'_>, bodies: impl Iterator<Item = Tag<'d, 't>>) {
        let mut rungs = Vec::new();
        let mut span: Option<Span> = None;
        let first = self.routines.len();
        for body in bodies {
            for language in body.children() {
                if self.language(place, language, &mut rungs) {
                    let covered = span.map(|span| span.cover(language.span()));
                    span = covered.or(Some(language.span()));
                }
            }
        }
        if let Some(span) = span {
            self.add(place, rungs, span);
            // Ladders inside of a chart come after the body that holds it.
            if let Some(added) = self.routines.get_mut(first..) {
                added.rotate_right(1);
            }
        }
    }

    fn add(&mut self, place: &Place<'_>, mut rungs: Vec<Rung>, span: Span) {
        for (number, rung) in (0..).zip(&mut rungs) {
            rung.number = number;
        }
        self.routines.push(Routine {
            scope: place.scope.clone(),
            unit: self.unit.name.clone(),
            name: place.name.clone(),
            role: place.role,
            rungs,
            span,
        });
    }

    /// Reads one language's part of a body. Whether it makes a routine.
    fn language(&mut self, place: &Place<'_>, tag: Tag<'_, '_>, rungs: &mut Vec<Rung>) -> bool {
        match tag.name() {
            "LD" | "FBD" => {
                self.ladder(place, tag, rungs);
                true
            }
            "SFC" => {
                let before = rungs.len();
                self.chart(place, tag, rungs);
                rungs.len() > before
            }
            "ST" | "IL" => {
                self.other_language(place, tag, tag.name());
                false
            }
            "addData" if tag.inside(|tag| tag.name() == "CFC").next().is_some() => {
                self.other_language(place, tag, "CFC");
                false
            }
            _ => false,
        }
    }

    fn other_language(&mut self, place: &Place<'_>, tag: Tag<'_, '_>, language: &str) {
        let message = format!("the body of `{}` is written in {language}", place.scope);
        self.project.diagnostics.push(
            Diagnostic::new(codes::OTHER_LANGUAGE, tag.span(), message)
                .help("variables that it writes are taken as inputs"),
        );
    }

    fn ladder(&mut self, place: &Place<'_>, tag: Tag<'_, '_>, rungs: &mut Vec<Rung>) {
        let networks: Vec<_> = tag
            .children()
            .filter(|part| part.name() == "network")
            .collect();
        if networks.is_empty() {
            self.drawing(place, tag, rungs);
        }
        for network in networks {
            self.drawing(place, network, rungs);
        }
    }

    /// Reads the elements drawn in a body. What conditions among them say.
    fn drawing(
        &mut self,
        place: &Place<'_>,
        tag: Tag<'_, '_>,
        rungs: &mut Vec<Rung>,
    ) -> HashMap<Span, Name> {
        let mut diagram = drawing::read(tag, self.project.diagnostics);
        if let Some((name, id)) = &place.transition {
            diagram.right_rail_is_condition(name.as_ref(), id.clone());
        }
        let names = &*self.project.names;
        let remembers = |node: &Node<'_>| remembers(node, names);
        let plans = rungs::plan(&diagram, &remembers, self.project.diagnostics);
        let mut conditions = HashMap::default();
        let mut body = Body {
            consumers: &consumers(&diagram),
            diagram: &diagram,
            turns: &plans.turns,
            mentioned: self.project.mentioned,
            unit: self.at,
            names: self.project.names,
            declarations: self.project.declarations,
            diagnostics: self.project.diagnostics,
            conditions: &mut conditions,
        };
        for plan in &plans.rungs {
            let span = span(&diagram, plan);
            let comment = plan.comment.as_deref().map(Name::from);
            let network = network::lower(&mut body, plan, span);
            rungs.push(Rung::new(0, comment, network, span));
        }
        conditions
    }

    fn chart(&mut self, place: &Place<'_>, tag: Tag<'_, '_>, rungs: &mut Vec<Rung>) {
        let conditions = self.drawing(place, tag, rungs);
        let scope = place.scope.clone();
        let chart = chart::read(tag, scope, &conditions, self.project.diagnostics);
        self.project.charts.push(chart);
        self.inline(tag);
    }

    /// Ladders inside of a chart's conditions and actions.
    fn inline(&mut self, chart: Tag<'_, '_>) {
        for owner in chart.inside(|tag| matches!(tag.name(), "transition" | "action")) {
            let inline = match owner.child("condition") {
                Some(condition) => condition.child("inline"),
                None => owner.child("inline"),
            };
            let Some(inline) = inline else { continue };
            let named = [name_of(owner), name_of(inline)];
            let named = named.into_iter().find(|name| !name.is_empty());
            let place = self.place(owner, &named.unwrap_or_else(|| id_of(owner).into()));
            for language in inline.children() {
                if matches!(language.name(), "LD" | "FBD") {
                    let mut rungs = Vec::new();
                    self.ladder(&place, language, &mut rungs);
                    self.add(&place, rungs, language.span());
                }
            }
        }
    }
}

fn id_of<'t>(tag: Tag<'_, 't>) -> Cow<'t, str> {
    let id = tag.attribute("localId");
    id.map_or(Cow::Borrowed(""), Text::trimmed)
}

/// Whether an output of the element may be read before it is solved: that of
/// a block with an instance, or of a variable that is written and read at one
/// place.
fn remembers(node: &Node<'_>, names: &Names) -> bool {
    let block = match &node.kind {
        NodeKind::Block(block) => block,
        NodeKind::InOutVariable { .. } => return true,
        _ => return false,
    };
    let name = &block.name.value;
    block.instance.is_some()
        && match names.unit_kind(name) {
            Some(kind) => kind == UnitKind::FunctionBlock,
            None => standard(name).is_none_or(|standard| standard.remembers()),
        }
}

/// By node: the nodes that it feeds.
fn consumers(diagram: &Diagram<'_>) -> Vec<Vec<usize>> {
    let mut consumers = vec![Vec::new(); diagram.nodes.len()];
    for (at, node) in diagram.nodes.iter().enumerate() {
        for source in node.inputs.iter().flat_map(|input| &input.sources) {
            if let Some(list) = consumers.get_mut(source.node) {
                list.push(at);
            }
        }
    }
    consumers
}

fn span(diagram: &Diagram<'_>, plan: &Plan) -> Span {
    let nodes = plan.nodes.iter().filter_map(|&at| diagram.nodes.get(at));
    nodes
        .map(|node| node.span)
        .reduce(Span::cover)
        .unwrap_or_default()
}
