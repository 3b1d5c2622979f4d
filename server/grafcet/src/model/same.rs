use logic::{Expr, Name};

use super::{
    Action, ActionKind, Decision, EnvironmentRule, Instance, Part, Property, Spec, Step,
    Transition, Trigger, Variable, means_the_same,
};

/// Whether two things say the same, though they may be written differently.
///
/// Expressions may be written in any way that means the same, and order does
/// not matter where it has no meaning. A comment is an offer: where `wanted`
/// has none, any will do, so that a spec computed afresh takes away no remark
/// that a person made; `Some("")` asks for none.
pub(crate) trait SaysTheSame {
    /// Whether `self` already says what `wanted` says.
    fn says(&self, wanted: &Self) -> bool;
}

/// Whether a comment already is what is wanted.
pub(crate) fn comment_serves(comment: Option<&Name>, wanted: Option<&Name>) -> bool {
    let Some(wanted) = wanted else {
        return true;
    };
    let lines = wanted.split(['\r', '\n']).map(str::trim);
    let wanted = lines.collect::<Vec<_>>().join(" ");
    comment.map_or("", |comment| comment) == wanted.trim()
}

fn same_condition(own: &Option<Expr>, wanted: &Option<Expr>) -> bool {
    match (own, wanted) {
        (Some(own), Some(wanted)) => means_the_same(own, wanted),
        (None, None) => true,
        _ => false,
    }
}

fn same_names(own: &[Name], wanted: &[Name]) -> bool {
    let sorted = |names: &[Name]| {
        let mut names = names.to_vec();
        names.sort();
        names
    };
    own == wanted || sorted(own) == sorted(wanted)
}

impl SaysTheSame for Step {
    /// As it is declared: whether it is initial is said elsewhere.
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && self.state == wanted.state
            && self.kind == wanted.kind
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Variable {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && self.address == wanted.address
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Instance {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && self.of == wanted.of
            && self.arguments == wanted.arguments
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Transition {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && same_names(&self.from, &wanted.from)
            && same_names(&self.to, &wanted.to)
            && means_the_same(&self.receptivity, &wanted.receptivity)
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Action {
    fn says(&self, wanted: &Self) -> bool {
        let same_kind = match (&self.kind, &wanted.kind) {
            (
                ActionKind::Stored {
                    effect,
                    on: Trigger::Event(event),
                },
                ActionKind::Stored {
                    effect: wanted_effect,
                    on: Trigger::Event(wanted_event),
                },
            ) => effect == wanted_effect && means_the_same(event, wanted_event),
            (own, wanted) => own == wanted,
        };
        same_kind
            && self.step == wanted.step
            && self.output == wanted.output
            && same_condition(&self.condition, &wanted.condition)
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for EnvironmentRule {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && means_the_same(&self.left, &wanted.left)
            && means_the_same(&self.right, &wanted.right)
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Property {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && means_the_same(&self.condition, &wanted.condition)
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Decision {
    fn says(&self, wanted: &Self) -> bool {
        self.verdict == wanted.verdict
            && comment_serves(self.comment.as_ref(), wanted.comment.as_ref())
    }
}

impl SaysTheSame for Part {
    fn says(&self, wanted: &Self) -> bool {
        self.name == wanted.name
            && self.kind == wanted.kind
            && all_say(&self.chart.transitions, &wanted.chart.transitions)
            && all_say(&self.chart.actions, &wanted.chart.actions)
            && same_steps(&self.chart.steps, &wanted.chart.steps)
    }
}

fn same_steps(own: &[Step], wanted: &[Step]) -> bool {
    let marks = |steps: &[Step]| {
        let mut marks: Vec<_> = steps
            .iter()
            .map(|step| (step.name.clone(), step.initial, step.activation_link))
            .collect();
        marks.sort();
        marks
    };
    all_say(own, wanted) && marks(own) == marks(wanted)
}

/// Whether each of `wanted` is said by one of `own`, and nothing else is.
/// Equal ones are paired first, so that a missing comment takes nobody else's.
fn all_say<T: SaysTheSame + PartialEq>(own: &[T], wanted: &[T]) -> bool {
    let mut left: Vec<&T> = own.iter().collect();
    let open: Vec<&T> = wanted
        .iter()
        .filter(|wanted| {
            let at = left.iter().position(|own| own == wanted);
            at.map(|at| left.remove(at)).is_none()
        })
        .collect();
    let found = open.iter().all(|wanted| {
        let at = left.iter().position(|own| own.says(wanted));
        at.map(|at| left.remove(at)).is_some()
    });
    found && left.is_empty()
}

impl Spec {
    /// Whether this spec says what `wanted` says: the same things in any
    /// order, with expressions that mean the same.
    ///
    /// A comment is an offer: where `wanted` has none, any will do, and where
    /// it has `Some("")`, there must be none.
    pub fn says_the_same(&self, wanted: &Self) -> bool {
        let (own, other) = (&self.grafcet, &wanted.grafcet);
        own.name == other.name
            && all_say(&own.inputs, &other.inputs)
            && all_say(&own.outputs, &other.outputs)
            && all_say(&own.internals, &other.internals)
            && all_say(&own.instances, &other.instances)
            && all_say(&own.parts, &other.parts)
            && all_say(&own.chart.transitions, &other.chart.transitions)
            && all_say(&own.chart.actions, &other.chart.actions)
            && same_steps(&own.chart.steps, &other.chart.steps)
            && all_say(&self.environment, &wanted.environment)
            && all_say(&self.never, &wanted.never)
            && all_say(&self.decisions, &wanted.decisions)
    }
}
