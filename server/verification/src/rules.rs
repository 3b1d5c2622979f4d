//! Environment rules and properties as signals.
//!
//! Plain names of a rule with `@` are values of the step before, inputs as
//! latched and outputs as the ladder published them; names under `@`, and those
//! of rules without, are values of this step. Before the first step everything
//! counts as 0.

use std::collections::HashMap;

use grafcet::{EnvironmentRule, Property, is_in_next_scan};
use logic::{Atom, Datum, Expr, Name};
use proof::{Gates, Netlist, Signal};

use crate::chart::Evolved;
use crate::frame::Frame;
use crate::program::Followed;
use crate::refusal::Refusal;
use crate::value::Value;

/// The atoms of rules and properties, at the end of a scan.
pub(crate) struct Atoms<'s> {
    ladder: &'s Followed,
    evolved: &'s mut Evolved,
    known: HashMap<Atom, Signal>,
}

impl<'s> Atoms<'s> {
    /// Atoms of this ladder and the grafcet beside it.
    pub(crate) fn new(ladder: &'s Followed, evolved: &'s mut Evolved) -> Self {
        Self {
            ladder,
            evolved,
            known: HashMap::new(),
        }
    }

    /// Looks up all atoms of a rule.
    pub(crate) fn look_up_rule(&mut self, rule: &EnvironmentRule) -> Result<(), Refusal> {
        if !speaks_of_next(&rule.right) {
            let names = names_of(&rule.left)
                .into_iter()
                .chain(names_of(&rule.right));
            if let Some(name) = { names }.find(|name| self.ladder.writes(name)) {
                return Err(Refusal::RuleAboutOutput(rule.name.clone(), name));
            }
        }
        self.look_up(&rule.left, &rule.name)?;
        self.look_up(&rule.right, &rule.name)
    }

    /// Looks up all atoms of a property.
    pub(crate) fn look_up_property(&mut self, property: &Property) -> Result<(), Refusal> {
        self.look_up(&property.condition, &property.name)
    }

    fn look_up(&mut self, expr: &Expr, label: &Name) -> Result<(), Refusal> {
        match expr {
            Expr::Constant(_) => Ok(()),
            Expr::Not(inner) => self.look_up(inner, label),
            Expr::And(parts) | Expr::Or(parts) => {
                parts.iter().try_for_each(|part| self.look_up(part, label))
            }
            Expr::Atom(Atom::Rise(inner) | Atom::Fall(inner)) => self.look_up(inner, label),
            Expr::Atom(Atom::Elapsed { .. }) => Err(Refusal::RuleAboutTime(label.clone())),
            Expr::Atom(atom @ Atom::Variable(name)) => {
                let value = self.value(plain(name));
                let on = self.ladder.ranges().on(&value, &mut self.evolved.netlist);
                self.know(atom, on, label)
            }
            Expr::Atom(atom @ Atom::Comparison(it)) => {
                let sides = [&it.left, &it.right].map(|side| match Datum::constant(side) {
                    Some(value) => Value::constant(value),
                    None => self.value(plain(side)),
                });
                let net = &mut self.evolved.netlist;
                let ranges = self.ladder.ranges();
                let on = ranges.compares(net, [&sides[0], &sides[1]], it.relation);
                self.know(atom, on, label)
            }
        }
    }

    fn know(&mut self, atom: &Atom, on: Option<Signal>, label: &Name) -> Result<(), Refusal> {
        let on = on.ok_or_else(|| Refusal::RuleAboutNumber(label.clone()))?;
        self.known.insert(atom.clone(), on);
        Ok(())
    }

    /// A variable of the ladder, else of the grafcet, else a step, else a free
    /// one.
    fn value(&mut self, name: &str) -> Value {
        if self.ladder.looks_at(name)
            && let Some(value) = self.ladder.output(name, &mut self.evolved.netlist)
        {
            return value;
        }
        if let Some(value) = self.evolved.value(name) {
            return value.clone();
        }
        let mut steps = self.evolved.active.iter();
        if let Some((_, active)) = steps.find(|(step, _)| **step == *name) {
            return Value::bit(*active);
        }
        let evolved = &mut *self.evolved;
        Value::bit(evolved.inputs.bit(&mut evolved.netlist, &name.into()))
    }

    /// What was looked up.
    pub(crate) fn known(self) -> HashMap<Atom, Signal> {
        self.known
    }
}

fn plain(name: &str) -> &str {
    is_in_next_scan(name).unwrap_or(name)
}

fn names_in(expr: &Expr, names: &mut Vec<Name>) {
    match expr {
        Expr::Constant(_) => {}
        Expr::Not(inner) => names_in(inner, names),
        Expr::And(parts) | Expr::Or(parts) => parts.iter().for_each(|it| names_in(it, names)),
        Expr::Atom(Atom::Rise(inner) | Atom::Fall(inner)) => names_in(inner, names),
        Expr::Atom(Atom::Variable(name)) => names.push(name.clone()),
        Expr::Atom(Atom::Comparison(it)) => names.extend([it.left.clone(), it.right.clone()]),
        Expr::Atom(Atom::Elapsed { step, .. }) => names.push(step.clone()),
    }
}

/// The variables that an expression names.
pub(crate) fn names_of(expr: &Expr) -> Vec<Name> {
    let mut names = Vec::new();
    names_in(expr, &mut names);
    names
}

fn speaks_of_next(expr: &Expr) -> bool {
    let names = names_of(expr);
    names.iter().any(|name| is_in_next_scan(name).is_some())
}

/// Builds rules and properties over the steps of a frame.
pub(crate) struct Steps<'f> {
    pub(crate) frame: &'f mut Frame,
    pub(crate) atoms: HashMap<Atom, Signal>,
}

impl Steps<'_> {
    /// That the environment obeys a rule.
    pub(crate) fn rule(&mut self, rule: &EnvironmentRule) -> Signal {
        let is_about_two = speaks_of_next(&rule.right);
        let left = self.signal(&rule.left, is_about_two);
        let right = self.signal(&rule.right, is_about_two);
        self.frame.netlist.implies(left, right)
    }

    /// That a property is violated.
    pub(crate) fn property(&mut self, property: &Property) -> Signal {
        self.signal(&property.condition, false)
    }

    /// An expression in this step, its plain names in the one before if asked.
    fn signal(&mut self, expr: &Expr, is_before: bool) -> Signal {
        match expr {
            Expr::Constant(value) => Signal::constant(*value),
            Expr::Not(inner) => !self.signal(inner, is_before),
            Expr::And(parts) => {
                let parts: Vec<Signal> =
                    parts.iter().map(|it| self.signal(it, is_before)).collect();
                self.net().all(&parts)
            }
            Expr::Or(parts) => {
                let parts: Vec<Signal> =
                    parts.iter().map(|it| self.signal(it, is_before)).collect();
                self.net().any(&parts)
            }
            Expr::Atom(Atom::Rise(inner)) => {
                let now = self.signal(inner, is_before);
                let before = self.net().delayed("edge of a rule", now, at_zero(inner));
                self.net().and(now, !before)
            }
            Expr::Atom(Atom::Fall(inner)) => {
                let now = self.signal(inner, is_before);
                let before = self.net().delayed("edge of a rule", now, at_zero(inner));
                self.net().and(before, !now)
            }
            Expr::Atom(atom) => {
                let known = self.atoms.get(atom).copied().unwrap_or(Signal::FALSE);
                let now = self.frame.of(known);
                let is_marked = match atom {
                    Atom::Variable(name) => is_in_next_scan(name).is_some(),
                    Atom::Comparison(it) => [&it.left, &it.right]
                        .iter()
                        .any(|it| is_in_next_scan(it).is_some()),
                    _ => false,
                };
                match is_before && !is_marked {
                    true => self.net().delayed(
                        format!("{} before", Expr::Atom(atom.clone())),
                        now,
                        at_zero(expr),
                    ),
                    false => now,
                }
            }
        }
    }

    fn net(&mut self) -> &mut Netlist {
        &mut self.frame.netlist
    }
}

/// What an expression is where everything is 0.
fn at_zero(expr: &Expr) -> bool {
    match expr {
        Expr::Constant(value) => *value,
        Expr::Not(inner) => !at_zero(inner),
        Expr::And(parts) => parts.iter().all(at_zero),
        Expr::Or(parts) => parts.iter().any(at_zero),
        Expr::Atom(Atom::Comparison(it)) => {
            let value = |side: &Name| Datum::constant(side).unwrap_or_default();
            value(&it.left).compares(it.relation, value(&it.right))
        }
        Expr::Atom(_) => false,
    }
}
