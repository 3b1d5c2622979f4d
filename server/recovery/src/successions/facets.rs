//! What comparing a state with others needs, worked out once for each state.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use logic::{AtomId, Budget, Function};

use super::common::{Bounds, Ending};
use super::shared::literals;
use crate::states::State;

/// The next value of a state in one of its two forms: as its rungs have it,
/// or with auxiliary coils resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Plain,
    Resolved,
}

impl Form {
    pub(super) fn next(self, state: &State) -> &Function {
        match self {
            Self::Plain => &state.plain,
            Self::Resolved => &state.next,
        }
    }
}

/// Both forms of a state.
#[derive(Clone, Debug)]
pub(crate) struct Facets {
    plain: Facet,
    resolved: Facet,
}

/// What one form of a state says.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// What ends the state, and what starts it again.
    pub(super) ending: Ending,
    /// By which literals its end depends on its atoms.
    pub(super) ends_by: Vec<(AtomId, bool)>,
    /// By which literals its start does.
    pub(super) starts_by: Vec<(AtomId, bool)>,
    /// What certain common atoms tell of its end and of its start.
    bounds: OnceLock<(BTreeSet<AtomId>, [Option<Bounds>; 2])>,
}

impl State {
    /// What one form of it says; nothing that could be compared if the state
    /// is not comparable.
    pub(super) fn facet(&self, form: Form) -> &Facet {
        let facets = self.facets.get_or_init(|| {
            let [plain, resolved] = [Form::Plain, Form::Resolved].map(|form| Facet::of(self, form));
            Box::new(Facets { plain, resolved })
        });
        match form {
            Form::Plain => &facets.plain,
            Form::Resolved => &facets.resolved,
        }
    }

    pub(super) fn starts(&self, form: Form) -> &Function {
        &self.facet(form).ending.again
    }
}

impl Facet {
    fn of(state: &State, form: Form) -> Self {
        let ending = match state.is_comparable() {
            true => Ending {
                ends: ending(state, None, form),
                again: form.next(state).restrict(state.atom, false),
            },
            false => Ending::never(),
        };
        Self {
            ends_by: literals(&ending.ends),
            starts_by: literals(&ending.again),
            ending,
            bounds: OnceLock::new(),
        }
    }

    /// What common atoms tell of the end, and of the start.
    pub(super) fn bounds(&self, common: &BTreeSet<AtomId>, budget: &Budget) -> [Option<Bounds>; 2] {
        let work_out = || {
            let ends = self.ending.bounds(common, budget).ok().flatten();
            let starts = &self.ending.again;
            [ends, Bounds::new(starts, starts, common, budget)]
        };
        match self.bounds.get() {
            Some((known, bounds)) if known == common => bounds.clone(),
            _ => {
                let bounds = work_out();
                // What was cut short is not worth keeping; nor is what another
                // thread has been quicker to keep.
                if !budget.cancel.is_cancelled() {
                    let _ = self.bounds.set((common.clone(), bounds.clone()));
                }
                bounds
            }
        }
    }
}

/// What ends `from`, with the normally closed contacts of states that lock it
/// out set aside (the paper, section 3.2), but not those of `to`.
pub(super) fn ending(from: &State, to: Option<AtomId>, form: Form) -> Function {
    let aside = from.interlocks.iter().filter(|other| Some(**other) != to);
    let next = aside.fold(form.next(from).clone(), |next, other| {
        let open = next.restrict(*other, false);
        // A contact whose opening alone ends the state is no interlock but
        // the way the state ends: a relay sequence is written so.
        if open.restrict(from.atom, true).is_true() {
            next
        } else {
            open
        }
    });
    next.restrict(from.atom, true).not()
}
