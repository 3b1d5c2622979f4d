use crate::bounded::{Bounded, Scan};
use crate::classes::Classes;
use crate::components::components;
use crate::cone::{Cutter, joined};
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
const TURN: u64 = 10_000_000;

/// Whether a property of the netlist can be violated, by all engines together.
///
/// The netlist falls into parts that have nothing to do with each other. In each,
/// random runs come first, then the proof of all equalities that induction can
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
        let cone = self.netlist.cone(&self.open());
        let components = components(&cone.netlist);
        let mut parts = Vec::new();
        let alone = Classes::alone(cone.netlist.size());
        let mut cutter = Cutter::new(&cone.netlist, &alone);
        for (at, component) in components.iter().enumerate() {
            let part = cone.within(cutter.cut(&component.properties, &component.constraints));
            // A hard part leaves something for the others.
            let share = self.left / 2 / (components.len() - at) as u64;
            parts.push(self.simplify(part, share)?);
        }
        if self.is_decided() {
            return Ok(());
        }
        let cores: Vec<Cone> = parts.iter().map(|part| part.core(&self.status)).collect();
        let core = joined(&cores);
        let framings: Vec<Framing<'_>> = parts
            .iter()
            .map(|part| Framing::new(&part.cone.netlist))
            .collect();
        let mut inductions: Vec<Induction<'_>> = parts
            .iter()
            .zip(&framings)
            .map(|(part, framing)| Induction::new(framing, &part.classes))
            .collect();
        let mut refuted = vec![false; self.status.len()];
        let mut bounded = Bounded::new(&core.netlist);
        let mut steps = TURN;
        while !self.is_decided() {
            let before = self.left;
            self.turn(steps, |it, meter| it.search(&core, &mut bounded, meter))?;
            for (part, induction) in parts.iter().zip(&mut inductions) {
                self.turn(steps, |it, meter| it.induce(&part.cone, induction, meter))?;
            }
            self.turn(steps, |it, meter| it.enumerate(&cores, &mut refuted, meter))?;
            if self.left == before {
                // Nobody had anything left to try.
                let is_end = bounded.clean >= self.limits.scans;
                return Err(if is_end { Why::Scans } else { Why::Memory });
            }
            steps = steps.saturating_mul(2);
        }
        Ok(())
    }

    /// Random runs of a part and the equalities in it, as far as they can be
    /// had for so many steps.
    fn simplify(&mut self, mut cone: Cone, steps: u64) -> Result<Part, Why> {
        let candidates = match cone.properties.is_empty() {
            // Nothing is asked of it but that it goes on.
            true => None,
            false => self.turn(steps / 4, |it, meter| it.sample(&mut cone, meter))?,
        };
        let classes = match candidates {
            None => None,
            Some(candidates) => self.turn(steps, |_, meter| {
                corresponding(&Framing::new(&cone.netlist), candidates, meter)
            })?,
        };
        let classes = classes.unwrap_or_else(|| Classes::alone(cone.netlist.size()));
        for (property, &place) in cone.netlist.properties.iter().zip(&cone.properties) {
            if classes.leader(property.signal) == Signal::FALSE {
                self.status[place] = Status::Holds(Proof::Correspondence);
            }
        }
        Ok(Part { cone, classes })
    }

    /// Random runs, and what they make candidates of.
    fn sample(&mut self, cone: &mut Cone, meter: &mut Meter) -> Result<Classes, Why> {
        let explored = explore(&cone.netlist, meter)?;
        observe(&mut cone.netlist, &explored, meter)?;
        let observed = explore(&cone.netlist, meter)?;
        if let Some(trace) = observed.trace {
            let trace = cone.whole(self.netlist, &trace);
            let is_shorter = |known: &Trace| trace.scans() < known.scans();
            // What other parts of the environment forbid does not count.
            if self.trace.as_ref().is_none_or(is_shorter)
                && replay(self.netlist, &trace).violation.is_some()
            {
                self.trace = Some(trace);
            }
        }
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
            let open = open_places(cone, &self.status);
            if open.is_empty() {
                return Ok(());
            }
            let scans = induction.scans;
            for at in induction.advance(&open, meter)? {
                self.status[cone.properties[at]] = Status::Holds(Proof::Induction(scans));
            }
        }
        Ok(())
    }

    /// Enumerates the states of one property after the other, except those
    /// that are `refuted`: of these it is known that they can be violated.
    fn enumerate(
        &mut self,
        cores: &[Cone],
        refuted: &mut [bool],
        meter: &mut Meter,
    ) -> Result<(), Why> {
        for core in cores {
            let alone = Classes::alone(core.netlist.size());
            let mut cutter = Cutter::new(&core.netlist, &alone);
            let constraints: Vec<usize> = (0..core.netlist.constraints.len()).collect();
            for (at, &place) in core.properties.iter().enumerate() {
                if self.status[place] != Status::Open || refuted[place] {
                    continue;
                }
                let cone = cutter.cut(&[at], &constraints);
                meter.spend(4 * cone.netlist.size())?;
                // Each has its share, so that a hard one leaves something.
                let given = (meter.left / self.open().len().max(1) as u64).max(TURN / 4);
                let mut share = meter.clone();
                share.left = given;
                let reached = reach(&cone.netlist, &mut share);
                meter.left = meter.left.saturating_sub(given - share.left);
                match reached {
                    Ok(Reached::All(states)) => {
                        self.status[place] = Status::Holds(Proof::Reachability { states });
                    }
                    Ok(Reached::Violation(_)) => refuted[place] = true,
                    Err(Why::Steps | Why::Memory) => {}
                    Err(why) => return Err(why),
                }
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

/// A part of the netlist, with gates that observe it, and what is equal in it.
struct Part {
    cone: Cone,
    classes: Classes,
}

impl Part {
    /// What the open properties of the part depend on, less what is equal.
    fn core(&self, status: &[Status]) -> Cone {
        let netlist = &self.cone.netlist;
        let constraints: Vec<usize> = (0..netlist.constraints.len()).collect();
        let open = open_places(&self.cone, status);
        let mut cutter = Cutter::new(netlist, &self.classes);
        self.cone.within(cutter.cut(&open, &constraints))
    }
}

/// The properties of a part that are open, by their places in the part.
fn open_places(cone: &Cone, status: &[Status]) -> Vec<usize> {
    let places = 0..cone.properties.len();
    places
        .filter(|&at| status[cone.properties[at]] == Status::Open)
        .collect()
}
