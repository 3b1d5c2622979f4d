//! The variables of a program while a scan is followed in signals.

mod bitwise;
mod learning;
mod outside;
mod terms;
mod writing;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ladder::scan::{Names, bit_of_word};
use logic::{Datum, Name};
use proof::{Gates, Netlist, Signal};

use self::terms::is_nested;
use super::given::Given;
use super::knowledge::Knowledge;
use crate::domain::Kept;
use crate::inputs::{Inputs, Source};
use crate::ranges::Ranges;
use crate::refusal::Refusal;
use crate::value::Value;
use crate::word::Word;

/// A latch, and what it stands for.
struct Latched {
    variable: Name,
    kept: Kept,
    latch: Signal,
}

/// What stands for texts that depend on numbers that are not followed.
pub(crate) type Frees = HashMap<(String, Vec<usize>), Signal>;

/// What variables hold when a scan has ended.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub(super) values: BTreeMap<Name, Value>,
    pub(super) frees: Frees,
    pub(super) ranges: Ranges,
}

/// All variables at one point of a scan.
pub(super) struct Store<'k> {
    pub(super) net: Netlist,
    pub(super) inputs: Inputs,
    pub(super) names: &'k Names,
    given: &'k Given,
    knowledge: &'k mut Knowledge,
    now: BTreeMap<Name, Value>,
    kept: Vec<Latched>,
    /// The variables whose unknown value is the same throughout a run of scans'
    /// inputs, by the number of the unknown.
    outside: HashMap<usize, Name>,
    ranges: Ranges,
    unknowns: usize,
    /// The numbers of words that were too large to be computed with.
    large: HashMap<Word, usize>,
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
            ranges: Ranges::default(),
            unknowns: 0,
            large: HashMap::new(),
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
                    let is_followed = self.now.contains_key(&word);
                    self.knowledge.splits(&word, is_followed);
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
        let Some(domain) = self.knowledge.written.get(name) else {
            return self.given_from_outside(name);
        };
        let Some((value, latches)) = domain.begin(&mut self.net, name) else {
            return self.unknown();
        };
        let latches = latches.into_iter().map(|(kept, latch)| Latched {
            variable: name.clone(),
            kept,
            latch,
        });
        self.kept.extend(latches);
        value
    }

    /// Whether a name leads to one variable or bit of a word, whatever indices are.
    fn is_direct(&self, name: &str) -> bool {
        let word = bit_of_word(name).map_or(name, |(word, _)| word);
        self.names.is_stored(word)
    }

    /// Whether a variable is on.
    pub(super) fn is_on(&mut self, name: &str) -> Result<Signal, Refusal> {
        if name.contains('[') && !self.is_direct(name) {
            return self.is_any_on(name);
        }
        if let Some(value) = Datum::constant(name)
            && !self.is_written(name)
        {
            return Ok(Signal::constant(value.is_on()));
        }
        match self.key(name) {
            Key::Whole(name) => {
                self.is_looked_at_whole(&name);
                let value = self.load(&name);
                Ok(self.on(&value, &name))
            }
            Key::BitOf(word, bit) => {
                let value = self.load(&word);
                Ok(match (value.rounded(&mut self.net), value) {
                    (Some(word), _) => word.bit(bit),
                    (None, Value::Unknown(number)) => {
                        self.free(&format!("{word}.{bit}"), vec![number])
                    }
                    (None, _) => Signal::FALSE,
                })
            }
        }
    }

    /// Whether the variable is on that a name with variable indices leads to.
    fn is_any_on(&mut self, name: &str) -> Result<Signal, Refusal> {
        if is_nested(name) {
            return Err(Refusal::NestedIndex(name.into()));
        }
        let Some(targets) = self.targets(name) else {
            let unknown = self.unknown();
            return Ok(self.on(&unknown, name));
        };
        let mut all = Vec::with_capacity(targets.len());
        for (target, when) in targets {
            // Some names are not found; they are what they are called.
            let on = match self.is_direct(&target) || !target.contains('[') {
                true => self.is_on(&target)?,
                false => Signal::FALSE,
            };
            all.push(self.net.and(when, on));
        }
        Ok(self.net.any(&all))
    }

    /// The variables that a name with variable indices may lead to, and when. `None`
    /// if an index is not followed.
    fn targets(&mut self, name: &str) -> Option<Vec<(String, Signal)>> {
        let targets = self.branch(false, |store, stored| {
            store.names.resolved(name, stored).into_owned()
        });
        targets.ok()
    }

    /// When a value is on; free under this text if it is not followed.
    fn on(&mut self, value: &Value, text: &str) -> Signal {
        match (self.ranges.on(value, &mut self.net), value) {
            (Some(signal), _) => signal,
            (None, Value::Unknown(number)) => self.free(text, vec![*number]),
            (None, _) => Signal::FALSE,
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

    /// What everything holds now.
    pub(super) fn into_held(self) -> (Netlist, Inputs, Held) {
        let held = Held {
            values: self.now,
            frees: self.frees,
            ranges: self.ranges,
        };
        (self.net, self.inputs, held)
    }
}

/// What a name leads to.
enum Key {
    Whole(Name),
    /// A bit of a word that is looked at as a whole too.
    BitOf(Name, u32),
}
