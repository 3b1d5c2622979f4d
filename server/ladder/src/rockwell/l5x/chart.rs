//! Sequential function charts in L5X: steps, transitions and branches by number,
//! joined by directed links.
//!
//! A branch is a node with legs: power of the sequence enters a divergence at
//! its own number and leaves it at its legs', and the other way round in a
//! convergence. A branch may lead into another one. Here all of them are
//! resolved: a transition says which steps stand before and after it.

use std::collections::{HashMap, HashSet};

use logic::Name;
use source::{Diagnostic, codes};

use super::super::xml::Element;
use super::name;
use crate::{Chart, ChartAction, ChartStep, ChartTransition};

/// The numbers that follow, and that precede, every number.
#[derive(Default)]
struct Links {
    after: HashMap<String, Vec<String>>,
    before: HashMap<String, Vec<String>>,
}

/// The chart in `content`. A link to nothing is reported.
pub(super) fn chart(
    scope: &str,
    content: Element<'_, '_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Chart {
    let mut chart = Chart {
        scope: scope.into(),
        span: content.span(),
        ..Chart::default()
    };
    let mut steps: HashMap<String, usize> = HashMap::new();
    let mut links = Links::default();
    let mut known: HashSet<String> = HashSet::new();
    let mut transitions: HashSet<String> = HashSet::new();
    for element in content.children() {
        let number = name(element, "ID");
        match element.name() {
            "Step" | "Stop" => {
                steps.insert(number.clone(), chart.steps.len());
                chart.steps.push(step(element));
            }
            "Transition" => {
                transitions.insert(number.clone());
            }
            "Branch" => {
                let diverges = element.attribute_is("BranchFlow", "Diverge");
                for leg in element.children_named("Leg") {
                    let leg = name(leg, "ID");
                    known.insert(leg.clone());
                    match diverges {
                        true => links.add(&number, &leg),
                        false => links.add(&leg, &number),
                    }
                }
            }
            "DirectedLink" => links.add(&name(element, "FromID"), &name(element, "ToID")),
            _ => {}
        }
        known.insert(number);
    }
    for link in content.children_named("DirectedLink") {
        for end in ["FromID", "ToID"] {
            let number = name(link, end);
            if !known.contains(&number) {
                let message = format!("the link leads to number {number}, which the chart lacks");
                diagnostics.push(
                    Diagnostic::new(codes::DANGLING_CONNECTION, link.span(), message)
                        .help("export the routine again; the link is left out"),
                );
            }
        }
    }
    for element in content.children_named("Transition") {
        let number = name(element, "ID");
        chart.transitions.push(ChartTransition {
            name: name(element, "Operand").into(),
            from: reached(&number, &links.before, &steps, &transitions),
            to: reached(&number, &links.after, &steps, &transitions),
            condition: element
                .child("Condition")
                .map(structured_text)
                .unwrap_or_else(|| "".into()),
            span: element.span(),
        });
    }
    chart
}

impl Links {
    fn add(&mut self, from: &str, to: &str) {
        self.after
            .entry(from.to_owned())
            .or_default()
            .push(to.to_owned());
        self.before
            .entry(to.to_owned())
            .or_default()
            .push(from.to_owned());
    }
}

/// The steps next to `number`, through branches, in the order of the chart.
fn reached(
    number: &str,
    links: &HashMap<String, Vec<String>>,
    steps: &HashMap<String, usize>,
    transitions: &HashSet<String>,
) -> Vec<usize> {
    let mut found = Vec::new();
    let mut seen: HashSet<&str> = HashSet::from([number]);
    let mut waiting: Vec<&str> = vec![number];
    while let Some(at) = waiting.pop() {
        for next in links.get(at).into_iter().flatten() {
            if !seen.insert(next) {
                continue;
            }
            match steps.get(next) {
                Some(&step) => found.push(step),
                None if transitions.contains(next) => {}
                None => waiting.push(next),
            }
        }
    }
    found.sort_unstable();
    found
}

fn step(element: Element<'_, '_>) -> ChartStep {
    ChartStep {
        name: name(element, "Operand").into(),
        initial: element.attribute_is("InitialStep", "true"),
        actions: element.children_named("Action").map(action).collect(),
        span: element.span(),
    }
}

fn action(element: Element<'_, '_>) -> ChartAction {
    let qualifier = name(element, "Qualifier");
    let body = match element.child("Body") {
        Some(body) => structured_text(body),
        None => name(element, "Operand").into(),
    };
    ChartAction {
        qualifier: letter(&qualifier).unwrap_or(&qualifier).into(),
        body,
    }
}

/// The qualifier's letters as the standard writes them.
fn letter(qualifier: &str) -> Option<&'static str> {
    Some(match qualifier {
        "NonStored" => "N",
        "Stored" => "S",
        "Reset" => "R",
        "Pulse" => "P",
        "PulseRisingEdge" => "P1",
        "PulseFallingEdge" => "P0",
        "TimeLimited" => "L",
        "TimeDelayed" => "D",
        "StoredAndTimeLimited" => "SL",
        "StoredAndTimeDelayed" => "SD",
        "DelayedAndStored" => "DS",
        _ => return None,
    })
}

/// The lines of structured text inside, without empty ones.
fn structured_text(element: Element<'_, '_>) -> Name {
    let lines: Vec<String> = element
        .descendants()
        .filter(|inside| inside.name() == "Line")
        .map(|line| line.passage().text().trim().to_owned())
        .filter(|line| !line.is_empty())
        .collect();
    lines.join("\n").into()
}
