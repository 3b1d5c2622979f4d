//! The question, asked until it is answered.

use std::collections::HashSet;

use grafcet::Spec;
use ladder::{Class, Program};
use logic::Name;
use proof::{
    Limits, Netlist, Proof, Signal, Status, Verdict as Found, Why, check, deadlock, free_aside,
    simplified,
};

use crate::answer::{Difference, Reason, Timing, Verdict, Verification, What};
use crate::program::{self, Bounds, Followed};
use crate::ready::Ready;
use crate::refusal::Refusal;
use crate::run::{End, Run};
use crate::system::{RESTLESS, System, UNSTABLE, system};
use crate::trace::Trace;

/// A scan of a grafcet is followed through this many evolutions, a settling of
/// both sides through this many scans, at most.
const MOST_ROUNDS: usize = 256;

/// Environment rules that allow so many steps are taken not to contradict each
/// other: a rule speaks of two.
const MOST_ALLOWED: usize = 20;

/// So many gates are evaluated to make a trace simpler.
const MOST_WORK: usize = 200_000_000;

/// Finds out whether the grafcet of `spec` does what `program` does, within the
/// environment that the spec describes, and whether its properties hold.
///
/// # Errors
///
/// A [`Refusal`] where the program has something that is not translated, or where
/// somebody asked to stop before there was a question.
pub fn verify(
    program: &Program,
    spec: &Spec,
    timing: Timing,
    limits: &Limits,
) -> Result<Verification, Refusal> {
    let mut verifier = Verifier::new(program, spec, timing, limits)?;
    let verification = verifier.run();
    let Verifier {
        followed, ready, ..
    } = verifier;
    let parts = followed.netlist.size();
    free_aside((followed, ready.machine), parts);
    verification
}

/// A ladder with a spec beside it, ready to be asked about.
struct Verifier<'v> {
    program: &'v Program,
    spec: &'v Spec,
    timing: Timing,
    limits: &'v Limits,
    bounds: Bounds,
    followed: Followed,
    ready: Ready<'v>,
    evolutions: usize,
    settling: usize,
}

/// What came of comparing the outputs.
struct Compared {
    verdict: Verdict,
    states: Option<u128>,
    deadlock: Option<usize>,
    /// The question.
    asked: Netlist,
}

impl<'v> Verifier<'v> {
    fn new(
        program: &'v Program,
        spec: &'v Spec,
        timing: Timing,
        limits: &'v Limits,
    ) -> Result<Self, Refusal> {
        let bounds = Bounds {
            gates: limits.gates,
            work: usize::try_from(limits.steps / 50).unwrap_or(usize::MAX),
            cancel: limits.cancel.clone(),
        };
        let ready = Ready::new(spec, &bounds)?;
        let followed = program::follow_beside(program, Some(&ready), &bounds)?;
        bounds.is_wanted()?;
        Ok(Self {
            program,
            spec,
            timing,
            limits,
            followed,
            ready,
            bounds,
            evolutions: 2,
            settling: 3,
        })
    }

    fn run(&mut self) -> Result<Verification, Refusal> {
        loop {
            let system = match self.system() {
                Err(Refusal::TooLarge) => return Ok(self.too_large()),
                system => system?,
            };
            let Some(compared) = self.compare(&system)? else {
                continue;
            };
            let mut properties = Vec::new();
            for (at, property) in self.spec.never.iter().enumerate() {
                let verdict = self.property(&system, at);
                properties.push((property.name.clone(), verdict));
            }
            let mut question = compared.asked;
            for (property, bad) in self.spec.never.iter().zip(&system.never) {
                question.never(property.name.clone(), *bad);
            }
            return Ok(Verification {
                timing: self.timing,
                verdict: compared.verdict,
                rules: self.spec.environment.len(),
                missing: system.missing.clone(),
                absent: self.absent(&system),
                properties,
                free: system.free(&question, &self.limits.cancel),
                question,
                outputs: system.outputs,
                deadlock: compared.deadlock,
                states: compared.states,
            });
        }
    }

    /// What can be said where the system of both does not fit.
    fn too_large(&self) -> Verification {
        let unknown = || Verdict::Unknown {
            bound: 0,
            why: Reason::Limits(Why::Memory),
        };
        let properties = self.spec.never.iter();
        Verification {
            timing: self.timing,
            verdict: unknown(),
            rules: self.spec.environment.len(),
            outputs: Vec::new(),
            missing: Vec::new(),
            absent: Vec::new(),
            properties: properties.map(|it| (it.name.clone(), unknown())).collect(),
            free: Vec::new(),
            deadlock: None,
            question: Netlist::default(),
            states: None,
        }
    }

    fn absent(&self, system: &System) -> Vec<Name> {
        let resolved = |name: &Name| self.followed.resolved(name);
        let known = system.outputs.iter().chain(&system.numbers);
        let known: HashSet<Name> = known.map(resolved).collect();
        let declared = self.program.declarations.iter();
        let outputs =
            declared.filter(|it| it.class == Class::Output && self.followed.writes(&it.name));
        let names = outputs.map(|it| it.name.clone());
        names
            .filter(|name| !known.contains(&resolved(name)))
            .collect()
    }

    fn system(&self) -> Result<System, Refusal> {
        system(
            &self.followed,
            &self.ready,
            self.timing,
            [self.evolutions, self.settling],
            &self.bounds,
        )
    }

    /// Compares the outputs. `None` if more evolutions or scans must be
    /// followed.
    fn compare(&mut self, system: &System) -> Result<Option<Compared>, Refusal> {
        let frame = &system.frame;
        let mut bad = vec![frame.unstable, frame.restless];
        bad.extend(&system.differ);
        self.bounds.is_wanted()?;
        let asked = system.comparison();
        let alone = |verdict, asked| Compared {
            verdict,
            states: None,
            deadlock: None,
            asked,
        };
        let report = check(&asked, self.limits);
        let verdict = match report.verdict {
            _ if system.outputs.is_empty()
                && system.numbers.is_empty()
                && self.spec.never.is_empty() =>
            {
                Verdict::Unknown {
                    bound: 0,
                    why: Reason::Nothing,
                }
            }
            Found::Equivalent if !system.numbers.is_empty() => Verdict::Unknown {
                bound: 0,
                why: Reason::Numbers(system.numbers.clone()),
            },
            Found::Equivalent => Verdict::Equivalent,
            Found::Unknown { clean, why } => Verdict::Unknown {
                bound: clean,
                why: Reason::Limits(why),
            },
            Found::Different(found) => {
                let is_shortest = found.is_shortest();
                for ((trace, end), mut run) in self.replays(system, &found.trace, &bad) {
                    let what = match end {
                        End::Steps(names) if !names.is_empty() => What::Outputs(names),
                        End::Steps(_) => continue,
                        End::Unstable(unstable) => What::Unstable(unstable),
                        End::Restless => What::Restless,
                        End::Cancelled => break,
                    };
                    let is_brief =
                        matches!(what, What::Outputs(_)) && run.after_another().is_empty();
                    let difference = Difference {
                        what,
                        trace,
                        is_shortest,
                        is_brief,
                    };
                    return Ok(Some(alone(Verdict::Different(difference), asked)));
                }
                let is = |name: &str| found.properties.iter().any(|it| &**it == name);
                let rounds = match (is(UNSTABLE), is(RESTLESS)) {
                    _ if self.limits.cancel.is_cancelled() => {
                        return Ok(Some(alone(self.unconfirmed(found.clean), asked)));
                    }
                    (true, _) => &mut self.evolutions,
                    (_, true) => &mut self.settling,
                    _ => return Ok(Some(alone(self.unconfirmed(found.clean), asked))),
                };
                // Not twice: what is followed in vain makes every proof dearer.
                *rounds += *rounds / 2 + 1;
                if *rounds <= MOST_ROUNDS {
                    return Ok(None);
                }
                Verdict::Unknown {
                    bound: found.clean,
                    why: Reason::Rounds,
                }
            }
        };
        let proofs = report
            .properties
            .iter()
            .filter_map(|(_, status)| match status {
                Status::Holds(proof) => Some(*proof),
                _ => None,
            });
        let counted = proofs.filter_map(|proof| match proof {
            Proof::Reachability { states } => states,
            _ => None,
        });
        let states = counted.max();
        let deadlock = match verdict {
            Verdict::Equivalent => deadlock(&asked, MOST_ALLOWED, self.limits),
            _ => Ok(None),
        };
        let deadlock = deadlock.map_err(|_| Refusal::Cancelled)?;
        Ok(Some(Compared {
            verdict,
            states,
            deadlock,
            asked,
        }))
    }

    fn property(&self, system: &System, at: usize) -> Verdict {
        let bad = system.never[at];
        let mut asked = system.frame.netlist.clone();
        asked.never("violated", bad);
        match check(&asked, self.limits).verdict {
            Found::Equivalent => Verdict::Equivalent,
            Found::Unknown { clean, why } => Verdict::Unknown {
                bound: clean,
                why: Reason::Limits(why),
            },
            Found::Different(found) => {
                let is_shortest = found.is_shortest();
                for ((trace, end), mut run) in self.replays(system, &found.trace, &[bad]) {
                    let condition = &self.spec.never[at].condition;
                    if matches!(end, End::Steps(_)) && run.holds(condition) {
                        run.after_another();
                        return Verdict::Different(Difference {
                            what: What::Property,
                            trace,
                            is_shortest,
                            is_brief: !run.holds(condition),
                        });
                    }
                }
                self.unconfirmed(found.clean)
            }
        }
    }

    /// What can be said of a trace that was not seen to happen.
    fn unconfirmed(&self, clean: usize) -> Verdict {
        Verdict::Unknown {
            bound: clean,
            why: match self.limits.cancel.is_cancelled() {
                true => Reason::Limits(Why::Cancelled),
                false => Reason::Unconfirmed,
            },
        }
    }

    /// What comes of a trace with no change of an input that is not needed, and of
    /// the trace as it was found.
    fn replays<'s>(
        &'s self,
        system: &'s System,
        found: &proof::Trace,
        bad: &[Signal],
    ) -> impl Iterator<Item = ((Trace, End), Run<'s>)> {
        let (netlist, cancel) = (&system.frame.netlist, &self.limits.cancel);
        let simple = simplified(netlist, found, bad, MOST_WORK, cancel);
        let both = [simple, found.clone()].into_iter();
        both.map(|signals| self.replayed(system, &signals))
    }

    fn replayed<'s>(
        &'s self,
        system: &'s System,
        signals: &proof::Trace,
    ) -> ((Trace, End), Run<'s>) {
        let machine = self.ready.machine.clone();
        let shown = [system.outputs.as_slice(), system.watched.as_slice()];
        let (timing, cancel) = (self.timing, &self.limits.cancel);
        let mut run = Run::new(self.program, machine, &self.followed, shown, timing, cancel);
        (run.trace(&system.evolved.inputs, signals), run)
    }
}
