use crate::bounded::{Bounded, Scan};
use crate::classes::Classes;
use crate::correspondence::corresponding;
use crate::explore::explore;
use crate::frame::Framing;
use crate::induction::Induction;
use crate::limits::{Limits, Meter, Why};
use crate::observers::observe;
use crate::reach::{Reached, reach};
use crate::report::{Difference, Proof, Report, Status, Verdict};
use crate::{Cone, Netlist, Signal, Trace, replay};

/// The first turn of each engine, in steps; every further one is twice as long.
const TURN: u64 = 2_000_000;

/// Whether a property of the netlist can be violated, by all engines together.
///
/// Random runs come first, then the proof of all equalities that induction can
/// give. What is left of the properties is cut down to what they depend on, and
/// three engines take turns at it: the search for a shortest trace, induction
/// over more and more scans, and reachability. Whoever is done first decides;
/// the turns grow, so that none has to wait for another for ever.
pub fn check(netlist: &Netlist, limits: &Limits) -> Report {
    let mut checking = Checking::new(netlist, limits);
    let why = checking.run().err();
    checking.report(why)
}

struct Checking<'n> {
    netlist: &'n Netlist,
    limits: &'n Limits,
    /// Steps that are left.
    left: u64,
    status: Vec<Status>,
    /// The shortest violation found so far.
    trace: Option<Trace>,
    /// No trace of so many scans or fewer violates a property.
    clean: usize,
}

impl<'n> Checking<'n> {
    fn new(netlist: &'n Netlist, limits: &'n Limits) -> Self {
        let properties = netlist.properties.iter();
        let status = properties
            .map(|property| match property.signal {
                Signal::FALSE => Status::Holds(Proof::Construction),
                _ => Status::Open,
            })
            .collect();
        Self {
            netlist,
            limits,
            left: limits.steps,
            status,
            trace: None,
            clean: 0,
        }
    }

    fn open(&self) -> Vec<usize> {
        let places = 0..self.status.len();
        places
            .filter(|&at| self.status[at] == Status::Open)
            .collect()
    }

    /// Whether the answer is complete.
    fn is_decided(&self) -> bool {
        match &self.trace {
            Some(trace) => self.clean + 1 >= trace.scans(),
            None => self.open().is_empty(),
        }
    }

    /// Lets an engine work for at most so many steps. `None` if it did not come
    /// to an end for want of steps or memory.
    fn turn<T>(
        &mut self,
        steps: u64,
        work: impl FnOnce(&mut Self, &mut Meter) -> Result<T, Why>,
    ) -> Result<Option<T>, Why> {
        let steps = steps.min(self.left);
        let mut meter = Meter::new(self.limits, steps);
        let done = work(self, &mut meter);
        self.left -= steps - meter.left;
        match done {
            Ok(done) => Ok(Some(done)),
            Err(Why::Steps | Why::Memory) if self.left > 0 => Ok(None),
            Err(why) => Err(why),
        }
    }

    fn run(&mut self) -> Result<(), Why> {
        if self.is_decided() {
            return Ok(());
        }
        let mut cone = self.netlist.cone(&self.open());
        let Some(candidates) = self.turn(self.left / 4, |it, meter| it.sample(&mut cone, meter))?
        else {
            return Err(Why::Memory);
        };
        if self.trace.is_some() {
            // Most differences are short; then nothing else has to be known.
            let mut bounded = Bounded::new(&cone.netlist);
            self.turn(TURN, |it, meter| it.search(&cone, &mut bounded, meter))?;
            if self.is_decided() {
                return Ok(());
            }
        }
        let framing = Framing::new(&cone.netlist);
        let classes = self
            .turn(self.left / 2, |_, meter| {
                corresponding(&framing, candidates, meter)
            })?
            .unwrap_or_else(|| Classes::alone(cone.netlist.size()));
        for (property, &place) in cone.netlist.properties.iter().zip(&cone.properties) {
            if classes.leader(property.signal) == Signal::FALSE {
                self.status[place] = Status::Holds(Proof::Correspondence);
            }
        }
        let places = 0..cone.properties.len();
        let rest: Vec<usize> = places
            .filter(|&at| self.status[cone.properties[at]] == Status::Open)
            .collect();
        let core = cone.narrowed(cone.netlist.merged_cone(&rest, &classes));
        let mut bounded = Bounded::new(&core.netlist);
        let mut induction = Induction::new(&framing, &classes);
        let mut reachable = Reachable::of(&core);
        let mut steps = TURN;
        while !self.is_decided() {
            let before = self.left;
            self.turn(steps, |it, meter| it.search(&core, &mut bounded, meter))?;
            self.turn(steps, |it, meter| it.induce(&cone, &mut induction, meter))?;
            self.turn(steps, |it, meter| it.enumerate(&mut reachable, meter))?;
            if self.left == before {
                // Nobody had anything left to try.
                let is_end = bounded.clean >= self.limits.scans;
                return Err(if is_end { Why::Scans } else { Why::Memory });
            }
            steps = steps.saturating_mul(2);
        }
        Ok(())
    }

    /// Random runs, and what they make candidates of.
    fn sample(&mut self, cone: &mut Cone, meter: &mut Meter) -> Result<Classes, Why> {
        let explored = explore(&cone.netlist, meter)?;
        observe(&mut cone.netlist, &explored, meter)?;
        let observed = explore(&cone.netlist, meter)?;
        self.trace = observed.trace.map(|it| cone.whole(self.netlist, &it));
        Ok(observed.classes)
    }

    /// Tries longer and longer sequences.
    fn search(
        &mut self,
        cone: &Cone,
        bounded: &mut Bounded<'_>,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        while !self.is_decided() && bounded.clean < self.limits.scans {
            let is_open = |at: usize| self.status[cone.properties[at]] == Status::Open;
            match bounded.advance(is_open, meter)? {
                Scan::Clean => self.clean = self.clean.max(bounded.clean),
                Scan::Violated(trace) => self.trace = Some(cone.whole(self.netlist, &trace)),
                Scan::Forbidden => {
                    for place in self.open() {
                        self.status[place] = Status::Holds(Proof::Deadlock(bounded.clean));
                    }
                }
            }
        }
        Ok(())
    }

    /// Tries induction over as many scans as are known to be without violation.
    fn induce(
        &mut self,
        cone: &Cone,
        induction: &mut Induction<'_>,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        while !self.is_decided() && induction.scans <= self.clean {
            let places = 0..cone.properties.len();
            let open: Vec<usize> = places
                .filter(|&at| self.status[cone.properties[at]] == Status::Open)
                .collect();
            let scans = induction.scans;
            for at in induction.advance(&open, meter)? {
                self.status[cone.properties[at]] = Status::Holds(Proof::Induction(scans));
            }
        }
        Ok(())
    }

    /// Enumerates the states of one property after the other.
    fn enumerate(&mut self, reachable: &mut Reachable, meter: &mut Meter) -> Result<(), Why> {
        for (place, netlist, is_violated) in &mut reachable.cones {
            if self.status[*place] != Status::Open || *is_violated {
                continue;
            }
            // Each has its share, so that a hard one leaves something for others.
            let given = meter.left / 2;
            let mut share = meter.clone();
            share.left = given;
            let reached = reach(netlist, &mut share);
            meter.left -= given - share.left;
            match reached {
                Ok(Reached::All(states)) => {
                    self.status[*place] = Status::Holds(Proof::Reachability { states });
                }
                Ok(Reached::Violation(_)) => *is_violated = true,
                Err(Why::Steps | Why::Memory) => {}
                Err(why) => return Err(why),
            }
        }
        Ok(())
    }

    fn report(self, why: Option<Why>) -> Report {
        let mut status = self.status;
        let mut verdict = match why {
            None => Verdict::Equivalent,
            Some(why) => Verdict::Unknown {
                clean: self.clean,
                why,
            },
        };
        if let Some(trace) = self.trace {
            let seen = replay(self.netlist, &trace);
            verdict = match seen.violation {
                Some((scan, properties)) if scan + 1 == trace.scans() => {
                    for (status, property) in status.iter_mut().zip(&self.netlist.properties) {
                        if properties.contains(&property.name) {
                            *status = Status::Violated;
                        }
                    }
                    Verdict::Different(Difference {
                        trace,
                        properties,
                        clean: self.clean,
                    })
                }
                _ => Verdict::Unknown {
                    clean: self.clean,
                    why: Why::Unconfirmed,
                },
            };
        }
        let names = self.netlist.properties.iter();
        Report {
            verdict,
            properties: names.map(|it| it.name.clone()).zip(status).collect(),
        }
    }
}

/// What each property depends on by itself, fewest latches first: its place,
/// and whether it is known that it can be violated.
struct Reachable {
    cones: Vec<(usize, Netlist, bool)>,
}

impl Reachable {
    fn of(core: &Cone) -> Self {
        let mut cones: Vec<(usize, Netlist, bool)> = core
            .properties
            .iter()
            .enumerate()
            .map(|(at, &place)| (place, core.netlist.cone(&[at]).netlist, false))
            .collect();
        cones.sort_by_key(|(place, netlist, _)| (netlist.latches.len(), *place));
        Self { cones }
    }
}
