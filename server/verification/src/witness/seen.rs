//! What was found, as the interpreter runs it.

use std::sync::Arc;

use grafcet::{Grafcet, evolution};
use ladder::Program;
use ladder::scan::Machine;
use logic::{Cancel, Name};
use proof::Trace as Signals;
use recovery::successions::Witness;

use super::pairs::Pairs;
use super::watch::{Ask, Watch};
use crate::Timing;
use crate::program::Followed;
use crate::run::Run;

/// What solving a rung counts for, in steps.
const PER_RUNG: u64 = 100;

/// Runs what was found, as far as its share of steps goes.
pub(super) struct Confirming<'c> {
    pub program: &'c Program,
    pub followed: &'c Followed,
    pub pairs: &'c Pairs,
    pub rungs: u64,
    pub left: u64,
    pub cancel: &'c Cancel,
}

impl Confirming<'_> {
    /// The witness that a trace is of what was asked. `None` if it does not
    /// happen when the program runs: it needs what is left free to be as no time
    /// and no count makes it.
    pub fn witness(
        &mut self,
        ask: &Ask,
        signals: &Signals,
        watch: &Watch<'_>,
    ) -> Option<Arc<Witness>> {
        let cost = PER_RUNG * self.rungs * signals.scans() as u64;
        self.left = self.left.checked_sub(cost)?;
        let states = self.states(ask);
        let variables = states.iter().map(|name| &self.pairs.held[name].variable);
        let mut variables: Vec<Name> = variables.cloned().collect();
        variables.dedup();
        let shown = [&[][..], &variables[..]];
        let mut run = Run::new(
            self.program,
            evolution::Machine::new(&Grafcet::default()),
            self.followed,
            shown,
            Timing::Scan,
            self.cancel,
        );
        let (trace, _) = run.trace(&watch.inputs, signals);
        let on = trace.steps.iter().map(|step| {
            let is_on = |name: &&Name| {
                let held = &self.pairs.held[*name];
                let mut values = step.ladder.iter();
                let own = values.find(|(variable, _)| *variable == held.variable);
                own.is_some_and(|(_, datum)| held.is_on(*datum))
            };
            states.iter().filter(is_on).cloned().collect()
        });
        let on: Vec<Vec<Name>> = on.collect();
        let ended = self.ended(ask, &on)?;
        Some(Arc::new(Witness {
            scenario: trace.scenario(),
            on,
            ended,
            is_calm: watch.is_calm(signals),
        }))
    }

    /// The states that the answer shows: those asked about, and their groups.
    fn states(&self, ask: &Ask) -> Vec<Name> {
        let asked = match ask {
            Ask::AtOnce { from, to } | Ask::InTurn { from, to } | Ask::Delayed { from, to } => {
                vec![from, to]
            }
            Ask::Together { from, to: [a, b] } => vec![from, a, b],
        };
        let mut states: Vec<Name> = Vec::new();
        for name in asked {
            let group = self.pairs.group_of.get(name);
            let group = group.map_or(std::slice::from_ref(name), |at| &self.pairs.groups[*at]);
            for name in group {
                if !states.contains(name) {
                    states.push(name.clone());
                }
            }
        }
        states
    }

    /// The scan in which the first state ended, if all is as it was asked; `scans`
    /// are the states that are on after each.
    fn ended(&self, ask: &Ask, scans: &[Vec<Name>]) -> Option<usize> {
        let last = scans.len().checked_sub(1)?;
        let machine = Machine::new(self.program);
        let was_on = |name: &Name, scan: usize| match scan.checked_sub(1) {
            Some(before) => scans[before].contains(name),
            None => {
                let held = &self.pairs.held[name];
                held.is_on(machine.value(&self.followed.resolved(&held.variable)))
            }
        };
        let ends = |name: &Name, scan: usize| was_on(name, scan) && !scans[scan].contains(name);
        let begins_in =
            |name: &Name, scan: usize| !was_on(name, scan) && scans[scan].contains(name);
        let begins = |name: &Name| begins_in(name, last);
        let is_so = match ask {
            Ask::AtOnce { from, to } => ends(from, last) && begins(to),
            Ask::Together { from, to: [a, b] } => ends(from, last) && begins(a) && begins(b),
            Ask::InTurn { from, to } => {
                let before = last.checked_sub(1)?;
                if ends(from, before) && begins(to) {
                    return Some(before);
                }
                let is_on = scans[last].contains(to);
                ends(from, last) && begins_in(to, before) && is_on
            }
            Ask::Delayed { from, to } => {
                let ended = (0..last).rev().find(|scan| ends(from, *scan))?;
                let waits = scans[ended..last].iter().all(|it| it.is_empty());
                return (waits && begins(to)).then_some(ended);
            }
        };
        is_so.then_some(last)
    }
}
