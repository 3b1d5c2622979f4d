//! The variables of a program while a scan is followed in signals.

mod learning;
mod terms;

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use ladder::scan::{Kind, Names, bit_of_word};
use logic::{Datum, Name, Relation};
use proof::{Gates, Netlist, Signal};

use self::terms::is_nested;
use super::knowledge::Knowledge;
use crate::domain::Kept;
use crate::inputs::{Inputs, Source};
use crate::refusal::Refusal;
use crate::value::{MOST_VALUES, Value, applied, chosen, gathered};
use crate::word::Word;

/// A latch, and what it stands for.
struct Latched {
    variable: Name,
    kept: Kept,
    latch: Signal,
}

/// A number that is not followed but for the range that it is in.
#[derive(Clone, Debug)]
pub(crate) struct Ranged {
    /// A value for each range.
    value: Value,
    /// The constants that tell the ranges apart.
    compared: Vec<Datum>,
}

/// The ranges of numbers that are not followed, by the numbers of the unknowns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranges(HashMap<usize, Ranged>);

impl Ranges {
    fn insert(&mut self, unknown: usize, ranged: Ranged) {
        self.0.insert(unknown, ranged);
    }

    /// What can stand for a value where it is compared with this constant: a value
    /// for each range, if these tell apart what is needed.
    pub(crate) fn of(&self, value: &Value, constant: Datum) -> Option<&Value> {
        let Value::Unknown(number) = value else {
            return None;
        };
        let ranged = self.0.get(number)?;
        let mut compared = ranged.compared.iter();
        let is_told_apart = compared.any(|it| it.key() == constant.key());
        is_told_apart.then_some(&ranged.value)
    }

    /// When a value is on.
    pub(crate) fn on(&self, value: &Value, net: &mut Netlist) -> Option<Signal> {
        match self.of(value, Datum::Integer(0)) {
            Some(ranged) => ranged.on(net),
            None => value.on(net),
        }
    }

    /// When the relation holds between two values.
    pub(crate) fn compares(
        &self,
        net: &mut Netlist,
        [one, other]: [&Value; 2],
        relation: Relation,
    ) -> Option<Signal> {
        let constant = |value: &Value| match value.cases() {
            [(constant, _)] => Some(*constant),
            _ => None,
        };
        let ranged = |value, with| constant(with).and_then(|it| self.of(value, it));
        let sides = [
            ranged(one, other).unwrap_or(one),
            ranged(other, one).unwrap_or(other),
        ];
        sides[0].compares(net, relation, sides[1])
    }
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
    /// How many bits whole numbers have by their type, and whether the highest is
    /// a sign.
    pub(super) widths: HashMap<Name, (u32, bool)>,
}

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

    /// A variable that the program does not write.
    fn given_from_outside(&mut self, name: &Name) -> Value {
        let kind = self.names.kind(name);
        if let Some(value) = self.given.constants.get(name) {
            return Value::constant(*value);
        }
        if self.is_word_from_outside(name) {
            let (bits, is_signed) = self.given.widths.get(name).copied().unwrap_or((64, true));
            let word = self.inputs.word(&mut self.net, name, bits, is_signed);
            return Value::Word(word);
        }
        match self.knowledge.numbers.get(name) {
            Some(number) if kind != Some(Kind::Bool) => {
                let compared = &number.compared;
                let is_computed_with = number.is_computed_with;
                let ranged = (!compared.is_empty()).then(|| Ranged {
                    value: self.inputs.number(&mut self.net, name, kind, compared),
                    compared: compared.clone(),
                });
                match ranged {
                    Some(ranged) if !is_computed_with => ranged.value,
                    ranged => self.number_from_outside(name, ranged),
                }
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

    /// A number whose very value counts. What it is compared with tells in which
    /// range it is.
    fn number_from_outside(&mut self, name: &Name, ranged: Option<Ranged>) -> Value {
        self.unknowns += 1;
        self.outside.insert(self.unknowns, name.clone());
        if let Some(ranged) = ranged {
            self.ranges.insert(self.unknowns, ranged);
        }
        Value::Unknown(self.unknowns)
    }

    /// Whether no few values stand for a variable that the program does not write,
    /// but its bits do: it is looked at by these and as a whole, or a whole number
    /// that is copied or computed with.
    fn is_word_from_outside(&self, name: &Name) -> bool {
        let is_looked_at =
            || self.knowledge.whole.contains(name) && self.knowledge.split.contains(name);
        let number = self.knowledge.numbers.get(name);
        let is_computed_with = || number.is_some_and(|it| it.is_computed_with);
        let is_word = match self.names.kind(name) {
            Some(Kind::Integer) => is_looked_at() || is_computed_with(),
            None => is_looked_at(),
            Some(Kind::Bool | Kind::Real) => false,
        };
        is_word && !self.is_written(name)
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
        let Some(targets) = self.targets(name) else {
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
                let converted = self.converted(&name, value);
                let converted = match bit_of_word(&name) {
                    Some(_) => Value::bit(self.on(&converted, &name)),
                    None => converted,
                };
                (name, converted)
            }
            Key::BitOf(word, bit) => {
                self.knowledge.writes_bit(&word, bit);
                let changed = self.with_bit(&word, bit, value);
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

    /// A value turned into the declared type of a variable.
    fn converted(&mut self, name: &Name, value: &Value) -> Value {
        match (value, self.names.kind(name)) {
            (Value::Unknown(_), Some(Kind::Bool)) => return Value::bit(self.on(value, name)),
            // The nearest whole number may be another one.
            (Value::Unknown(number), Some(Kind::Integer)) => {
                let from = self.outside.get(number);
                return match from.and_then(|it| self.names.kind(it)) {
                    Some(Kind::Integer) => value.clone(),
                    _ => self.unknown(),
                };
            }
            (Value::Unknown(_), _) => return value.clone(),
            _ => {}
        }
        if let Value::Word(word) = value {
            match self.names.kind(name) {
                Some(Kind::Bool) => return Value::bit(word.on(&mut self.net)),
                Some(Kind::Integer) => return Value::Word(word.clone().number()),
                None => return value.clone(),
                Some(Kind::Real) => {}
            }
        }
        let Some(cases) = value.listed(&mut self.net) else {
            return self.unknown();
        };
        let cases = cases.iter();
        let cases = cases.map(|(value, when)| (self.names.converted(name, *value), *when));
        let cases = cases.collect();
        gathered(&mut self.net, cases)
    }

    /// What a word holds, with a bit changed.
    fn with_bit(&mut self, word: &Name, bit: u32, value: &Value) -> Value {
        let before = self.load(word);
        if let Value::Known(_) = before {
            let changed = applied(&mut self.net, &[&before, value], |both| {
                let rest = both[0].integer() & !(1 << bit);
                Datum::Integer(rest | i64::from(both[1].is_on()) << bit)
            });
            if let Some(changed) = changed {
                return changed;
            }
        }
        let on = self.on(value, &format!("{word}.{bit}"));
        match before.rounded(&mut self.net) {
            Some(word) => Value::Word(word.with(bit, on)),
            None => self.unknown(),
        }
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
