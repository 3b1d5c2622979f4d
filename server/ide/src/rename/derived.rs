//! Names of steps and transitions that are made of a state's name.
//!
//! A conversion calls the step of `v1` `Xv1`, and knows it again by that name.
//! When `v1` becomes `fill`, a conversion would call it `Xfill`; so it is renamed
//! along, wherever a person has not given it a name of their own.

use std::collections::HashMap;

use grafcet::Grafcet;
use logic::{Budget, Name};
use recovery::conversion;

use crate::{Ladder, Spec};

/// What is needed to know how a conversion calls things before and after.
pub(super) struct Derived<'a> {
    /// The ladder so far.
    pub(super) old: &'a Ladder,
    /// Its text after the renaming.
    pub(super) text: &'a str,
    /// What the analysis may cost.
    pub(super) budget: &'a Budget,
}

/// The new names of steps and transitions, by the old ones.
#[derive(Default)]
pub(super) struct NewNames {
    pub(super) steps: HashMap<Name, Name>,
    pub(super) transitions: HashMap<Name, Name>,
}

impl Derived<'_> {
    /// How a conversion calls things now that it called otherwise: `before` is
    /// the spec so far, `after` the same with the variable renamed.
    pub(super) fn names(&self, before: &Spec, after: &Spec) -> NewNames {
        let new = Ladder::read(self.text.into(), self.budget);
        let chart = |ladder: &Ladder, spec: &Spec| -> Grafcet {
            let decisions = &spec.reading.spec.decisions;
            conversion::spec(&ladder.analysis, decisions, self.budget).grafcet
        };
        let (old, new) = (chart(self.old, before), chart(&new, after));
        let steps = |it: &Grafcet| it.steps().map(|it| it.name.clone()).collect();
        let transitions = |it: &Grafcet| it.transitions().map(|it| it.name.clone()).collect();
        NewNames {
            steps: changed(steps(&old), steps(&new)),
            transitions: changed(transitions(&old), transitions(&new)),
        }
    }
}

/// The names that differ, in lists that stand for the same things in the same
/// order. What is not the same in number is not.
fn changed(old: Vec<Name>, new: Vec<Name>) -> HashMap<Name, Name> {
    if old.len() != new.len() {
        return HashMap::new();
    }
    let pairs = old.into_iter().zip(new);
    pairs.filter(|(old, new)| old != new).collect()
}
