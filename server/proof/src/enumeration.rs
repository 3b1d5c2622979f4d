//! Reachability, property by property: those that depend on nearly the same
//! latches share one search, and searches with few latches have their turns
//! first.

use crate::classes::Classes;
use crate::cone::Cutter;
use crate::diagrams::Diagrams;
use crate::limits::{Meter, Why};
use crate::reach::{Reach, Reached};
use crate::{Cone, Netlist};

/// Searches for the properties of some parts, which can be interrupted and
/// resumed.
pub(crate) struct Enumeration<'n> {
    cores: &'n [Cone],
    /// Properties that are in no group yet: the core, and the place in it.
    left: Vec<(usize, usize)>,
    groups: Vec<Group>,
}

/// A search in common may have one latch more for each so many of them.
const FURTHER: usize = 8;

/// Properties that depend on nearly the same latches.
struct Group {
    core: usize,
    properties: Vec<usize>,
    latches: Vec<usize>,
    state: State,
}

enum State {
    /// Not begun, or begun and given up for others.
    Fresh,
    Begun(Box<Reach>),
    /// Done, or more than the limits allow.
    Over,
}

impl<'n> Enumeration<'n> {
    /// Of the properties of these parts.
    pub fn new(cores: &'n [Cone]) -> Self {
        let of_core = |core: usize| (0..cores[core].properties.len()).map(move |at| (core, at));
        let mut left: Vec<(usize, usize)> = (0..cores.len()).flat_map(of_core).collect();
        left.reverse();
        Self {
            cores,
            left,
            groups: Vec::new(),
        }
    }

    /// Searches for properties that are open, by their places in the whole
    /// netlist: what is found of each.
    pub fn advance(
        &mut self,
        is_open: impl Fn(usize) -> bool,
        meter: &mut Meter,
    ) -> Result<Vec<(usize, Reached)>, Why> {
        self.form(&is_open, meter)?;
        let mut found = Vec::new();
        let count = self.groups.len();
        let kept = meter.nodes / count.max(1);
        let mut too_large = Vec::new();
        for (at, group) in self.groups.iter_mut().enumerate() {
            let core = &self.cores[group.core];
            if !group
                .properties
                .iter()
                .any(|&it| is_open(core.properties[it]))
            {
                group.state = State::Over;
            }
            // Each has its share, so that a hard one leaves something.
            let given = meter.left / (count - at) as u64;
            let mut share = meter.clone();
            share.left = given;
            let reached = group.advance(core, kept, &mut share);
            meter.left = meter.left.saturating_sub(given - share.left);
            match reached {
                Ok(all) => found.extend(all),
                Err(Why::Memory) if group.properties.len() > 1 => too_large.push(at),
                Err(Why::Steps | Why::Memory) => {}
                Err(why) => return Err(why),
            }
        }
        // What is too much for all together may not be for each.
        for at in too_large.into_iter().rev() {
            let group = self.groups.remove(at);
            let alone = group.properties.into_iter().map(|property| Group {
                core: group.core,
                properties: vec![property],
                latches: group.latches.clone(),
                state: State::Fresh,
            });
            self.groups.splice(at..at, alone);
        }
        Ok(found)
    }

    /// Puts all properties into groups.
    fn form(&mut self, is_open: &impl Fn(usize) -> bool, meter: &mut Meter) -> Result<(), Why> {
        if self.left.is_empty() {
            return Ok(());
        }
        while let Some(&(core, _)) = self.left.last() {
            let part = &self.cores[core];
            let alone = Classes::alone(part.netlist.size());
            let mut cutter = Cutter::new(&part.netlist, &alone);
            let constraints = all_constraints(&part.netlist);
            while let Some((_, at)) = self.left.pop_if(|(own, _)| *own == core) {
                if is_open(part.properties[at]) {
                    let cone = cutter.cut(&[at], &constraints, &meter.cancel)?;
                    meter.spend(4 * cone.netlist.size())?;
                    put(&mut self.groups, core, at, cone.latches);
                }
            }
        }
        self.groups.sort_by_key(|group| group.latches.len());
        Ok(())
    }
}

/// Puts a property into a group of those that depend on nearly the same latches.
fn put(groups: &mut Vec<Group>, core: usize, property: usize, latches: Vec<usize>) {
    for group in groups.iter_mut().filter(|group| group.core == core) {
        let all = union(&group.latches, &latches);
        let fewer = group.latches.len().min(latches.len());
        if all.len() <= fewer + fewer / FURTHER {
            group.properties.push(property);
            group.latches = all;
            return;
        }
    }
    groups.push(Group {
        core,
        properties: vec![property],
        latches,
        state: State::Fresh,
    });
}

fn union(one: &[usize], other: &[usize]) -> Vec<usize> {
    let mut all = [one, other].concat();
    all.sort_unstable();
    all.dedup();
    all
}

fn all_constraints(netlist: &Netlist) -> Vec<usize> {
    (0..netlist.constraints.len()).collect()
}

impl Group {
    /// Goes on with the search, and keeps what it has if that is no more than
    /// so many nodes.
    fn advance(
        &mut self,
        core: &Cone,
        kept: usize,
        meter: &mut Meter,
    ) -> Result<Vec<(usize, Reached)>, Why> {
        let mut reach = match std::mem::replace(&mut self.state, State::Over) {
            State::Over => return Ok(Vec::new()),
            State::Begun(reach) => reach,
            // Without a cut that is in vain.
            State::Fresh if Diagrams::are_too_many(2 * self.latches.len()) => {
                return Err(Why::Memory);
            }
            State::Fresh => {
                let cone = core.netlist.cone(&self.properties, &meter.cancel)?;
                let netlist = cone.netlist;
                let within = meter.spend(4 * netlist.size());
                if within.is_err() {
                    self.state = State::Fresh;
                }
                within?;
                meter.look()?;
                Box::new(Reach::new(netlist)?)
            }
        };
        let reached = reach.advance(meter);
        if reached == Err(Why::Steps) {
            self.state = match reach.nodes() <= kept {
                true => State::Begun(reach),
                false => State::Fresh,
            };
        }
        let places = self.properties.iter().map(|&at| core.properties[at]);
        Ok(places.zip(reached?).collect())
    }
}
