use logic::{Cancel, Name};

use crate::bounded::{Bounded, Scan};
use crate::classes::Classes;
use crate::components::components;
use crate::cone::{Cutter, joined};
use crate::correspondence::corresponding;
use crate::enumeration::Enumeration;
use crate::explore::explore;
use crate::frame::Framing;
use crate::induction::Induction;
use crate::limits::{Limits, Meter, Why};
use crate::observers::observe;
use crate::reach::Reached;
use crate::report::{Difference, Proof, Report, Status, Verdict};
use crate::{Cone, Netlist, Signal, Trace, violation};

/// The first turn of each engine, in steps; every further one is twice as long.
/// So all engines together take no more than a few times what the one takes that
/// decides, be that microseconds or minutes.
const TURN: u64 = 50_000;
/// The first turn of a large netlist, in steps a node: enough to look at each
/// once.
const A_NODE: u64 = 20;
/// The first turn of the search through all states: where these are few it is
/// over before the other engines have begun.
const AHEAD: u64 = 500_000;

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
    /// The shortest violation found so far, as it was seen to happen, and the
    /// properties that are violated in its last scan.
    trace: Option<(Trace, Vec<Name>)>,
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
            Some((trace, _)) => self.clean + 1 >= trace.scans(),
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
        let parts = self.simplified_parts()?;
        if self.is_decided() {
            return Ok(());
        }
        let mut cores = Vec::with_capacity(parts.len());
        for part in &parts {
            self.look()?;
            cores.push(part.core(&self.status, &self.limits.cancel)?);
        }
        let core = joined(&cores, &self.limits.cancel)?;
        let mut framings = Vec::with_capacity(parts.len());
        for part in &parts {
            self.look()?;
            framings.push(Framing::new(&part.cone.netlist));
        }
        let mut inductions = Vec::with_capacity(parts.len());
        for (part, framing) in parts.iter().zip(&framings) {
            self.look()?;
            inductions.push(Induction::new(framing, &part.classes));
        }
        let mut enumeration = Enumeration::new(&cores);
        let mut bounded = Bounded::new(&core.netlist);
        let mut steps = TURN.max(A_NODE * core.netlist.size() as u64);
        while !self.is_decided() {
            let before = self.left;
            // With a trace in hand, all that is asked is whether a shorter one is.
            if self.trace.is_none() {
                let ahead = steps.max(AHEAD);
                self.turn(ahead, |it, meter| it.enumerate(&mut enumeration, meter))?;
                for (part, induction) in parts.iter().zip(&mut inductions) {
                    self.turn(steps, |it, meter| it.induce(&part.cone, induction, meter))?;
                }
            }
            self.turn(steps, |it, meter| it.search(&core, &mut bounded, meter))?;
            if self.left == before {
                // Nobody had anything left to try.
                let is_end = bounded.clean >= self.limits.scans;
                return Err(if is_end { Why::Scans } else { Why::Memory });
            }
            steps = steps.saturating_mul(2);
        }
        Ok(())
    }

    /// The parts that have nothing to do with each other, each by itself.
    fn simplified_parts(&mut self) -> Result<Vec<Part>, Why> {
        let cancel = &self.limits.cancel;
        let cone = self.netlist.cone(&self.open(), cancel)?;
        let components = components(&cone.netlist, cancel)?;
        let mut parts = Vec::new();
        let alone = Classes::alone(cone.netlist.size());
        let mut cutter = Cutter::new(&cone.netlist, &alone);
        for (at, component) in components.iter().enumerate() {
            self.look()?;
            let part = cutter.cut(&component.properties, &component.constraints, cancel)?;
            let part = cone.within(part);
            // A hard part leaves something for the others.
            let share = self.left / 2 / (components.len() - at) as u64;
            parts.push(self.simplify(part, share)?);
        }
        Ok(parts)
    }

    /// Stops if somebody asked to.
    fn look(&self) -> Result<(), Why> {
        Meter::new(self.limits, 0).look()
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
        let mut explored = explore(&cone.netlist, meter)?;
        if let Some(trace) = &explored.trace {
            // What other parts of the environment forbid does not count.
            self.confirm(cone.whole(self.netlist, trace), meter)?;
        }
        observe(&mut cone.netlist, &explored, meter)?;
        explored.take_in(&cone.netlist, meter)?;
        Ok(explored.classes())
    }

    /// Runs a trace. Whether a property is violated in its last scan and nothing
    /// is forbidden; it is kept then, if it is shorter than what is known.
    fn confirm(&mut self, trace: Trace, meter: &mut Meter) -> Result<bool, Why> {
        let nodes = self.netlist.size();
        let seen = violation(self.netlist, &trace, || meter.spend(2 * nodes))?;
        let Some((_, properties)) = seen.filter(|(scan, _)| scan + 1 == trace.scans()) else {
            return Ok(false);
        };
        let is_shorter = |(known, _): &(Trace, _)| trace.scans() < known.scans();
        if self.trace.as_ref().is_none_or(is_shorter) {
            self.trace = Some((trace, properties));
        }
        Ok(true)
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
                Scan::Violated(trace) => {
                    let trace = cone.whole(self.netlist, &trace);
                    return match self.confirm(trace, meter)? {
                        true => Ok(()),
                        false => Err(Why::Unconfirmed),
                    };
                }
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

    /// Searches through all states.
    fn enumerate(
        &mut self,
        enumeration: &mut Enumeration<'_>,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        let is_open = |at: usize| self.status[at] == Status::Open;
        for (place, reached) in enumeration.advance(is_open, meter)? {
            if let (Reached::All(states), Status::Open) = (reached, self.status[place]) {
                self.status[place] = Status::Holds(Proof::Reachability { states });
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
        if let Some((trace, properties)) = self.trace {
            for (status, property) in status.iter_mut().zip(&self.netlist.properties) {
                if properties.contains(&property.name) {
                    *status = Status::Violated;
                }
            }
            verdict = Verdict::Different(Difference {
                trace,
                properties,
                clean: self.clean,
            });
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
    fn core(&self, status: &[Status], cancel: &Cancel) -> Result<Cone, Why> {
        let netlist = &self.cone.netlist;
        let constraints: Vec<usize> = (0..netlist.constraints.len()).collect();
        let open = open_places(&self.cone, status);
        let mut cutter = Cutter::new(netlist, &self.classes);
        let core = cutter.cut(&open, &constraints, cancel)?;
        Ok(self.cone.within(core))
    }
}

/// The properties of a part that are open, by their places in the part.
fn open_places(cone: &Cone, status: &[Status]) -> Vec<usize> {
    let places = 0..cone.properties.len();
    places
        .filter(|&at| status[cone.properties[at]] == Status::Open)
        .collect()
}
