//! Suggestions that were seen to happen.
//!
//! Conditions say what may follow what; they do not say whether the program ever
//! gets there. Somebody who searches the sequences of inputs, under what is known
//! of the plant, tells here what was seen, and the suggestions are ranked anew.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use grafcet::EnvironmentRule;
use logic::{Budget, Function, Name};
use scenario::{Passing, Scenario, Step};

use super::{Evidence, Kind, Succession};
use crate::states::{State, States};

/// A shortest sequence of inputs, from the first scan, at whose end a state
/// begins after another has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// The sequence: a step for each scan, nothing is expected in it.
    pub scenario: Scenario,
    /// For each scan the states that are on when it has ended, of those that
    /// depend on the two.
    pub on: Vec<Vec<Name>>,
    /// The scan, by its place, in which the one state ends; the other begins in
    /// the last.
    pub ended: usize,
    /// Whether from scan to scan no more than one input changes. Inputs of a
    /// plant are slow against scans: what needs two at once is a coincidence.
    pub is_calm: bool,
}

impl Witness {
    /// How many scans it takes.
    pub fn scans(&self) -> usize {
        self.on.len()
    }

    /// What is done before each scan, as a scenario says it: `on s; off s, on
    /// ls1`.
    pub fn in_words(&self) -> String {
        let steps = self.scenario.steps.iter().map(|step| match step.passing {
            // Where time matters elsewhere, every other step says that none passes.
            Passing::Wait(0) => scenario::done(&Step {
                passing: Passing::Scans(1),
                ..step.clone()
            }),
            _ => scenario::done(step),
        });
        steps.collect::<Vec<String>>().join("; ")
    }
}

/// What was seen of two states.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sight {
    /// The one ends in the scan in which the other begins.
    pub at_once: Option<Arc<Witness>>,
    /// The one ends a scan before or after the other begins. It is looked for
    /// where what hands over is not seen to do so at once.
    pub in_turn: Option<Arc<Witness>>,
    /// The other begins after the one has ended, with no state of the group on
    /// in between.
    pub delayed: Option<Arc<Witness>>,
}

impl Sight {
    /// The witness to be shown for evidence of this kind.
    fn shown(&self, evidence: Evidence) -> Option<&Arc<Witness>> {
        match evidence {
            Evidence::Delayed => self.delayed.as_ref(),
            _ => self.at_once.as_ref().or(self.in_turn.as_ref()),
        }
    }

    /// How little is to be thought of it: at once before after a wait, single
    /// changes of inputs before coincidences, a short sequence before a long one.
    fn weight(&self) -> (u8, usize) {
        let ranked = |witness: &Option<Arc<Witness>>, calm: u8| {
            let witness = witness.as_ref()?;
            let rank = if witness.is_calm { calm } else { calm + 2 };
            Some((rank, witness.scans()))
        };
        let all = [
            ranked(&self.at_once, 0),
            ranked(&self.in_turn, 0),
            ranked(&self.delayed, 1),
        ];
        all.into_iter().flatten().min().unwrap_or(NO_WEIGHT)
    }
}

/// Less than anything that was seen.
const NO_WEIGHT: (u8, usize) = (u8::MAX, usize::MAX);

/// What was seen of a program.
#[derive(Clone, Debug, Default)]
pub struct Sights {
    /// Pairs of states of which something was seen: the one that ends, the one
    /// that begins.
    pub pairs: BTreeMap<(Name, Name), Sight>,
    /// States of which two others were seen to begin in the scan in which they
    /// end, the two in the order of their names.
    pub together: BTreeSet<(Name, Name, Name)>,
    /// Handovers that never happen, neither at once nor in turn.
    pub never: BTreeSet<(Name, Name)>,
    /// The rules that the plant obeyed.
    pub environment: Vec<EnvironmentRule>,
    /// Whether all that was looked for was found, or shown never to happen.
    pub is_whole: bool,
}

impl Sights {
    fn begin_together(&self, from: &Name, one: &Name, other: &Name) -> bool {
        let (first, second) = if one < other {
            (one, other)
        } else {
            (other, one)
        };
        let key = (from.clone(), first.clone(), second.clone());
        self.together.contains(&key)
    }
}

/// `ranked` with what was seen: witnesses for suggestions that are there, and
/// suggestions of pairs that are not. Best first: what is written, handovers,
/// what was seen otherwise, what is possible; among these by
/// [weight](Sight::weight). A handover that never happens is merely possible.
pub(crate) fn with_sights(
    ranked: &[Succession],
    sights: &Sights,
    states: &States,
    budget: &Budget,
) -> Vec<Succession> {
    let mut all: Vec<Succession> = ranked.to_vec();
    let pair = |it: &Succession| (it.from.clone(), it.to.clone());
    let known: BTreeSet<(Name, Name)> = ranked.iter().map(pair).collect();
    for succession in &mut all {
        let pair = pair(succession);
        if sights.never.contains(&pair) {
            succession.evidence = Evidence::Possible;
        }
        if let Some(sight) = sights.pairs.get(&pair) {
            if succession.evidence == Evidence::Possible {
                succession.evidence = evidence(sight);
            }
            succession.witness = sight.shown(succession.evidence).cloned();
        }
    }
    let new = sights
        .pairs
        .iter()
        .filter(|(pair, _)| !known.contains(pair));
    for ((from, to), sight) in new {
        if let (Some(ends), Some(begins)) = (states.find(from), states.find(to)) {
            let evidence = evidence(sight);
            all.push(Succession {
                from: from.clone(),
                to: to.clone(),
                evidence,
                kind: Kind::Or,
                condition: condition(ends, begins, evidence, budget),
                witness: sight.shown(evidence).cloned(),
            });
        }
    }
    let place = |name: &Name| states.find(name).map(|state| state.atom);
    all.sort_by_cached_key(|it| {
        let class = match it.evidence {
            Evidence::Delayed => Evidence::Witnessed,
            evidence => evidence,
        };
        match it.evidence {
            // Exact; they stay in the order of their values.
            Evidence::Written => (class, NO_WEIGHT, None, None),
            _ => {
                let sight = sights.pairs.get(&pair(it));
                let weight = sight.map_or(NO_WEIGHT, Sight::weight);
                (class, weight, place(&it.from), place(&it.to))
            }
        }
    });
    decide_kinds(&mut all, sights, states);
    all
}

fn evidence(sight: &Sight) -> Evidence {
    // What is merely in turn is told of handovers only.
    match (&sight.at_once, &sight.delayed) {
        (Some(_), _) => Evidence::Witnessed,
        (None, Some(_)) => Evidence::Delayed,
        (None, None) => Evidence::Possible,
    }
}

/// When the one ends and the other begins; of a wait, when the other begins.
fn condition(
    ends: &State,
    begins: &State,
    evidence: Evidence,
    budget: &Budget,
) -> Option<Function> {
    if !ends.is_comparable() || !begins.is_comparable() {
        return None;
    }
    let condition = match evidence {
        Evidence::Delayed => begins.turns_on.restrict(ends.atom, false),
        _ => {
            let [ended, begun] = [
                ends.deactivation.restrict(begins.atom, false),
                begins.turns_on.restrict(ends.atom, true),
            ];
            ended.and(&begun, budget).ok()?
        }
    };
    // In one scan either may be solved first: what the two say of each other
    // need not hold together.
    (!condition.is_false()).then_some(condition)
}

/// AND where several followers begin in one scan and none excludes another; OR
/// of all others that were seen. Followers are gathered best first, of those that
/// take no coincidence. A handover that was not seen so keeps the kind that its
/// condition gives.
fn decide_kinds(all: &mut [Succession], sights: &Sights, states: &States) {
    let mut followers: BTreeMap<Name, Vec<usize>> = BTreeMap::new();
    for (at, succession) in all.iter_mut().enumerate() {
        match (&succession.witness, succession.evidence) {
            (_, Evidence::Written) => {}
            (Some(witness), Evidence::Handover | Evidence::Witnessed) if witness.is_calm => {
                let list = followers.entry(succession.from.clone()).or_default();
                list.push(at);
            }
            (_, Evidence::Handover) => {}
            _ => succession.kind = Kind::Or,
        }
    }
    for (from, followers) in followers {
        let mut company: Vec<usize> = Vec::new();
        for &at in &followers {
            let to = &all[at].to;
            let joins = company.iter().all(|&member| {
                let other = &all[member].to;
                sights.begin_together(&from, to, other) && !exclude(to, other, states)
            });
            if joins {
                company.push(at);
            }
        }
        let is_company = company.len() > 1;
        for at in followers {
            all[at].kind = match is_company && company.contains(&at) {
                true => Kind::And,
                false => Kind::Or,
            };
        }
    }
}

/// Whether one of two states locks the other out.
fn exclude(one: &Name, other: &Name, states: &States) -> bool {
    let (Some(one), Some(other)) = (states.find(one), states.find(other)) else {
        return false;
    };
    one.interlocks.contains(&other.atom) || other.interlocks.contains(&one.atom)
}
