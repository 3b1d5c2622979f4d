//! The question, and its answer.

use std::collections::HashSet;

use grafcet::Spec;
use grafcet::evolution::Unstable;
use ladder::{Class, Program};
use logic::Name;
use proof::{
    Gates, Limits, Netlist, Proof, Signal, Status, Verdict as Found, Why, check, deadlock,
    simplified,
};

use crate::chart::{self, Evolved};
use crate::frame::Frame;
use crate::inputs::Source;
use crate::program::{self, Bounds, Followed};
use crate::refusal::Refusal;
use crate::rules::{Atoms, Steps, names_of};
use crate::run::{End, Run};
use crate::trace::Trace;
use crate::value::Value;

/// When outputs are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// After every scan.
    #[default]
    Scan,
    /// When both sides have come to rest with the same inputs.
    Settled,
}

impl Timing {
    /// Its name: `scan`, `settled`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Scan => "scan",
            Self::Settled => "settled",
        }
    }
}

/// Properties that are no outputs; no variable is called so.
const UNSTABLE: &str = "(unstable)";
const RESTLESS: &str = "(restless)";

/// A scan of a grafcet is followed through this many evolutions, a settling of
/// both sides through this many scans, at most.
const MOST_ROUNDS: usize = 256;

/// Environment rules that allow so many steps are taken not to contradict each
/// other: a rule speaks of two.
const MOST_ALLOWED: usize = 20;

/// So many gates are evaluated to make a trace simpler.
const MOST_WORK: usize = 200_000_000;

/// What was found about a ladder and its spec.
#[derive(Clone, Debug)]
pub struct Verification {
    /// When outputs were compared.
    pub timing: Timing,
    /// Whether the two do the same.
    pub verdict: Verdict,
    /// How many environment rules restrict the inputs.
    pub rules: usize,
    /// The outputs that were compared.
    pub outputs: Vec<Name>,
    /// Outputs of the spec that the ladder does not know.
    pub missing: Vec<Name>,
    /// Outputs that the ladder declares and writes, and the spec does not have.
    pub absent: Vec<Name>,
    /// The properties of the spec, each by itself.
    pub properties: Vec<(Name, Verdict)>,
    /// What is left free, since time or numbers that are not followed decide it.
    pub free: Vec<Source>,
    /// The environment rules allow no sequence of more steps than this.
    pub deadlock: Option<usize>,
    /// The question as it was asked at last: the system, and as its properties
    /// that the grafcet is unstable, that both never rest, that each output
    /// differs, and those of the spec. Empty if it is too large to be asked.
    pub question: Netlist,
    /// How many states were counted, where the engine that decided counts them.
    pub states: Option<u128>,
}

/// An answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// For every sequence of inputs that the environment allows.
    Equivalent,
    /// There is a sequence after which it is not so.
    Different(Difference),
    /// Not known.
    Unknown {
        /// No sequence of so many steps or fewer shows anything.
        bound: usize,
        /// What came in the way.
        why: Reason,
    },
}

/// What a sequence leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What happens in the last step.
    pub what: What,
    /// The sequence, as the interpreters ran it.
    pub trace: Trace,
    /// Whether no shorter one shows anything.
    pub is_shortest: bool,
    /// Whether it is over after another step with the same inputs.
    pub is_brief: bool,
}

/// What happens in the last step of a sequence.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// These outputs differ.
    Outputs(Vec<Name>),
    /// The grafcet finds no stable situation.
    Unstable(Unstable),
    /// Something changes in every scan, with the same inputs.
    Restless,
    /// The property is violated.
    Property,
}

/// Why an answer is not known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The limits were reached, or somebody asked to stop.
    Limits(Why),
    /// There is nothing to compare: the spec has no output that the ladder knows.
    Nothing,
    /// These outputs hold numbers that are not followed.
    Numbers(Vec<Name>),
    /// A sequence was found, but the interpreters do not confirm it: it needs
    /// what is left free to be as no time and no count makes it.
    Unconfirmed,
    /// A scan may take more evolutions, or settling more scans, than are
    /// followed.
    Rounds,
}

/// Finds out whether the grafcet of `spec` does what `program` does, within the
/// environment that the spec describes, and whether its properties hold.
pub fn verify(
    program: &Program,
    spec: &Spec,
    timing: Timing,
    limits: &Limits,
) -> Result<Verification, Refusal> {
    let mut verifier = Verifier::new(program, spec, timing, limits)?;
    verifier.run()
}

/// A ladder with a spec beside it, ready to be asked about.
struct Verifier<'v> {
    program: &'v Program,
    spec: &'v Spec,
    timing: Timing,
    limits: &'v Limits,
    bounds: Bounds,
    followed: Followed,
    evolutions: usize,
    settling: usize,
}

/// The system that is asked about, and its questions.
pub(crate) struct System {
    pub(crate) evolved: Evolved,
    pub(crate) frame: Frame,
    pub(crate) outputs: Vec<Name>,
    missing: Vec<Name>,
    numbers: Vec<Name>,
    /// What the properties speak of, of the ladder and not compared.
    watched: Vec<Name>,
    differ: Vec<Signal>,
    never: Vec<Signal>,
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
        Ok(Self {
            program,
            spec,
            timing,
            limits,
            followed: program::follow(program, Some(spec), &bounds)?,
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
            let Some(verdict) = self.compare(&system)? else {
                continue;
            };
            let (verdict, states, deadlock) = verdict;
            let mut properties = Vec::new();
            for (at, property) in self.spec.never.iter().enumerate() {
                let verdict = self.property(&system, at);
                properties.push((property.name.clone(), verdict));
            }
            return Ok(Verification {
                timing: self.timing,
                verdict,
                rules: self.spec.environment.len(),
                missing: system.missing.clone(),
                absent: self.absent(&system),
                properties,
                free: free(&system),
                question: question(&system, self.spec),
                outputs: system.outputs,
                deadlock,
                states,
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
            self.spec,
            self.timing,
            [self.evolutions, self.settling],
            &self.bounds,
        )
    }

    /// Compares the outputs. `None` if more evolutions or scans must be
    /// followed.
    #[allow(clippy::type_complexity)]
    fn compare(
        &mut self,
        system: &System,
    ) -> Result<Option<(Verdict, Option<u128>, Option<usize>)>, Refusal> {
        let frame = &system.frame;
        let mut bad = vec![frame.unstable, frame.restless];
        bad.extend(&system.differ);
        let asked = comparison(system);
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
                    return Ok(Some((Verdict::Different(difference), None, None)));
                }
                let is = |name: &str| found.properties.iter().any(|it| &**it == name);
                let rounds = match (is(UNSTABLE), is(RESTLESS)) {
                    _ if self.limits.cancel.is_cancelled() => {
                        return Ok(Some((self.unconfirmed(found.clean), None, None)));
                    }
                    (true, _) => &mut self.evolutions,
                    (_, true) => &mut self.settling,
                    _ => return Ok(Some((self.unconfirmed(found.clean), None, None))),
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
        Ok(Some((verdict, states, deadlock)))
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
        let grafcet = &self.spec.grafcet;
        let shown = [system.outputs.as_slice(), system.watched.as_slice()];
        let (timing, cancel) = (self.timing, &self.limits.cancel);
        let mut run = Run::new(self.program, grafcet, &self.followed, shown, timing, cancel);
        (run.trace(&system.evolved.inputs, signals), run)
    }
}

/// The system of a ladder and a spec, through so many evolutions and scans.
pub(crate) fn system(
    followed: &Followed,
    spec: &Spec,
    timing: Timing,
    [evolutions, settling]: [usize; 2],
    bounds: &Bounds,
) -> Result<System, Refusal> {
    let mut evolved = chart::follow(spec, Some(followed), evolutions, bounds)?;
    let (mut outputs, mut missing, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    let mut differ = Vec::new();
    for name in evolved.outputs().to_vec() {
        let own = followed.output(&name, &mut evolved.netlist);
        let Some(own) = own else {
            missing.push(name);
            continue;
        };
        let other = evolved.value(&name).cloned().unwrap_or(Value::Unknown(0));
        match own.equals(&other, &mut evolved.netlist) {
            Some(equal) => {
                differ.push(!equal);
                outputs.push(name);
            }
            None => numbers.push(name),
        }
    }
    let mut atoms = Atoms::new(followed, &mut evolved);
    spec.environment
        .iter()
        .try_for_each(|rule| atoms.look_up_rule(rule))?;
    spec.never
        .iter()
        .try_for_each(|it| atoms.look_up_property(it))?;
    let atoms = atoms.known();
    let mut frame = Frame::new(&evolved, timing, settling, bounds)?;
    let differ = differ.into_iter().map(|signal| frame.of(signal)).collect();
    let mut steps = Steps {
        frame: &mut frame,
        atoms,
    };
    let rules: Vec<Signal> = spec
        .environment
        .iter()
        .map(|rule| steps.rule(rule))
        .collect();
    let never = spec.never.iter().map(|it| steps.property(it)).collect();
    for rule in rules {
        frame.netlist.constrain(rule);
    }
    let mut watched: Vec<Name> = Vec::new();
    for name in spec.never.iter().flat_map(|it| names_of(&it.condition)) {
        let is_shown = outputs.contains(&name) || watched.contains(&name);
        if followed.writes(&name) && !is_shown {
            watched.push(name);
        }
    }
    Ok(System {
        evolved,
        frame,
        outputs,
        missing,
        numbers,
        watched,
        differ,
        never,
    })
}

/// The system with the comparison of outputs as its properties.
fn comparison(system: &System) -> Netlist {
    let mut asked = system.frame.netlist.clone();
    asked.never(UNSTABLE, system.frame.unstable);
    asked.never(RESTLESS, system.frame.restless);
    for (name, differ) in system.outputs.iter().zip(&system.differ) {
        asked.never(name.clone(), *differ);
    }
    asked
}

/// The comparison, and the properties of the spec.
fn question(system: &System, spec: &Spec) -> Netlist {
    let mut asked = comparison(system);
    for (property, bad) in spec.never.iter().zip(&system.never) {
        asked.never(property.name.clone(), *bad);
    }
    asked
}

/// What is left free and can tell on the outputs that are compared.
fn free(system: &System) -> Vec<Source> {
    let mut asked = system.frame.netlist.clone();
    let any = asked.any(&system.differ);
    asked.never("any", any);
    let cone = asked.cone(&[asked.properties().len() - 1]);
    let sources = cone
        .inputs
        .iter()
        .filter_map(|at| system.evolved.inputs.sources.get(*at));
    sources.filter(|it| !it.is_given()).cloned().collect()
}

impl Verification {
    /// Whether all is proved: the outputs, and every property.
    pub fn is_proved(&self) -> bool {
        let all = self.properties.iter().map(|(_, verdict)| verdict);
        std::iter::once(&self.verdict)
            .chain(all)
            .all(|it| *it == Verdict::Equivalent)
    }

    /// Whether somebody asked to stop before all was known.
    pub fn is_cancelled(&self) -> bool {
        let all = self.properties.iter().map(|(_, verdict)| verdict);
        let is_cancelled = |verdict: &Verdict| {
            let why = Reason::Limits(Why::Cancelled);
            matches!(verdict, Verdict::Unknown { why: own, .. } if *own == why)
        };
        std::iter::once(&self.verdict).chain(all).any(is_cancelled)
    }
}
