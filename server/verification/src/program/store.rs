//! The variables of a program while a scan is followed in signals.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use ladder::scan::{Kind, Names, bit_of_word, is_plain};
use logic::{Datum, Expr, Name, Relation};
use proof::{Gates, Netlist, Signal};

use super::Bounds;
use super::knowledge::{Domain, Knowledge};
use crate::inputs::{Inputs, Source};
use crate::refusal::Refusal;
use crate::value::{MOST_VALUES, Value, applied, chosen, gathered};

/// Most combinations of values that one term or index is tried with.
const MOST_CASES: usize = 4_096;

/// So many nodes are walked over in the time in which one is made.
const WALKED: usize = 16;

/// Why something could not be computed for each value: an operand, or the
/// whole, is a number that is not followed.
#[derive(Debug)]
pub(super) struct Lost(Vec<usize>);

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

    /// Whether a variable is on.
    pub(super) fn is_on(&mut self, name: &str) -> Result<Signal, Refusal> {
        if name.contains('[') && !self.names.is_stored(name) {
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

    /// Whether two operands, each a variable, constant or term, compare so.
    pub(super) fn compares(
        &mut self,
        left: &str,
        relation: Relation,
        right: &str,
    ) -> Result<Signal, Refusal> {
        self.note_comparison(left, right);
        self.note_comparison(right, left);
        let is_simple = match (Datum::constant(left), Datum::constant(right)) {
            (None, None) => false,
            _ => is_plain(left) && is_plain(right),
        };
        let tried = self.branch(is_simple, |store, stored| {
            let one = store.operand(left, stored);
            let other = store.operand(right, stored);
            one.compares(relation, other).into()
        });
        match tried {
            Ok(cases) => {
                let value = gathered(&mut self.net, cases);
                Ok(value.on(&mut self.net).unwrap_or(Signal::FALSE))
            }
            Err(Lost(unknowns)) => {
                // The canonical form: a comparison and its opposite are one.
                match Expr::comparison(left, relation, right) {
                    Expr::Constant(value) => Ok(Signal::constant(value)),
                    Expr::Not(inner) => {
                        let text = inner.to_string();
                        Ok(!self.free(&text, unknowns))
                    }
                    atom => {
                        let text = atom.to_string();
                        Ok(self.free(&text, unknowns))
                    }
                }
            }
        }
    }

    fn note_comparison(&mut self, name: &str, with: &str) {
        let is_variable = is_plain(name) && Datum::constant(name).is_none() && !name.contains('[');
        if let (true, Some(constant)) = (is_variable, Datum::constant(with))
            && let Key::Whole(name) = self.key(name)
            && !self.is_written(&name)
        {
            self.knowledge.compares(&name, constant);
        }
    }

    /// The value of an operand, which may be a term.
    pub(super) fn value_of(&mut self, text: &str) -> Result<Value, Refusal> {
        if is_plain(text) && !text.contains('[') && Datum::constant(text).is_none() {
            // What is copied as it is need not be tried value by value.
            if let Key::Whole(name) = self.key(text)
                && (self.is_written(&name) || self.names.kind(&name) == Some(Kind::Bool))
            {
                return Ok(self.load(&name));
            }
        }
        self.computed(text, false, |store, stored| store.operand(text, stored))
    }

    /// The value of the machine's operand: a term that cannot be computed is a
    /// variable by the name of its text.
    fn operand(&self, text: &str, stored: &ladder::scan::Stored<'_>) -> Datum {
        let whole = |name: &str| match is_plain(name) {
            true => stored(name),
            false => None,
        };
        if is_plain(text) {
            return self.names.read(text, stored);
        }
        match self.names.compute(text, &whole) {
            Some(value) => value,
            None => self.names.read(text, stored),
        }
    }

    fn read(&self, name: &str, stored: &ladder::scan::Stored<'_>) -> Datum {
        self.names.read(name, stored)
    }

    /// What a computation gives, for each value of what it reads.
    pub(super) fn computed(
        &mut self,
        text: &str,
        is_simple: bool,
        compute: impl Fn(&Self, &ladder::scan::Stored<'_>) -> Datum,
    ) -> Result<Value, Refusal> {
        if text.matches('[').count() > 1 && is_nested(text) {
            return Err(Refusal::NestedIndex(text.into()));
        }
        if !is_plain(text) && (self.is_written(text) || self.is_given(text)) {
            return Err(Refusal::AmbiguousTerm(text.into()));
        }
        match self.branch(is_simple, compute) {
            Ok(cases) => {
                let value = gathered(&mut self.net, cases);
                match value.cases().len() {
                    0..=MOST_VALUES => Ok(value),
                    _ => Ok(self.unknown()),
                }
            }
            Err(Lost(_)) => Ok(self.unknown()),
        }
    }

    /// Runs a computation for every combination of the values that it asks for.
    fn branch<T>(
        &mut self,
        is_simple: bool,
        compute: impl Fn(&Self, &ladder::scan::Stored<'_>) -> T,
    ) -> Result<Vec<(T, Signal)>, Lost> {
        let mut open: Vec<(Vec<(Name, Datum)>, Signal)> = vec![(Vec::new(), Signal::TRUE)];
        let mut done = Vec::new();
        let mut lost = Vec::new();
        let mut tried = 0;
        while let Some((chosen, when)) = open.pop() {
            tried += 1;
            self.tried += 1;
            if tried > MOST_CASES {
                self.unknowns += 1;
                return Err(Lost(vec![self.unknowns]));
            }
            let missing: RefCell<Option<Name>> = RefCell::new(None);
            let result = compute(self, &|name| {
                if !self.names.is_stored(name) {
                    return None;
                }
                let known = chosen.iter().find(|(it, _)| **it == *name);
                if known.is_none() {
                    missing.borrow_mut().get_or_insert_with(|| name.into());
                }
                Some(known.map_or_else(Datum::default, |(_, value)| *value))
            });
            let Some(name) = missing.into_inner() else {
                done.push((result, when));
                continue;
            };
            self.looks_at(&name, is_simple);
            match self.load(&name) {
                Value::Unknown(number) => {
                    // Other operands may be unknown too: they all matter.
                    lost.push(number);
                    let mut longer = chosen;
                    longer.push((name, Datum::default()));
                    open.push((longer, when));
                }
                Value::Known(cases) => {
                    for (value, also) in cases.into_iter().rev() {
                        let when = self.net.and(when, also);
                        if when != Signal::FALSE {
                            let mut longer = chosen.clone();
                            longer.push((name.clone(), value));
                            open.push((longer, when));
                        }
                    }
                }
            }
        }
        lost.sort_unstable();
        lost.dedup();
        match lost.is_empty() {
            true => Ok(done),
            false => Err(Lost(lost)),
        }
    }

    /// Notes that a variable is looked at as a number.
    fn looks_at(&mut self, name: &Name, is_simple: bool) {
        if self.bits_of.contains(name) {
            self.knowledge.looks_at_whole(name);
        }
        if !self.is_written(name) && !is_simple {
            self.knowledge.computes_with(name);
        }
        self.knowledge_of_whole(name);
    }

    /// A word is looked at as a whole; should its bits be looked at later in
    /// the scan, the next pass must know.
    fn knowledge_of_whole(&mut self, name: &Name) {
        let prefix = format!("{name}.");
        let mut bits = self.now.range(Name::from(&*prefix)..);
        let is_bit = bits.next().is_some_and(|(it, _)| {
            it.strip_prefix(&*prefix)
                .is_some_and(|bit| bit.bytes().all(|b| b.is_ascii_digit()))
        });
        if is_bit {
            self.knowledge.looks_at_whole(name);
        }
    }

    /// Gives a variable a value under a condition.
    pub(super) fn write(&mut self, name: &str, value: &Value, when: Signal) -> Result<(), Refusal> {
        if !name.contains('[') || self.names.is_stored(name) {
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

    fn note_write(&mut self, name: &Name, value: &Value) {
        let is_new = !self.is_written(name);
        let initial = self.initially(name);
        self.knowledge.writes(name, initial);
        if self.bits_of.contains(name) {
            self.knowledge.looks_at_whole(name);
        }
        self.knowledge_of_whole(name);
        // What is written in one stroke can be had: the rest is found by
        // following the scan.
        if is_new {
            for (value, _) in value.cases() {
                self.knowledge.holds(name, *value);
            }
        }
    }

    /// Notes that something else than a timer or counter writes the variable.
    pub(super) fn note_by_hand(&mut self, name: &str) {
        let name = self.names.resolved(name, &|_| None).into_owned();
        self.knowledge.writes_by_hand(&name.into());
    }

    /// Ends the scan: what variables hold is what the next one begins with.
    pub(super) fn end(&mut self, bounds: &Bounds) -> Result<(), Refusal> {
        for Kept {
            variable,
            value,
            latch,
        } in std::mem::take(&mut self.kept)
        {
            let after = self.now.get(&variable);
            let mut cases = after.map_or(&[][..], Value::cases).iter();
            let next = cases.find(|(it, _)| it.key() == value.key());
            let next = next.map_or(Signal::FALSE, |(_, when)| *when);
            self.net.set_next(latch, next);
            self.kept.push(Kept {
                variable,
                value,
                latch,
            });
        }
        let written: Vec<Name> = self.knowledge.written.keys().cloned().collect();
        for name in written {
            match self.now.get(&name).cloned() {
                Some(Value::Unknown(_)) => self.knowledge.loses(&name),
                Some(Value::Known(cases)) => self.note_values(&name, &cases, bounds)?,
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

fn is_nested(text: &str) -> bool {
    let mut open = 0_usize;
    text.chars().any(|c| {
        match c {
            '[' => open += 1,
            ']' => open = open.saturating_sub(1),
            _ => {}
        }
        open > 1
    })
}
