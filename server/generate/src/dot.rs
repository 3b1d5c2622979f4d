use std::collections::HashMap;
use std::fmt::Write;

use grafcet::{Chart, Grafcet, PartKind, Step, StepKind, Transition};
use logic::Name;
use logic::notation::write as expression;

/// The grafcet as a picture's text for Graphviz.
///
/// Steps are boxes with their actions, initial steps have a double border, a
/// transition is a short bar with its receptivity beside it. Where a
/// transition has several steps before or after it, a double line joins or
/// parts them, as in the standard (IEC 60848, 4.3). Parts are drawn in frames.
/// Instances are written out, and reusable grafcets are left out.
pub fn to_dot(grafcet: &Grafcet) -> String {
    let grafcet = grafcet.instantiated();
    let mut picture = Picture::new(&grafcet);
    let title = grafcet.name.as_deref().unwrap_or("grafcet");
    picture.line(0, &format!("digraph {} {{", text(title)));
    picture.line(1, "rankdir=TB;");
    picture.line(1, "node [fontname=\"Helvetica\", fontsize=11];");
    picture.line(1, "edge [arrowhead=none];");
    picture.chart(&grafcet.chart, 1);
    for (nth, part) in grafcet.parts.iter().enumerate() {
        let word = match part.kind {
            PartKind::Partial => "",
            PartKind::Expansion { .. } => "expansion ",
            PartKind::Reusable { .. } => "reusable ",
        };
        picture.line(1, &format!("subgraph cluster_{nth} {{"));
        picture.line(
            2,
            &format!("label={};", text(&format!("{word}{}", part.name))),
        );
        picture.chart(&part.chart, 2);
        picture.line(1, "}");
    }
    // Arcs come last: they may lead from one part into another.
    for transition in grafcet.transitions() {
        picture.arcs(transition);
    }
    picture.line(0, "}");
    picture.out
}

struct Picture<'g> {
    out: String,
    /// Nodes are numbered, since names may hold anything.
    steps: HashMap<&'g Name, usize>,
    transitions: usize,
    drawn: usize,
}

impl<'g> Picture<'g> {
    fn new(grafcet: &'g Grafcet) -> Self {
        let mut steps = HashMap::new();
        for (nth, step) in grafcet.steps().enumerate() {
            steps.entry(&step.name).or_insert(nth);
        }
        Self {
            out: String::new(),
            steps,
            transitions: 0,
            drawn: 0,
        }
    }

    fn line(&mut self, depth: usize, line: &str) {
        let indent = "  ".repeat(depth);
        self.out.push_str(&indent);
        self.out.push_str(line);
        self.out.push('\n');
    }

    fn chart(&mut self, chart: &Chart, depth: usize) {
        for step in &chart.steps {
            if let Some(nth) = self.steps.get(&step.name).copied() {
                let label = step_label(chart, step);
                let borders = if step.initial { 2 } else { 1 };
                let line = format!("s{nth} [shape=box, peripheries={borders}, label={label}];");
                self.line(depth, &line);
            }
        }
        for transition in &chart.transitions {
            let nth = self.drawn;
            self.drawn += 1;
            let receptivity = text(&expression(&transition.receptivity));
            let bar = "shape=box, style=filled, fillcolor=black, height=0.05, width=0.4";
            let line = format!("t{nth} [{bar}, label=\"\", xlabel={receptivity}];");
            self.line(depth, &line);
            for (several, id) in [(&transition.from, 'j'), (&transition.to, 'd')] {
                if several.len() > 1 {
                    let bar = "shape=box, peripheries=2, height=0.03, width=1.5";
                    self.line(depth, &format!("{id}{nth} [{bar}, label=\"\"];"));
                }
            }
        }
    }

    fn arcs(&mut self, transition: &Transition) {
        let nth = self.transitions;
        self.transitions += 1;
        let mut arcs = Vec::new();
        for (steps, bar, into) in [(&transition.from, 'j', true), (&transition.to, 'd', false)] {
            // Several steps meet at a double line, a single one at the bar.
            let several = steps.len() > 1;
            let meet = match several {
                true => format!("{bar}{nth}"),
                false => format!("t{nth}"),
            };
            match (several, into) {
                (true, true) => arcs.push(format!("{meet} -> t{nth};")),
                (true, false) => arcs.push(format!("t{nth} -> {meet};")),
                (false, _) => {}
            }
            arcs.extend(self.known(steps).into_iter().map(|step| match into {
                true => format!("s{step} -> {meet};"),
                false => format!("{meet} -> s{step};"),
            }));
        }
        for arc in arcs {
            self.line(1, &arc);
        }
    }

    fn known(&self, steps: &[Name]) -> Vec<usize> {
        let places = steps.iter().filter_map(|step| self.steps.get(step));
        places.copied().collect()
    }
}

/// A step's name, what it stands for, and what it does.
fn step_label(chart: &Chart, step: &Step) -> String {
    let mut label = step.name.to_string();
    match &step.kind {
        StepKind::Plain => {}
        StepKind::Macro(expansion) => {
            let _ = write!(label, "\nmacro {expansion}");
        }
        StepKind::Enclosing(parts) => {
            let parts: Vec<&str> = parts.iter().map(|part| &**part).collect();
            let _ = write!(label, "\nencloses {}", parts.join(", "));
        }
    }
    for action in chart.actions_of(&step.name) {
        let _ = write!(label, "\n{}", grafcet::action_text(action));
    }
    text(&label)
}

/// A string of the dot language.
fn text(plain: &str) -> String {
    let mut quoted = String::with_capacity(plain.len() + 2);
    quoted.push('"');
    for c in plain.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\r' => {}
            other => quoted.push(other),
        }
    }
    quoted.push('"');
    quoted
}
