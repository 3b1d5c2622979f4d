//! A shortest trace for each property by itself.
//!
//! [`crate::check`] asks whether anything can go wrong, and is done with the
//! first trace. Here properties are what somebody would like to see happen: each
//! is looked for until it is found or shown to be out of reach.

use rustc_hash::FxHashSet;

use crate::bounded::{Bounded, Scan};
use crate::classes::Classes;
use crate::components::components;
use crate::cone::{Cone, Cutter};
use crate::frame::Framing;
use crate::induction::Induction;
use crate::limits::{Meter, Why};
use crate::reach::{Reach, Reached};
use crate::simplify::simplified;
use crate::trace::violated_at_end;
use crate::{Gates, Limits, Netlist, Signal, Trace};

/// What is known of a property by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sought {
    /// It is violated at the end of this trace, and of no shorter one. No change
    /// of an input is in it that is not needed.
    Found(Trace),
    /// No trace violates it.
    Never,
    /// Not known; no trace of so many scans or fewer violates it.
    Open(usize),
}

/// What is known of all properties of a netlist.
#[derive(Clone, Debug)]
pub struct Search {
    /// Each property, in the netlist's order.
    pub properties: Vec<Sought>,
    /// Why the search ended before all was known, where it did.
    pub why: Option<Why>,
}

/// Steps of an engine's first turn; each that comes to nothing doubles them.
const TURN: u64 = 200_000;

/// Nodes that are evaluated to make one trace simpler, at most.
const MOST_WORK: usize = 2_000_000;

/// Looks for a shortest trace to each property of `netlist`. Of the inputs at
/// the places in `calm` at most one changes from a scan to the next, counted from
/// all being 0 before the first; with none there, all are free.
///
/// The netlist is divided where its parts have nothing to do with each other, and
/// each has its share of the limits.
pub fn seek(netlist: &Netlist, calm: &[usize], limits: &Limits) -> Search {
    let open = Sought::Open(0);
    let mut search = Search {
        properties: vec![open; netlist.properties.len()],
        why: None,
    };
    if let Err(why) = seek_in_parts(netlist, calm, limits, &mut search) {
        search.why = Some(why);
    }
    search
}

/// Seeks in one part after the other; an error only where nobody wants more.
fn seek_in_parts(
    netlist: &Netlist,
    calm: &[usize],
    limits: &Limits,
    search: &mut Search,
) -> Result<(), Why> {
    let parts = components(netlist, &limits.cancel)?;
    let parts: Vec<_> = parts
        .iter()
        .filter(|part| !part.properties.is_empty())
        .collect();
    // What the environment says counts everywhere: a trace for a part that it
    // forbids elsewhere is none.
    let constraints: Vec<usize> = (0..netlist.constraints.len()).collect();
    let alone = Classes::alone(netlist.size());
    let mut cutter = Cutter::new(netlist, &alone);
    let calm: FxHashSet<usize> = calm.iter().copied().collect();
    let mut left = limits.steps;
    for (at, part) in parts.iter().enumerate() {
        let share = left / (parts.len() - at) as u64;
        let mut cone = cutter.cut(&part.properties, &constraints, &limits.cancel)?;
        let are_calm = (0..cone.inputs.len()).filter(|&it| calm.contains(&cone.inputs[it]));
        let are_calm: Vec<usize> = are_calm.collect();
        cone.netlist.calm(&are_calm);
        let mut seeking = Seeking::new(&cone, limits, share);
        let ended = seeking.run();
        left -= share - seeking.left;
        let found = seeking.found.into_iter().zip(&cone.properties);
        for (sought, &place) in found {
            search.properties[place] = match sought {
                Sought::Found(trace) => Sought::Found(cone.whole(netlist, &trace)),
                other => other,
            };
        }
        match ended {
            Err(Why::Cancelled) => return ended,
            Err(why) => search.why = Some(why),
            Ok(()) => {}
        }
    }
    Ok(())
}

/// The search in one part.
struct Seeking<'s> {
    netlist: &'s Netlist,
    limits: &'s Limits,
    left: u64,
    found: Vec<Sought>,
}

impl<'s> Seeking<'s> {
    fn new(cone: &'s Cone, limits: &'s Limits, steps: u64) -> Self {
        let properties = cone.netlist.properties.iter();
        let found = properties.map(|property| match property.signal {
            Signal::FALSE => Sought::Never,
            _ => Sought::Open(0),
        });
        Self {
            netlist: &cone.netlist,
            limits,
            left: steps,
            found: found.collect(),
        }
    }

    fn open(&self) -> Vec<usize> {
        let is_open = |at: &usize| matches!(self.found[*at], Sought::Open(_));
        (0..self.found.len()).filter(is_open).collect()
    }

    fn run(&mut self) -> Result<(), Why> {
        let framing = Framing::new(self.netlist);
        let alone = Classes::alone(self.netlist.size());
        let mut bounded = Bounded::new(self.netlist);
        let mut induction = Induction::new(&framing, &alone);
        let mut steps = TURN;
        let mut states = States::default();
        while !self.open().is_empty() {
            let before = self.left;
            self.turn(steps, |it, meter| it.advance(&mut bounded, meter))?;
            self.turn(steps, |it, meter| {
                it.induce(&mut induction, bounded.clean, meter)
            })?;
            self.turn(steps, |it, meter| it.enumerate(&mut states, meter))?;
            if self.left == before {
                return Err(match bounded.clean >= self.limits.scans {
                    true => Why::Scans,
                    false => Why::Memory,
                });
            }
            steps = steps.saturating_mul(2);
        }
        Ok(())
    }

    /// Lets an engine work for at most so many steps.
    fn turn(
        &mut self,
        steps: u64,
        work: impl FnOnce(&mut Self, &mut Meter) -> Result<(), Why>,
    ) -> Result<(), Why> {
        let steps = steps.min(self.left);
        let mut meter = Meter::new(self.limits, steps);
        let done = work(self, &mut meter);
        self.left -= steps - meter.left;
        match done {
            Err(Why::Steps | Why::Memory) if self.left > 0 => Ok(()),
            done => done,
        }
    }

    /// Tries longer and longer sequences.
    fn advance(&mut self, bounded: &mut Bounded<'_>, meter: &mut Meter) -> Result<(), Why> {
        while bounded.clean < self.limits.scans {
            let open = self.open();
            if open.is_empty() {
                return Ok(());
            }
            match bounded.advance(|at| open.contains(&at), meter)? {
                Scan::Clean => {
                    for at in open {
                        self.found[at] = Sought::Open(bounded.clean);
                    }
                }
                Scan::Violated(trace) => self.found(&trace, &open, meter)?,
                Scan::Forbidden => {
                    for at in open {
                        self.found[at] = Sought::Never;
                    }
                }
            }
        }
        Ok(())
    }

    /// Takes down what happens at the end of a trace.
    fn found(&mut self, trace: &Trace, open: &[usize], meter: &mut Meter) -> Result<(), Why> {
        let seen = violated_at_end(self.netlist, trace);
        let new: Vec<usize> = open.iter().copied().filter(|&at| seen[at]).collect();
        if new.is_empty() {
            return Err(Why::Unconfirmed);
        }
        for at in new {
            meter.spend(MOST_WORK.min(self.netlist.size() * trace.scans() * 8))?;
            let bad = self.netlist.properties[at].signal;
            let cancel = &self.limits.cancel;
            let simple = simplified(self.netlist, trace, &[bad], MOST_WORK, cancel);
            self.found[at] = Sought::Found(simple);
        }
        Ok(())
    }

    /// Tries to show that what was not found in so many scans never happens.
    fn induce(
        &mut self,
        induction: &mut Induction<'_>,
        clean: usize,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        while induction.scans <= clean {
            let open = self.open();
            if open.is_empty() {
                return Ok(());
            }
            for at in induction.advance(&open, meter)? {
                self.found[at] = Sought::Never;
            }
        }
        Ok(())
    }

    /// Enumerates the states, to see what of that which is open never happens.
    fn enumerate(&mut self, states: &mut States, meter: &mut Meter) -> Result<(), Why> {
        let open = self.open();
        if open.is_empty() || states.is_over {
            return Ok(());
        }
        let search = match &mut states.search {
            Some(search) => search,
            None => {
                let cone = self.netlist.cone(&open, &meter.cancel)?;
                meter.spend(4 * cone.netlist.size())?;
                states.search.insert((Reach::new(cone.netlist)?, open))
            }
        };
        let (reach, asked) = search;
        let reached = reach.advance(meter);
        // What is too large once is so in every turn.
        states.is_over = matches!(reached, Ok(_) | Err(Why::Memory));
        for (&at, reached) in asked.iter().zip(reached?) {
            if let (Reached::All(_), Sought::Open(_)) = (reached, &self.found[at]) {
                self.found[at] = Sought::Never;
            }
        }
        Ok(())
    }
}

/// A search through the states of a part.
#[derive(Default)]
struct States {
    /// The search, and the properties that it is about.
    search: Option<(Reach, Vec<usize>)>,
    /// Whether it has come to its end, or never will.
    is_over: bool,
}

impl Netlist {
    /// Of the inputs at these places the environment changes at most one from a
    /// scan to the next; before the first all are 0.
    pub fn calm(&mut self, places: &[usize]) {
        let mut changed_before = Signal::FALSE;
        let mut too_many = Signal::FALSE;
        for &at in places {
            let input = self.inputs[at].clone();
            let was = self.delayed(input.name, input.signal, false);
            let changed = self.xor(input.signal, was);
            let both = self.and(changed, changed_before);
            too_many = self.or(too_many, both);
            changed_before = self.or(changed_before, changed);
        }
        self.constrain(!too_many);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Verdict, check};

    /// What is known of one property when it is asked about alone.
    fn alone(netlist: &Netlist, at: usize) -> Option<usize> {
        let mut asked = netlist.clone();
        let property = asked.properties.swap_remove(at);
        asked.properties = vec![property];
        let report = check(&asked, &Limits::default());
        match report.verdict {
            Verdict::Equivalent => None,
            Verdict::Different(it) => Some(it.trace.scans()),
            Verdict::Unknown { .. } => panic!("small"),
        }
    }

    /// A row of four steps, each left for the next on an input of its own.
    fn row() -> Netlist {
        let mut netlist = Netlist::default();
        let steps: Vec<Signal> = (0..4)
            .map(|at| netlist.latch(format!("X{at}"), at == 0))
            .collect();
        let inputs: Vec<Signal> = (0..4).map(|at| netlist.input(format!("i{at}"))).collect();
        let fires: Vec<Signal> = (0..4)
            .map(|at| netlist.and(steps[at], inputs[at]))
            .collect();
        for at in 0..4 {
            let entered = fires[(at + 3) % 4];
            let held = netlist.and(steps[at], !fires[at]);
            let next = netlist.or(entered, held);
            netlist.set_next(steps[at], next);
            netlist.never(format!("X{at} is left"), fires[at]);
        }
        let two = netlist.and(steps[0], steps[2]);
        netlist.never("two steps", two);
        netlist
    }

    #[test]
    fn each_property_gets_a_shortest_trace_of_its_own_or_a_proof() {
        let netlist = row();
        let search = seek(&netlist, &[], &Limits::default());
        let scans = search.properties.iter().map(|it| match it {
            Sought::Found(trace) => Some(trace.scans()),
            Sought::Never => None,
            Sought::Open(_) => panic!("small"),
        });
        let scans: Vec<Option<usize>> = scans.collect();
        assert_eq!(scans, [Some(1), Some(2), Some(3), Some(4), None]);
        let Sought::Found(trace) = &search.properties[2] else {
            panic!("found")
        };
        let row = |text: &str| text.chars().map(|it| it == '1').collect::<Vec<bool>>();
        assert_eq!(trace.inputs, ["1000", "1100", "1110"].map(row));
    }

    #[test]
    fn a_calm_environment_changes_one_input_at_a_time() {
        // Both at once, from none: what takes one scan takes two.
        let mut netlist = Netlist::default();
        let [a, b] = ["a", "b"].map(|name| netlist.input(name));
        let both = netlist.and(a, b);
        netlist.never("both", both);
        let scans = |calm: &[usize]| {
            let search = seek(&netlist, calm, &Limits::default());
            match &search.properties[0] {
                Sought::Found(trace) => trace.scans(),
                _ => 0,
            }
        };
        assert_eq!([scans(&[]), scans(&[0]), scans(&[0, 1])], [1, 1, 2]);
    }

    #[test]
    fn a_search_that_is_cancelled_says_so() {
        let limits = Limits::default();
        limits.cancel.cancel();
        let search = seek(&row(), &[], &limits);
        assert_eq!(search.why, Some(Why::Cancelled));
        assert_eq!(search.properties[1], Sought::Open(0));
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig::with_cases(200))]
        #[test]
        fn together_they_get_what_each_gets_alone(
            plan in crate::tests::plan::plans(4, 12),
            manner: u64,
            is_calm: bool,
        ) {
            let mut netlist = plan.build(manner);
            for output in netlist.outputs().to_vec() {
                netlist.never(output.name, output.signal);
            }
            let latches: Vec<Signal> = netlist.latches().iter().map(|it| it.next).collect();
            for pair in latches.windows(2) {
                let both = netlist.and(pair[0], pair[1]);
                netlist.never("both", both);
            }
            let calm: Vec<usize> = match is_calm {
                true => (0..netlist.inputs().len()).collect(),
                false => Vec::new(),
            };
            let search = seek(&netlist, &calm, &Limits::default());
            let mut judge = netlist.clone();
            judge.calm(&calm);
            for (at, sought) in search.properties.iter().enumerate() {
                let scans = match sought {
                    Sought::Found(trace) => {
                        proptest::prop_assert!(violated_at_end(&judge, trace)[at]);
                        Some(trace.scans())
                    }
                    Sought::Never => None,
                    Sought::Open(_) => panic!("small"),
                };
                proptest::prop_assert_eq!(scans, alone(&judge, at));
            }
        }
    }
}
