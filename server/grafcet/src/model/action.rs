use logic::{Atom, Expr, Name};

/// What a step does to an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Action {
    /// The step it belongs to.
    pub step: Name,
    /// How it acts.
    pub kind: ActionKind,
    /// What it acts upon: an output or internal variable; for a forcing order
    /// the partial grafcet that is forced.
    pub output: Name,
    /// It acts only while this holds; always where there is none. On a stored
    /// action, the condition at the moment of its event.
    pub condition: Option<Expr>,
    /// What it is for.
    pub comment: Option<Name>,
}

/// How an action acts (IEC 60848, 4.8).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// The output is true while the step is active, and false where no action
    /// makes it true: assignation on state.
    Continuous {
        /// Acts only once the step has been active for so long: `5s`.
        delay: Option<Name>,
        /// Acts only until the step has been active for so long.
        limit: Option<Name>,
    },
    /// The output takes a value at an event and keeps it: allocation on event.
    Stored {
        /// What becomes of the output.
        effect: Effect,
        /// When.
        on: Trigger,
    },
    /// The situation of a partial grafcet is imposed while the step is active:
    /// a forcing order (IEC 60848, clause 7).
    Forcing(Situation),
}

/// What a stored action does to its output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Effect {
    /// It becomes true.
    Set,
    /// It becomes false.
    Reset,
    /// It takes the value of a term: `0`, `C + 1`.
    Assign(Name),
}

/// The event of a stored action.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// The step becomes active.
    Activation,
    /// The step ceases to be active.
    Deactivation,
    /// The expression becomes true while the step is active; usually an edge.
    Event(Expr),
}

/// The situation that a forcing order imposes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Situation {
    /// These steps are active and no others: `{p2, p3}`; none is `{}`.
    Steps(Vec<Name>),
    /// The one it is in, which freezes it: `{*}`.
    Current,
    /// The initial one: `{INIT}`.
    Initial,
}

impl Action {
    /// The action that makes `output` true while `step` is active.
    pub fn continuous(step: impl Into<Name>, output: impl Into<Name>) -> Self {
        Self {
            step: step.into(),
            kind: ActionKind::Continuous {
                delay: None,
                limit: None,
            },
            output: output.into(),
            condition: None,
            comment: None,
        }
    }

    /// The action that does something to `output` when `step` is activated.
    pub fn stored(step: impl Into<Name>, effect: Effect, output: impl Into<Name>) -> Self {
        Self {
            kind: ActionKind::Stored {
                effect,
                on: Trigger::Activation,
            },
            ..Self::continuous(step, output)
        }
    }

    /// All that must hold, beside the step being active, for a continuous
    /// action to act, its delay and limit included: `5s/p2 * /(9s/p2) * ls2`.
    /// The standard explains both as such conditions. `None` where nothing
    /// else must hold. A stored action's is its condition alone.
    pub fn whole_condition(&self) -> Option<Expr> {
        let elapsed = |time: &Name| {
            Expr::Atom(Atom::Elapsed {
                time: time.clone(),
                step: self.step.clone(),
            })
        };
        let mut parts = Vec::new();
        if let ActionKind::Continuous { delay, limit } = &self.kind {
            parts.extend(delay.as_ref().map(elapsed));
            parts.extend(limit.as_ref().map(|time| elapsed(time).complement()));
        }
        parts.extend(self.condition.clone());
        match parts.len() {
            0 | 1 => parts.pop(),
            _ => Some(Expr::And(parts)),
        }
    }
}
