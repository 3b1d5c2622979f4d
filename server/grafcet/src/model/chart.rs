use logic::{Expr, Name};

use super::Action;

/// Steps, the transitions between them, and what the steps do: a grafcet
/// without its interface (IEC 60848, 4.3).
///
/// A chart need not be connected: each connected piece is a connected grafcet
/// of its own, and all evolve together.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chart {
    /// Its steps, in the order they are declared.
    pub steps: Vec<Step>,
    /// Its transitions, in the order of their rules.
    pub transitions: Vec<Transition>,
    /// The actions of its steps, in the order of their rules.
    pub actions: Vec<Action>,
}

impl Chart {
    /// The step called `name`.
    pub fn step(&self, name: &str) -> Option<&Step> {
        self.steps.iter().find(|step| &*step.name == name)
    }

    /// The transition called `name`.
    pub fn transition(&self, name: &str) -> Option<&Transition> {
        let mut all = self.transitions.iter();
        all.find(|transition| &*transition.name == name)
    }

    /// The actions of the step called `name`.
    pub fn actions_of<'c>(&'c self, name: &'c str) -> impl Iterator<Item = &'c Action> {
        self.actions
            .iter()
            .filter(move |action| &*action.step == name)
    }

    /// Whether it holds nothing.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty() && self.transitions.is_empty() && self.actions.is_empty()
    }
}

/// A step: a part of the situation, active or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its name, which is also the name of its variable.
    pub name: Name,
    /// Whether it is active in the initial situation (IEC 60848, 4.5.2, rule 1).
    pub initial: bool,
    /// Whether the activation of the enclosing step activates it: the mark `*`
    /// of a step in an enclosure (IEC 60848, clause 7).
    pub activation_link: bool,
    /// The state of the ladder it stands for, as the ladder spells it: a coil
    /// `v1`, a bit `X.3`, a register's value `Seq=10`. An auxiliary step
    /// stands for none.
    pub state: Option<Name>,
    /// What it is.
    pub kind: StepKind,
    /// What it is for.
    pub comment: Option<Name>,
}

/// What a step is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// A step.
    Plain,
    /// A macro-step: stands for the expansion of this name. While it is active
    /// its expansion runs, and the transitions after it are enabled once the
    /// expansion's exit step is active (IEC 60848, clause 7).
    Macro(Name),
    /// An enclosing step: the partial grafcets of these names can be active
    /// only while it is (IEC 60848, clause 7).
    Enclosing(Vec<Name>),
}

impl Step {
    /// A plain step that is not initial and stands for no state.
    pub fn new(name: impl Into<Name>) -> Self {
        Self {
            name: name.into(),
            initial: false,
            activation_link: false,
            state: None,
            kind: StepKind::Plain,
            comment: None,
        }
    }
}

/// A transition: how the situation may change.
///
/// It is enabled while all the steps before it are active, and cleared, at
/// once and without fail, when it is enabled and its receptivity is true
/// (IEC 60848, 4.5.3, rule 2).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transition {
    /// Its name, the label of its rule.
    pub name: Name,
    /// The steps before it, by name. None makes it a source transition, which
    /// is always enabled.
    pub from: Vec<Name>,
    /// The steps after it, by name. None makes it a sink transition.
    pub to: Vec<Name>,
    /// Its condition.
    pub receptivity: Expr,
    /// What it is for.
    pub comment: Option<Name>,
}

impl Transition {
    /// A transition between single steps.
    pub fn new(
        name: impl Into<Name>,
        from: impl Into<Name>,
        to: impl Into<Name>,
        receptivity: Expr,
    ) -> Self {
        Self {
            name: name.into(),
            from: vec![from.into()],
            to: vec![to.into()],
            receptivity,
            comment: None,
        }
    }
}
