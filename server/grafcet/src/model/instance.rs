use std::borrow::Cow;
use std::collections::HashMap;

use logic::notation::{Lexer, TokenKind, quoted};
use logic::{Atom, Expr, Name};

use super::{
    Action, ActionKind, Chart, Effect, Grafcet, Part, PartKind, Situation, Step, StepKind,
    Transition, Trigger,
};

impl Grafcet {
    /// The grafcet with every instance written out as a partial grafcet, and
    /// no reusable grafcets left: what really runs.
    ///
    /// Step `E1` and transition `t1` of instance `d1` become `d1.E1` and
    /// `d1.t1`; parameters become the instance's arguments. An instance of a
    /// grafcet that is not there gives nothing.
    #[must_use]
    pub fn instantiated(&self) -> Cow<'_, Self> {
        let is_template = |part: &Part| matches!(part.kind, PartKind::Reusable { .. });
        if self.instances.is_empty() && !self.parts.iter().any(is_template) {
            return Cow::Borrowed(self);
        }
        let copies = self.instances.iter().filter_map(|instance| {
            let template = self.part(&instance.of)?;
            let PartKind::Reusable { parameters } = &template.kind else {
                return None;
            };
            let own = |name: &Name| -> Name { format!("{}.{name}", instance.name).into() };
            let mut names: HashMap<Name, Name> = parameters
                .iter()
                .cloned()
                .zip(instance.arguments.iter().cloned())
                .collect();
            for step in &template.chart.steps {
                names.insert(step.name.clone(), own(&step.name));
            }
            let mut chart = renamed(&template.chart, &names);
            for transition in &mut chart.transitions {
                transition.name = own(&transition.name);
            }
            Some(Part {
                name: instance.name.clone(),
                kind: PartKind::Partial,
                chart,
            })
        });
        let mut parts: Vec<Part> = copies.collect();
        let kept = self.parts.iter().filter(|part| !is_template(part)).cloned();
        parts.splice(0..0, kept);
        Cow::Owned(Self {
            parts,
            instances: Vec::new(),
            ..self.clone()
        })
    }
}

pub(crate) type Names = HashMap<Name, Name>;

fn other(name: &Name, names: &Names) -> Name {
    names.get(name).unwrap_or(name).clone()
}

fn others(list: &[Name], names: &Names) -> Vec<Name> {
    list.iter().map(|name| other(name, names)).collect()
}

fn renamed(chart: &Chart, names: &Names) -> Chart {
    Chart {
        steps: chart
            .steps
            .iter()
            .map(|step| renamed_step(step, names))
            .collect(),
        transitions: chart
            .transitions
            .iter()
            .map(|transition| Transition {
                from: others(&transition.from, names),
                to: others(&transition.to, names),
                receptivity: renamed_expr(&transition.receptivity, names),
                ..transition.clone()
            })
            .collect(),
        actions: chart
            .actions
            .iter()
            .map(|action| renamed_action(action, names))
            .collect(),
    }
}

fn renamed_step(step: &Step, names: &Names) -> Step {
    Step {
        name: other(&step.name, names),
        kind: match &step.kind {
            StepKind::Plain => StepKind::Plain,
            StepKind::Macro(expansion) => StepKind::Macro(other(expansion, names)),
            StepKind::Enclosing(parts) => StepKind::Enclosing(others(parts, names)),
        },
        ..step.clone()
    }
}

fn renamed_action(action: &Action, names: &Names) -> Action {
    let kind = match &action.kind {
        ActionKind::Stored { effect, on } => ActionKind::Stored {
            effect: match effect {
                Effect::Assign(term) => Effect::Assign(renamed_term(term, names)),
                plain => plain.clone(),
            },
            on: match on {
                Trigger::Event(event) => Trigger::Event(renamed_expr(event, names)),
                plain => plain.clone(),
            },
        },
        ActionKind::Forcing(Situation::Steps(steps)) => {
            ActionKind::Forcing(Situation::Steps(others(steps, names)))
        }
        plain => plain.clone(),
    };
    Action {
        step: other(&action.step, names),
        kind,
        output: other(&action.output, names),
        condition: action
            .condition
            .as_ref()
            .map(|condition| renamed_expr(condition, names)),
        comment: action.comment.clone(),
    }
}

/// A term such as `C + 1` with its names replaced.
fn renamed_term(term: &str, names: &Names) -> Name {
    let mut lexer = Lexer::new(term);
    let mut text = String::with_capacity(term.len());
    let mut written = 0;
    while let Some(token) = lexer.take() {
        let new = match token.kind {
            TokenKind::Name | TokenKind::Quoted => names.get(token.name(term)),
            _ => None,
        };
        if let Some(new) = new {
            let range = token.span.range();
            text.push_str(term.get(written..range.start).unwrap_or_default());
            text.push_str(&quoted(new));
            written = range.end;
        }
    }
    text.push_str(term.get(written..).unwrap_or_default());
    text.into()
}

/// `expr` with its names replaced. Expressions nest no deeper than the reader
/// lets them.
pub(crate) fn renamed_expr(expr: &Expr, names: &Names) -> Expr {
    match expr {
        Expr::Constant(value) => Expr::Constant(*value),
        Expr::Not(inner) => renamed_expr(inner, names).complement(),
        Expr::And(parts) => Expr::And(parts.iter().map(|part| renamed_expr(part, names)).collect()),
        Expr::Or(parts) => Expr::Or(parts.iter().map(|part| renamed_expr(part, names)).collect()),
        Expr::Atom(atom) => match atom {
            Atom::Variable(name) => Expr::Atom(Atom::Variable(other(name, names))),
            Atom::Comparison(c) => {
                Expr::comparison(&other(&c.left, names), c.relation, &other(&c.right, names))
            }
            Atom::Rise(inner) => Expr::Atom(Atom::Rise(Box::new(renamed_expr(inner, names)))),
            Atom::Fall(inner) => Expr::Atom(Atom::Fall(Box::new(renamed_expr(inner, names)))),
            Atom::Elapsed { time, step } => Expr::Atom(Atom::Elapsed {
                time: time.clone(),
                step: other(step, names),
            }),
        },
    }
}
