//! All states that can be reached, as a decision diagram (Burch, Clarke,
//! McMillan, Dill, Hwang: Symbolic model checking: 10^20 states and beyond,
//! LICS 1990).
//!
//! From the initial states on, all next states are computed at once, until no
//! new ones come.

use biodivine_lib_bdd::Bdd;

use crate::Netlist;
use crate::diagrams::Diagrams;
use crate::limits::{Meter, Why};
use crate::relation::{Order, System, Values};

/// What the states that can be reached say about a property.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Reached {
    /// None of them violates it under any input; how many there are.
    All(Option<u128>),
    /// Some state that can be reached in so many scans, and in no fewer, does
    /// in the scan after them.
    Violation(usize),
}

/// A search through the states, which can be interrupted and resumed.
pub(crate) struct Reach {
    netlist: Netlist,
    order: Order,
    diagrams: Diagrams,
    stage: Stage,
}

enum Stage {
    /// The gates are made diagrams of.
    Gates(Values),
    /// The states are searched.
    States(Search),
}

struct Search {
    system: System,
    reached: Bdd,
    /// The states that were new in the last scan.
    front: Bdd,
    /// Those of the next scan, as far as so many parts of the system say.
    image: Option<(Bdd, usize)>,
    scans: usize,
    /// For each property, the scan in which it can be violated first.
    violated: Vec<Option<usize>>,
}

impl Reach {
    /// A search for violations of the properties of `netlist`.
    pub fn new(netlist: Netlist) -> Result<Self, Why> {
        let order = Order::of(&netlist);
        let diagrams = Diagrams::new(order.variables)?;
        Ok(Self {
            stage: Stage::Gates(Values::new(&netlist, &diagrams)),
            netlist,
            order,
            diagrams,
        })
    }

    /// Computes the states that can be reached until no new ones come, or until
    /// every property is known to be violated: what is known of each then. After
    /// an error the same call goes on where it stopped.
    pub fn advance(&mut self, meter: &mut Meter) -> Result<Vec<Reached>, Why> {
        let diagrams = &self.diagrams;
        let search = match &mut self.stage {
            Stage::States(search) => search,
            Stage::Gates(values) => {
                values.complete(&self.netlist, &self.order, diagrams, meter)?;
                let system = System::new(&self.netlist, &self.order, diagrams, values, meter)?;
                self.stage = Stage::States(Search {
                    reached: system.initial.clone(),
                    front: system.initial.clone(),
                    image: None,
                    scans: 0,
                    violated: vec![None; system.bad.len()],
                    system,
                });
                return self.advance(meter);
            }
        };
        while !search.advance(diagrams, meter)? {}
        let states = diagrams.ways(&search.reached, &self.order.is_latch);
        let of =
            |violated: &Option<usize>| violated.map_or(Reached::All(states), Reached::Violation);
        Ok(search.violated.iter().map(of).collect())
    }

    /// How many nodes are kept for the next call.
    pub fn nodes(&self) -> usize {
        match &self.stage {
            Stage::Gates(values) => values.nodes(),
            Stage::States(search) => {
                let image = search.image.as_ref().map_or(0, |(image, _)| image.size());
                search.system.nodes() + search.reached.size() + search.front.size() + image
            }
        }
    }
}

impl Search {
    /// Goes on for one scan. Whether that was the last.
    fn advance(&mut self, diagrams: &Diagrams, meter: &mut Meter) -> Result<bool, Why> {
        let system = &self.system;
        let (mut image, from) = match self.image.take() {
            Some(begun) => begun,
            None => {
                let properties = system.bad.iter().zip(&mut self.violated);
                for (bad, violated) in properties.filter(|(_, violated)| violated.is_none()) {
                    let is_violated = !diagrams.and(&self.front, bad, meter)?.is_false();
                    *violated = is_violated.then_some(self.scans);
                }
                if self.violated.iter().all(Option::is_some) {
                    return Ok(true);
                }
                (diagrams.and(&self.front, &system.allowed, meter)?, 0)
            }
        };
        for (at, part) in system.parts.iter().enumerate().skip(from) {
            match diagrams.and_exists(&image, &part.relation, &part.done, meter) {
                Ok(further) => image = further,
                Err(why) => {
                    self.image = Some((image, at));
                    return Err(why);
                }
            }
        }
        if system.parts.is_empty() {
            return Ok(true);
        }
        match self.joined(&image, diagrams, meter) {
            Ok(None) => Ok(true),
            Ok(Some([reached, front])) => {
                (self.reached, self.front) = (reached, front);
                self.scans += 1;
                Ok(false)
            }
            Err(why) => {
                self.image = Some((image, self.system.parts.len()));
                Err(why)
            }
        }
    }

    /// All states, and those of the next scan that are new; none if none is new.
    fn joined(
        &self,
        image: &Bdd,
        diagrams: &Diagrams,
        meter: &mut Meter,
    ) -> Result<Option<[Bdd; 2]>, Why> {
        let next = diagrams.one_before(image)?;
        let front = diagrams.and_not(&next, &self.reached, meter)?;
        if front.is_false() {
            return Ok(None);
        }
        let reached = diagrams.or(&self.reached, &front, meter)?;
        Ok(Some([reached, front]))
    }
}
