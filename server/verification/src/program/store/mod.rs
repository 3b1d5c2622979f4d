//! The variables of a program while a scan is followed in signals.

mod learning;
mod terms;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use ladder::scan::{Kind, Names, bit_of_word};
use logic::{Datum, Name};
use proof::{Gates, Netlist, Signal};

use self::terms::is_nested;
use super::knowledge::{Domain, Knowledge};
use crate::inputs::{Inputs, Source};
use crate::refusal::Refusal;
use crate::value::{MOST_VALUES, Value, applied, chosen, gathered};

/// A latch that stands for one value of a variable.
struct Kept {
    variable: Name,
    value: Datum,
    latch: Signal,
}

/// What stands for texts that depend on numbers that are not followed.
pub(crate) type Frees = HashMap<(String, Vec<usize>), Signal>;

/// What the program says before anything is followed.
#[derive(Debug, Default)]
pub(super) struct Given {
    /// Values before the first scan; all others are 0.
    pub(super) initial: HashMap<Name, Datum>,
    /// What is declared never to change.
    pub(super) constants: HashMap<Name, Datum>,
    /// Instances that timers or counters of different kinds share.
    pub(super) mixed: HashSet<Name>,
}

/// All variables at one point of a scan.
pub(super) struct Store<'k> {
    pub(super) net: Netlist,
    pub(super) inputs: Inputs,
    pub(super) names: &'k Names,
    given: &'k Given,
    knowledge: &'k mut Knowledge,
    now: BTreeMap<Name, Value>,
    kept: Vec<Kept>,
    /// The variables whose unknown value is the same throughout a run of scans'
    /// inputs, by the number of the unknown.
    outside: HashMap<usize, Name>,
    unknowns: usize,
    bits_of: BTreeSet<Name>,
    /// Names for what is free and is no variable.
    frees: Frees,
    /// Cases that were tried.
    pub(super) tried: usize,
}

impl<'k> Store<'k> {
    pub(super) fn new(names: &'k Names, given: &'k Given, knowledge: &'k mut Knowledge) -> Self {
        Self {
            net: Netlist::default(),
            inputs: Inputs::default(),
            names,
            given,
            knowledge,
            now: BTreeMap::new(),
            kept: Vec::new(),
            outside: HashMap::new(),
            unknowns: 0,
            bits_of: BTreeSet::new(),
            frees: HashMap::new(),
            tried: 0,
        }
    }

    /// A number that is not followed from here on.
    pub(super) fn unknown(&mut self) -> Value {
        self.unknowns += 1;
        Value::Unknown(self.unknowns)
    }

    /// What a variable holds before the first scan.
    pub(super) fn initially(&self, name: &str) -> Datum {
        match self.given.initial.get(name) {
            Some(value) => *value,
            None => bit_of_word(name)
                .and_then(|(word, bit)| {
                    let word = self.given.initial.get(word)?.integer();
                    Some(Datum::Bool(word >> bit & 1 == 1))
                })
                .unwrap_or_default(),
        }
    }

    /// Whether anything is known to be stored under the name before the first
    /// scan.
    pub(super) fn is_given(&self, name: &str) -> bool {
        self.given.initial.contains_key(name)
    }

    /// Whether timers or counters of different kinds share the instance.
    pub(super) fn is_mixed(&self, instance: &str) -> bool {
        self.given.mixed.contains(instance)
    }

    /// Whether the program writes the variable.
    pub(super) fn is_written(&self, name: &str) -> bool {
        self.knowledge.written.contains_key(name)
    }

    /// Whether something else than timers and counters writes the variable.
    pub(super) fn is_written_by_hand(&self, name: &str) -> bool {
        self.knowledge.by_hand.contains(name)
    }

    /// The variable that a name without variable indices leads to: a word whose
    /// bits alone are looked at is as many variables.
    fn key(&mut self, name: &str) -> Key {
        let resolved = self.names.resolved(name, &|_| None).into_owned();
        match bit_of_word(&resolved) {
            Some((word, bit)) => {
                let word: Name = word.into();
                if self.knowledge.whole.contains(&word) {
                    return Key::BitOf(word, bit);
                }
                if self.now.contains_key(&word) {
                    self.knowledge.looks_at_whole(&word);
                }
                self.bits_of.insert(word);
                Key::Whole(resolved.into())
            }
            None => Key::Whole(resolved.into()),
        }
    }

    /// What is stored under a very name, now.
    pub(super) fn load(&mut self, name: &Name) -> Value {
        if let Some(value) = self.now.get(name) {
            return value.clone();
        }
        let value = self.begin(name);
        self.now.insert(name.clone(), value.clone());
        value
    }

    /// What is stored under a very name when the scan begins.
    fn begin(&mut self, name: &Name) -> Value {
        let domain = self.knowledge.written.get(name).cloned();
        let values = match domain {
            Some(Domain::Values(values)) => values,
            Some(Domain::Unknown) => return self.unknown(),
            None => return self.given_from_outside(name),
        };
        let keep = |store: &mut Self, value: Datum, latch: Signal| {
            let variable = name.clone();
            let kept = Kept {
                variable,
                value,
                latch,
            };
            store.kept.push(kept);
        };
        match values.as_slice() {
            [value] => Value::constant(*value),
            [Datum::Bool(initial), Datum::Bool(_)] => {
                let latch = self.net.latch(name.clone(), *initial);
                keep(self, true.into(), latch);
                Value::bit(latch)
            }
            _ => {
                let mut cases = Vec::new();
                for (at, value) in values.iter().enumerate() {
                    let latch = self.net.latch(format!("{name}={value}"), at == 0);
                    keep(self, *value, latch);
                    cases.push((*value, latch));
                }
                gathered(&mut self.net, cases)
            }
        }
    }

    /// A variable that the program does not write.
    fn given_from_outside(&mut self, name: &Name) -> Value {
        let kind = self.names.kind(name);
        if let Some(value) = self.given.constants.get(name) {
            return Value::constant(*value);
        }
        let numbers = self.knowledge.numbers.get(name).cloned();
        match numbers {
            Some(Some(compared)) if kind != Some(Kind::Bool) => {
                self.inputs.number(&mut self.net, name, kind, &compared)
            }
            Some(None) if kind != Some(Kind::Bool) => {
                let value = self.unknown();
                if let Value::Unknown(number) = value {
                    self.outside.insert(number, name.clone());
                }
                value
            }
            _ => {
                let on = self.inputs.bit(&mut self.net, name);
                let cases = [(false, !on), (true, on)];
                let cases =
                    cases.map(|(is_on, when)| (self.names.converted(name, is_on.into()), when));
                gathered(&mut self.net, cases.into())
            }
        }
    }

    /// Whether a name leads to one variable or bit of a word, whatever indices are.
    fn is_direct(&self, name: &str) -> bool {
        let word = bit_of_word(name).map_or(name, |(word, _)| word);
        self.names.is_stored(word)
    }

    /// Whether a variable is on.
    pub(super) fn is_on(&mut self, name: &str) -> Result<Signal, Refusal> {
        if name.contains('[') && !self.is_direct(name) {
            let value = self.computed(name, false, |store, stored| store.read(name, stored))?;
            return Ok(self.when(&value, name, Datum::is_on));
        }
        if let Some(value) = Datum::constant(name)
            && !self.is_written(name)
        {
            return Ok(Signal::constant(value.is_on()));
        }
        match self.key(name) {
            Key::Whole(name) => {
                let value = self.load(&name);
                Ok(self.when(&value, &name, Datum::is_on))
            }
            Key::BitOf(word, bit) => {
                let value = self.load(&word);
                let is_on = |value: Datum| value.integer() >> bit & 1 == 1;
                Ok(self.when(&value, &format!("{word}.{bit}"), is_on))
            }
        }
    }

    /// When a value is one that `holds` picks; free under this text if the
    /// value is not followed.
    fn when(&mut self, value: &Value, text: &str, holds: impl Fn(Datum) -> bool) -> Signal {
        match (value.when(&mut self.net, holds), value) {
            (Some(signal), _) => signal,
            (None, Value::Unknown(number)) => self.free(text, vec![*number]),
            (None, Value::Known(_)) => Signal::FALSE,
        }
    }

    /// Something that is free while these unknown numbers are what they are.
    fn free(&mut self, text: &str, unknowns: Vec<usize>) -> Signal {
        let is_outside = unknowns.iter().all(|it| self.outside.contains_key(it));
        let key = (text.to_owned(), unknowns);
        if let Some(known) = self.frees.get(&key) {
            return *known;
        }
        let name = match is_outside {
            true => text.to_owned(),
            false => format!("{text} #{}", self.frees.len() + 1),
        };
        let source = Source::Opaque(text.into());
        let signal = self.inputs.free(&mut self.net, &name, source);
        self.frees.insert(key, signal);
        signal
    }

    /// An event that time or numbers decide; a new one each time.
    pub(super) fn event(&mut self, of: &Name, what: &str) -> Signal {
        let mut name = format!("{of} {what}");
        let taken = |net: &Netlist, name: &str| net.inputs().iter().any(|it| *it.name == *name);
        for nth in 2.. {
            if !taken(&self.net, &name) {
                break;
            }
            name = format!("{of} {what} ({nth})");
        }
        let source = Source::Event(of.clone());
        self.inputs.free(&mut self.net, &name, source)
    }

    /// Gives a variable a value under a condition.
    pub(super) fn write(&mut self, name: &str, value: &Value, when: Signal) -> Result<(), Refusal> {
        if !name.contains('[') || self.is_direct(name) {
            let key = self.key(name);
            self.put(key, value, when);
            return Ok(());
        }
        if is_nested(name) {
            return Err(Refusal::NestedIndex(name.into()));
        }
        let targets = self.branch(false, |store, stored| {
            store.names.resolved(name, stored).into_owned()
        });
        let Ok(targets) = targets else {
            return Err(Refusal::UnknownTarget(name.into()));
        };
        for (target, also) in targets {
            let when = self.net.and(when, also);
            let key = self.key(&target);
            self.put(key, value, when);
        }
        Ok(())
    }

    fn put(&mut self, key: Key, value: &Value, when: Signal) {
        let (name, value) = match key {
            Key::Whole(name) => {
                let converted = match value {
                    Value::Known(cases) => {
                        let cases = cases.iter();
                        let cases =
                            cases.map(|(value, when)| (self.names.converted(&name, *value), *when));
                        let cases = cases.collect();
                        gathered(&mut self.net, cases)
                    }
                    unknown => unknown.clone(),
                };
                let bit = bit_of_word(&name).is_some();
                let converted = match bit {
                    true => Value::bit(self.when(&converted, &name, Datum::is_on)),
                    false => converted,
                };
                (name, converted)
            }
            Key::BitOf(word, bit) => {
                let before = self.load(&word);
                let changed = applied(&mut self.net, &[&before, value], |both| {
                    let rest = both[0].integer() & !(1 << bit);
                    Datum::Integer(rest | i64::from(both[1].is_on()) << bit)
                });
                let changed = changed.unwrap_or_else(|| self.unknown());
                (word, changed)
            }
        };
        self.note_write(&name, &value);
        let before = self.load(&name);
        let after = chosen(&mut self.net, when, &value, &before);
        let after = match after {
            Some(after) if after.cases().len() <= MOST_VALUES => after,
            _ => self.unknown(),
        };
        self.now.insert(name, after);
    }

    /// What everything holds now.
    pub(super) fn into_values(self) -> (Netlist, Inputs, BTreeMap<Name, Value>, Frees) {
        (self.net, self.inputs, self.now, self.frees)
    }
}

/// What a name leads to.
enum Key {
    Whole(Name),
    /// A bit of a word that is looked at as a whole too.
    BitOf(Name, u32),
}
