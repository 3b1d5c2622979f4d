//! Which state can be seen to begin after which (semantics, section 3).
//!
//! What `recovery` suggests rests on conditions. Here the program itself is
//! asked, as a transition system: is there a sequence of inputs, under the rules
//! of the environment, at whose end one state ends and another begins? Each pair
//! of states is a signal to be looked for; [`proof::seek`] gives a shortest
//! sequence for each, and the interpreter runs it before it is told.
//!
//! Each is looked for twice: first in a calm plant, in which from scan to scan no
//! more than one input changes, then with all inputs free. Scans are fast and
//! plants are slow; a succession that happens only where two buttons are pressed
//! within the same scan is seldom what the program was written for.
//!
//! A *wait* is taken narrowly: from the end of the one state to the beginning of
//! the other no state of their group is on, so that none can explain it.

mod pairs;
mod seen;
mod watch;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use grafcet::{EnvironmentRule, Spec};
use ladder::scan::Machine;
use logic::Name;
use proof::{Limits, Sought};
use recovery::Analysis;
use recovery::successions::{Evidence, Sights, Witness};

use crate::Timing;
use crate::program::{self, Bounds};
use crate::ready::Ready;
use crate::refusal::Refusal;
use crate::system::system;
use pairs::Pairs;
use seen::Confirming;
use watch::{Ask, Watch};

/// What a search may cost is a share of the whole; so is running what was found.
/// What is suggested for good reasons has three, all else but one.
const SHARES: u64 = 10;

/// Of the followers of a state so many are asked whether they begin together.
const MOST_TOGETHER: usize = 12;

/// Searches for sequences of inputs that show which state of a program begins
/// after which, in plants that obey `environment`. What is not found within the
/// limits is not told; [`Sights::is_whole`] says whether that may be some.
///
/// Rules count as far as they speak of the ladder; a step of a grafcet is free.
pub fn sights(
    analysis: &Analysis,
    environment: &[EnvironmentRule],
    limits: &Limits,
) -> Result<Sights, Refusal> {
    let pairs = Pairs::of(analysis);
    let mut seeing = Seeing {
        sights: Sights {
            environment: environment.to_vec(),
            is_whole: pairs.are_all,
            ..Sights::default()
        },
        share: Limits {
            steps: limits.steps / SHARES,
            ..limits.clone()
        },
    };
    if pairs.list.is_empty() {
        return Ok(seeing.sights);
    }
    let bounds = Bounds {
        gates: limits.gates,
        work: usize::try_from(limits.steps / 50).unwrap_or(usize::MAX),
        cancel: limits.cancel.clone(),
    };
    let spec = Spec {
        environment: environment.to_vec(),
        ..Spec::default()
    };
    let program = &analysis.program;
    let ready = Ready::new(&spec, &bounds)?;
    let followed = program::follow_beside(program, Some(&ready), &bounds)?;
    let system = system(&followed, &ready, Timing::Scan, [1, 1], &bounds)?;
    let mut watch = Watch::new(&Machine::new(program), &followed, system, &pairs);
    let mut confirming = Confirming {
        program,
        followed: &followed,
        pairs: &pairs,
        rungs: program.rungs().count() as u64,
        left: seeing.share.steps,
        cancel: &limits.cancel,
    };
    // What is never seen in a calm plant may be seen in another.
    let mut search = |asked: Vec<Ask>, shares: u64, seeing: &mut Seeing| {
        let calm = seeing.search(asked, shares, true, &mut watch, &mut confirming);
        let open = calm.into_iter().map(|(ask, _)| ask).collect();
        seeing.search(open, 1, false, &mut watch, &mut confirming)
    };
    let [strong, weak] = each(&pairs);
    let mut open = search(strong, 3, &mut seeing);
    open.extend(search(weak, 1, &mut seeing));
    seeing.sights.is_whole &= open.iter().all(|(_, is_never)| *is_never);
    let is_never_at_once: BTreeSet<(Name, Name)> = never(&open).collect();
    let open = search(handovers_not_seen(analysis, &open), 1, &mut seeing);
    let never = never(&open).filter(|pair| is_never_at_once.contains(pair));
    seeing.sights.never = never.collect();
    let together = companies(&seeing.sights);
    seeing.search(together, 1, true, &mut watch, &mut confirming);
    Ok(seeing.sights)
}

/// What was not found, and whether it is known never to happen.
type Open = (Ask, bool);

/// Each pair by itself: first what is written or hands over, at once; then all
/// else, and what follows after a wait.
fn each(pairs: &Pairs) -> [Vec<Ask>; 2] {
    let (mut strong, mut weak) = (Vec::new(), Vec::new());
    for (at, (from, to)) in pairs.list.iter().enumerate() {
        let asked = match at < pairs.strong {
            true => &mut strong,
            false => &mut weak,
        };
        let (from, to) = (from.clone(), to.clone());
        asked.push(Ask::AtOnce { from, to });
    }
    for (from, to) in &pairs.list {
        if pairs.are_of_one_group(from, to) {
            let (from, to) = (from.clone(), to.clone());
            weak.push(Ask::Delayed { from, to });
        }
    }
    [strong, weak]
}

/// Handovers that were not seen at once: they may happen within two scans, where
/// the rungs stand in such an order or a coil of its own carries the transition.
fn handovers_not_seen(analysis: &Analysis, open: &[Open]) -> Vec<Ask> {
    let handovers = analysis.successions().iter();
    let handovers = handovers.filter(|it| it.evidence == Evidence::Handover);
    let handovers: BTreeSet<(&Name, &Name)> = handovers.map(|it| (&it.from, &it.to)).collect();
    let late = open.iter().filter_map(|(ask, _)| match ask {
        Ask::AtOnce { from, to } if handovers.contains(&(from, to)) => {
            let (from, to) = (from.clone(), to.clone());
            Some(Ask::InTurn { from, to })
        }
        _ => None,
    });
    late.collect()
}

/// The pairs that are known never to follow each other so.
fn never(open: &[Open]) -> impl Iterator<Item = (Name, Name)> {
    open.iter().filter_map(|(ask, is_never)| match ask {
        Ask::AtOnce { from, to } | Ask::InTurn { from, to } if *is_never => {
            Some((from.clone(), to.clone()))
        }
        _ => None,
    })
}

/// Followers of one state two by two, of those that were seen in a calm plant.
fn companies(sights: &Sights) -> Vec<Ask> {
    let mut followers: BTreeMap<&Name, Vec<(usize, &Name)>> = BTreeMap::new();
    for ((from, to), sight) in &sights.pairs {
        if let Some(witness) = sight.at_once.as_ref().filter(|it| it.is_calm) {
            let list = followers.entry(from).or_default();
            list.push((witness.scans(), to));
        }
    }
    let mut asked = Vec::new();
    for (from, mut list) in followers {
        list.sort();
        list.truncate(MOST_TOGETHER);
        for (at, (_, one)) in list.iter().enumerate() {
            for (_, other) in &list[at + 1..] {
                let from = from.clone();
                let mut to = [(*one).clone(), (*other).clone()];
                to.sort();
                asked.push(Ask::Together { from, to });
            }
        }
    }
    asked
}

/// A search under way.
struct Seeing {
    sights: Sights,
    /// What one search may cost.
    share: Limits,
}

impl Seeing {
    /// Looks for what is asked, and takes down what is seen. The rest is given
    /// back.
    fn search(
        &mut self,
        asked: Vec<Ask>,
        shares: u64,
        is_calm: bool,
        watch: &mut Watch<'_>,
        confirming: &mut Confirming<'_>,
    ) -> Vec<Open> {
        if asked.is_empty() {
            return Vec::new();
        }
        let limits = Limits {
            steps: shares * self.share.steps,
            ..self.share.clone()
        };
        let found = watch.search(&asked, is_calm, &limits);
        let mut open = Vec::new();
        for (ask, sought) in asked.into_iter().zip(found) {
            let witness = match &sought {
                Sought::Found(trace) => confirming.witness(&ask, trace, watch),
                _ => None,
            };
            match witness {
                Some(witness) => self.take_down(ask, witness),
                None => open.push((ask, sought == Sought::Never)),
            }
        }
        open
    }

    fn take_down(&mut self, ask: Ask, witness: Arc<Witness>) {
        match ask {
            Ask::AtOnce { from, to } => {
                self.sights.pairs.entry((from, to)).or_default().at_once = Some(witness);
            }
            Ask::InTurn { from, to } => {
                self.sights.pairs.entry((from, to)).or_default().in_turn = Some(witness);
            }
            Ask::Delayed { from, to } => {
                self.sights.pairs.entry((from, to)).or_default().delayed = Some(witness);
            }
            Ask::Together { from, to: [a, b] } => {
                self.sights.together.insert((from, a, b));
            }
        }
    }
}
