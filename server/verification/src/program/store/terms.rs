//! What comparisons and terms give: they are tried for each value that their
//! operands can have, and are free where one is a number that is not followed.

use std::cell::RefCell;

use ladder::scan::{Kind, is_plain};
use logic::{Datum, Expr, Name, Relation};
use proof::{Gates, Signal};

use super::{Key, Store};
use crate::refusal::Refusal;
use crate::value::{MOST_VALUES, Value, chosen, gathered};

/// Most combinations of values that one term or index is tried with.
const MOST_CASES: usize = 4_096;

/// Why something could not be computed for each value: an operand, or the
/// whole, is a number that is not followed.
#[derive(Debug)]
pub(super) struct Lost(Vec<usize>);

impl Store<'_> {
    /// Whether two operands, each a variable, constant or term, compare so.
    pub(in crate::program) fn compares(
        &mut self,
        left: &str,
        relation: Relation,
        right: &str,
    ) -> Result<Signal, Refusal> {
        self.note_comparison(left, right);
        self.note_comparison(right, left);
        let sides = [self.direct(left), self.direct(right)];
        if let [Some(one), Some(other)] = &sides
            && let Some(holds) = self.ranges.compares(&mut self.net, [one, other], relation)
        {
            return Ok(holds);
        }
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

    /// Notes that a variable from the plant is compared with a constant, or one that
    /// holds the number of such a variable now.
    fn note_comparison(&mut self, name: &str, with: &str) {
        let is_variable = is_plain(name) && Datum::constant(name).is_none();
        let Some(constant) = Datum::constant(with).filter(|_| is_variable) else {
            return;
        };
        let names = match self.is_direct(name) {
            true => vec![name.to_owned()],
            false if is_nested(name) => return,
            false => {
                let targets = self.targets(name).into_iter().flatten();
                targets.map(|(target, _)| target).collect()
            }
        };
        for name in names {
            if !self.is_direct(&name) {
                continue;
            }
            let Key::Whole(name) = self.key(&name) else {
                continue;
            };
            let of = match self.now.get(&name) {
                Some(Value::Unknown(number)) => self.outside.get(number).cloned(),
                _ => None,
            };
            let from = of.or_else(|| (!self.is_written(&name)).then_some(name));
            if let Some(from) = from {
                let is_followed = self.now.contains_key(&from);
                self.knowledge.compares(&from, constant, is_followed);
            }
        }
    }

    /// The value of an operand, which may be a term.
    pub(in crate::program) fn value_of(&mut self, text: &str) -> Result<Value, Refusal> {
        // What is copied as it is need not be tried value by value.
        if Datum::constant(text).is_none()
            && let Some(value) = self.direct(text)
        {
            return Ok(value);
        }
        self.computed(text, false, |store, stored| store.operand(text, stored))
    }

    /// The value of a constant, of a variable that is followed or on or off, or of words
    /// that are joined bit by bit: what need not be computed value by value. `None` of
    /// all else.
    pub(super) fn direct(&mut self, text: &str) -> Option<Value> {
        if let Some(value) = Datum::constant(text).filter(|_| !self.is_written(text)) {
            return Some(Value::constant(value));
        }
        if !is_plain(text) {
            return self.bitwise(text);
        }
        if !self.is_direct(text) {
            return self.indexed(text);
        }
        match self.key(text) {
            Key::BitOf(word, bit) => {
                let word = self.load(&word).rounded(&mut self.net)?;
                Some(Value::bit(word.bit(bit)))
            }
            Key::Whole(name) => {
                self.is_looked_at_whole(&name);
                let is_bit = self.names.kind(&name) == Some(Kind::Bool);
                let number = self.knowledge.numbers.get(&name);
                let is_number = number.is_some_and(|it| it.is_computed_with);
                let is_known = self.is_written(&name) || is_bit || is_number;
                match is_known || self.is_word_from_outside(&name) {
                    true => Some(self.load(&name)),
                    false => None,
                }
            }
        }
    }

    /// The value of a variable with variable indices, from those that these lead to.
    fn indexed(&mut self, text: &str) -> Option<Value> {
        if !text.contains('[') || is_nested(text) {
            return None;
        }
        let targets = self.targets(text)?;
        let mut value: Option<Value> = None;
        for (target, when) in targets {
            let own = match self.is_direct(&target) {
                true => self.direct(&target)?,
                false => return None,
            };
            value = Some(match value {
                None => own,
                Some(others) => chosen(&mut self.net, when, &own, &others)?,
            });
        }
        value.filter(|it| it.cases().len() <= MOST_VALUES)
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

    /// What a computation gives, for each value of what it reads.
    pub(in crate::program) fn computed(
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
    pub(super) fn branch<T>(
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
                value => {
                    let Some(cases) = value.listed(&mut self.net) else {
                        lost.push(self.number_of(&value));
                        let mut longer = chosen;
                        longer.push((name, Datum::default()));
                        open.push((longer, when));
                        continue;
                    };
                    for (value, also) in cases.iter().copied().rev() {
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

    /// The number of an unknown, or of a word too large to be tried value by value.
    fn number_of(&mut self, value: &Value) -> usize {
        let Value::Word(word) = value else {
            self.unknowns += 1;
            return self.unknowns;
        };
        if let Some(number) = self.large.get(word) {
            return *number;
        }
        self.unknowns += 1;
        self.large.insert(word.clone(), self.unknowns);
        self.unknowns
    }

    /// Notes that a variable is looked at as a number.
    fn looks_at(&mut self, name: &Name, is_simple: bool) {
        self.is_looked_at_whole(name);
        // A number that was not seen to be compared with constants alone.
        let is_simple = is_simple && self.knowledge.numbers.contains_key(name);
        if !self.is_written(name) && !is_simple {
            let is_followed = self.now.contains_key(name);
            self.knowledge.computes_with(name, is_followed);
        }
    }

    /// Notes that a variable is looked at as a whole.
    pub(super) fn is_looked_at_whole(&mut self, name: &Name) {
        if self.bits_of.contains(name) || self.knowledge.split.contains(name) {
            self.knowledge.looks_at_whole(name);
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
}

/// Whether an index stands within an index.
pub(super) fn is_nested(text: &str) -> bool {
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
