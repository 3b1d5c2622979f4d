//! What a pass finds out about the values that variables can have.

use logic::{Datum, Name};
use proof::Signal;

use super::{Latched, Store};
use crate::domain::Domain;
use crate::program::Bounds;
use crate::refusal::Refusal;
use crate::value::Value;

/// So many nodes are walked over in the time in which one is made.
const WALKED: usize = 16;

impl Store<'_> {
    pub(super) fn note_write(&mut self, name: &Name, value: &Value) {
        let is_new = !self.is_written(name);
        let initial = self.initially(name);
        let is_followed = self.now.contains_key(name);
        self.knowledge.writes(name, initial, is_followed);
        self.is_looked_at_whole(name);
        // What is written in one stroke can be had: the rest is found by
        // following the scan.
        if is_new {
            for (value, _) in value.cases() {
                self.knowledge.holds(name, *value);
            }
        }
    }

    /// Notes that something else than a timer or counter writes the variable.
    pub(in crate::program) fn note_by_hand(&mut self, name: &str) {
        let name = self.names.resolved(name, &|_| None).into_owned();
        self.knowledge.writes_by_hand(&name.into());
    }

    /// Ends the scan: what variables hold is what the next one begins with.
    pub(in crate::program) fn end(&mut self, bounds: &Bounds) -> Result<(), Refusal> {
        let written: Vec<Name> = self.knowledge.written.keys().cloned().collect();
        for name in &written {
            // Its bits are asked for one by one.
            if let (Some(Domain::Word(_)), Some(value)) =
                (self.knowledge.written.get(name), self.now.get(name))
                && let Some(word) = value.word(&mut self.net)
            {
                self.now.insert(name.clone(), Value::Word(word));
            }
        }
        for Latched {
            variable,
            kept,
            latch,
        } in &self.kept
        {
            let after = self.now.get(variable);
            let next = after.map(|value| kept.next(value, &mut self.net));
            self.net.set_next(*latch, next.unwrap_or(Signal::FALSE));
        }
        if self.knowledge.has_learnt_uses() {
            return Ok(());
        }
        for name in written {
            match self.now.get(&name).cloned() {
                Some(Value::Unknown(_)) => self.knowledge.loses(&name),
                Some(Value::Word(word)) => self.knowledge.widens(&name, &word),
                // A word whose values have a fraction now.
                Some(Value::Known(cases)) => match self.knowledge.written.get(&name) {
                    Some(Domain::Word(_)) => self.knowledge.loses(&name),
                    _ => self.note_values(&name, &cases, bounds)?,
                },
                None => {}
            }
        }
        Ok(())
    }

    /// Notes the values that a variable can have at the end of a scan, for each
    /// that it can have at its beginning: a step register goes on from one step
    /// to the next, and only as far as its rungs say.
    fn note_values(
        &mut self,
        name: &Name,
        cases: &[(Datum, Signal)],
        bounds: &Bounds,
    ) -> Result<(), Refusal> {
        let domain = match self.knowledge.written.get(name) {
            Some(Domain::Values(values)) => values.clone(),
            _ => return Ok(()),
        };
        let is_new = |value: &Datum| domain.iter().all(|known| known.key() != value.key());
        let new = cases.iter().filter(|(value, _)| is_new(value));
        let mut new: Vec<(Datum, Signal)> = new.copied().collect();
        let is_bit = |value: &Datum| matches!(value, Datum::Bool(_));
        if !new.iter().all(|(value, _)| is_bit(value)) && domain.len() > 1 {
            self.keep_possible(name, &mut new, bounds)?;
        }
        if !new.is_empty() {
            self.knowledge.grows(name);
        }
        for (value, _) in new {
            self.knowledge.holds(name, value);
        }
        Ok(())
    }

    /// Keeps the cases that are not plainly impossible for every value that the
    /// variable can have when the scan begins.
    fn keep_possible(
        &mut self,
        name: &Name,
        cases: &mut Vec<(Datum, Signal)>,
        bounds: &Bounds,
    ) -> Result<(), Refusal> {
        let own = self.kept.iter().filter(|it| it.variable == *name);
        let own: Vec<Signal> = own.map(|it| it.latch).collect();
        let mut is_possible = vec![false; cases.len()];
        for chosen in &own {
            bounds.look(&self.net)?;
            self.tried += self.net.size() / WALKED;
            let leaves = own.iter().map(|latch| (*latch, latch == chosen));
            let known = self.net.suppose(leaves);
            for ((_, when), possible) in cases.iter().zip(&mut is_possible) {
                *possible |= known.of(*when) != Some(false);
            }
        }
        let mut possible = is_possible.into_iter();
        cases.retain(|_| possible.next().unwrap_or(true));
        Ok(())
    }
}
