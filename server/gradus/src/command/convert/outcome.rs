//! What came of a conversion, as data: per state what is accepted and what is
//! open.

use std::collections::{BTreeMap, BTreeSet};

use grafcet::Verdict;
use logic::Name;
use recovery::groups;
use recovery::successions::{Evidence, Succession};

use super::conversion::Conversion;
use crate::program;

/// What came of a conversion.
pub struct Outcome<'a> {
    /// States about which there is something to say, in the order of the
    /// ladder.
    pub states: Vec<OfState<'a>>,
    /// States that no accepted succession ties to a sequence.
    pub two_step: Vec<Name>,
    /// States of which something is accepted, but nothing accepted leads to
    /// them from where their sequence starts.
    pub unreached: Vec<Name>,
    /// States that are said as their rungs have them, without steps: two steps
    /// would not do what the rungs do.
    pub as_rungs: Vec<Name>,
    /// States of blocks that the file defines: they belong to the instances.
    pub in_definitions: Vec<Name>,
    /// Variables that the spec does not say exactly.
    pub inexact: Vec<Inexact>,
    /// Steps of the spec.
    pub steps: usize,
    /// Transitions of the spec.
    pub transitions: usize,
    /// Actions of the spec.
    pub actions: usize,
    /// Whether the ladder holds a sequence, and why.
    pub verdict: (bool, String),
}

/// A variable that the spec does not say exactly.
pub struct Inexact {
    /// The variable.
    pub name: Name,
    /// The rungs that write it, as people call them.
    pub rungs: Vec<String>,
    /// Why, to go on after its name.
    pub reason: String,
}

/// What is decided about the followers of a state.
pub struct OfState<'a> {
    /// The state.
    pub name: Name,
    /// What the source says about it.
    pub description: Option<Name>,
    /// Whether a sequence starts in it.
    pub initial: bool,
    /// Accepted followers, those together that start together.
    pub accepted: Vec<Accepted>,
    /// Followers that the writes of a register give.
    pub written: Vec<Name>,
    /// Suggested and not decided, best first.
    pub open: Vec<&'a Succession>,
    /// Rejected followers.
    pub rejected: Vec<Name>,
}

/// Accepted followers of a state.
pub struct Accepted {
    /// They start together.
    pub to: Vec<Name>,
    /// Whether they were accepted just now.
    pub new: bool,
}

impl<'a> Outcome<'a> {
    /// What came of `conversion`, whose spec now holds `text`.
    pub fn of(conversion: &Conversion<'a>, text: &str) -> Self {
        let grafcet = grafcet::read(text).spec.grafcet;
        let tied = tied(conversion);
        let drawn: BTreeSet<&Name> = grafcet.steps().filter_map(|it| it.state.as_ref()).collect();
        let those = |is_tied: bool, is_drawn: bool| -> Vec<Name> {
            let states = conversion.analysis.states().states.iter();
            states
                .map(|state| &state.name)
                .filter(|name| tied.contains(name) == is_tied && drawn.contains(name) == is_drawn)
                .cloned()
                .collect()
        };
        let acted: BTreeSet<&Name> = grafcet.actions().map(|it| &it.output).collect();
        let without_steps = those(false, false).into_iter();
        let (as_rungs, in_definitions) = without_steps.partition(|name| acted.contains(name));
        Self {
            states: states(conversion),
            two_step: those(false, true),
            unreached: those(true, false),
            as_rungs,
            in_definitions,
            inexact: inexact(conversion),
            steps: grafcet.steps().count(),
            transitions: grafcet.transitions().count(),
            actions: grafcet.actions().count(),
            verdict: groups::verdict(conversion.analysis.groups()),
        }
    }
}

fn inexact(conversion: &Conversion<'_>) -> Vec<Inexact> {
    let analysis = conversion.analysis;
    let rungs_of = |name: &Name| {
        let variable = analysis.conditions.find(name).into_iter();
        let places = variable.flat_map(|it| it.writes.iter().map(|write| write.place));
        let mut rungs: Vec<String> = places
            .filter_map(|place| {
                let routine = analysis.program.routines.get(place.routine)?;
                Some(routine.name_of(routine.rungs.get(place.rung)?))
            })
            .collect();
        rungs.dedup();
        rungs
    };
    let unsaid = conversion.unsaid().into_iter();
    unsaid
        .map(|(name, why)| Inexact {
            rungs: rungs_of(&name),
            reason: why.words(),
            name,
        })
        .collect()
}

fn states<'a>(conversion: &Conversion<'a>) -> Vec<OfState<'a>> {
    let analysis = conversion.analysis;
    let mut states: BTreeMap<&Name, OfState<'a>> = BTreeMap::new();
    let empty = |name: &Name| OfState {
        name: name.clone(),
        description: program::description(analysis, name),
        initial: false,
        accepted: Vec::new(),
        written: Vec::new(),
        open: Vec::new(),
        rejected: Vec::new(),
    };
    for succession in analysis.successions() {
        if succession.evidence == Evidence::Written {
            let from = &succession.from;
            let state = states.entry(from).or_insert_with(|| empty(from));
            state.written.push(succession.to.clone());
        }
    }
    for decision in &conversion.decisions {
        match &decision.verdict {
            Verdict::Accept { from, to } => {
                let new = !conversion
                    .made
                    .iter()
                    .any(|it| it.verdict == decision.verdict);
                let state = states.entry(from).or_insert_with(|| empty(from));
                state.accepted.push(Accepted {
                    to: to.clone(),
                    new,
                });
            }
            Verdict::Reject { from, to } => {
                let state = states.entry(from).or_insert_with(|| empty(from));
                state.written.retain(|written| written != to);
                state.rejected.push(to.clone());
            }
            Verdict::Initial(name) => {
                states.entry(name).or_insert_with(|| empty(name)).initial = true;
            }
            Verdict::Keep(_) | Verdict::End(_) => {}
        }
    }
    for succession in conversion.open() {
        let from = &succession.from;
        let state = states.entry(from).or_insert_with(|| empty(from));
        state.open.push(succession);
    }
    let mut states: Vec<_> = states.into_values().collect();
    let place = places(conversion);
    states.sort_by_key(|state| place.get(&state.name).copied().unwrap_or(usize::MAX));
    states
}

/// The order of the states: bits as the ladder has them, then registers.
fn places(conversion: &Conversion<'_>) -> BTreeMap<Name, usize> {
    let analysis = conversion.analysis;
    let bits = analysis.states().states.iter().map(|it| it.name.clone());
    let values = analysis.registers.iter().flat_map(|register| {
        let states = register.states.iter();
        states.map(|state| register.state_name(state.value))
    });
    bits.chain(values).zip(0..).collect()
}

/// The states that accepted successions speak of.
fn tied<'c>(conversion: &'c Conversion<'_>) -> BTreeSet<&'c Name> {
    let decisions = conversion.decisions.iter();
    decisions
        .flat_map(|decision| match &decision.verdict {
            Verdict::Accept { from, to } => std::iter::once(from).chain(to).collect(),
            _ => Vec::new(),
        })
        .collect()
}
