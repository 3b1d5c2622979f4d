//! A ladder's machine and its translation on the same inputs.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::AddAssign;
use std::sync::Arc;

use ladder::scan::Machine;
use ladder::{ElementKind, Program, TimerKind};
use logic::{Datum, Name};
use proof::{Netlist, Signal, Touched, Trace, replay};
use verification::inputs::Source;
use verification::program::{Bounds, Followed, follow};

use crate::random::Random;

/// How many values were compared, and how many of them changed at some time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compared {
    pub values: usize,
    pub variables: usize,
    pub changing: usize,
    /// Variables that depend on what is not followed.
    pub left_out: usize,
}

impl AddAssign for Compared {
    fn add_assign(&mut self, other: Self) {
        self.values += other.values;
        self.variables += other.variables;
        self.changing += other.changing;
        self.left_out += other.left_out;
    }
}

/// The program of a text without errors.
pub fn program(text: &str) -> Arc<Program> {
    let reading = ladder::read(text.as_bytes());
    let mut found = reading.diagnostics.iter();
    let error = found.find(|it| it.severity == source::Severity::Error);
    assert!(error.is_none(), "{error:?}\n{text}");
    reading.program
}

/// Compares the ladder of a text with its translation; shows the text if they
/// differ.
pub fn compare_text(text: &str, scans: usize, random: &mut Random) -> Compared {
    let program = program(text);
    let followed = follow(&program, None, &Bounds::default())
        .unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
    let compared = || compare(&program, &followed, scans, random);
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(compared))
        .unwrap_or_else(|_| panic!("{text}"))
}

/// How the event of an instance follows from what the machine shows after the
/// scan. None where it is solved in several places, reset, or written by hand:
/// then what it was in between cannot be seen.
fn events(program: &Program) -> BTreeMap<Name, Option<TimerKind>> {
    let mut places: BTreeMap<Name, (usize, Option<TimerKind>)> = BTreeMap::new();
    let mut disturbed: BTreeSet<Name> = BTreeSet::new();
    for (_, rung) in program.rungs() {
        for (_, element) in rung.network.elements() {
            let (name, kind) = match &element.kind {
                ElementKind::Timer(it) => (&it.instance.name, Some(it.kind)),
                ElementKind::Counter(it) => (&it.instance.name, None),
                other => {
                    for written in other.writes() {
                        let whole = written.name.split('.').next().unwrap_or_default();
                        disturbed.extend([written.name.clone(), whole.into()]);
                    }
                    continue;
                }
            };
            places.entry(name.clone()).or_insert((0, kind)).0 += 1;
        }
    }
    let single = places
        .into_iter()
        .filter(|(name, (number, _))| *number == 1 && !disturbed.contains(name));
    single.map(|(name, (_, kind))| (name, kind)).collect()
}

/// Runs both for so many scans and compares every variable whose value does
/// not depend on what is not followed.
pub fn compare(
    program: &Program,
    followed: &Followed,
    scans: usize,
    random: &mut Random,
) -> Compared {
    let mut machine = Machine::new(program);
    let events = events(program);
    let sources = &followed.inputs.sources;
    let free: BTreeSet<usize> = (0..sources.len())
        .filter(|at| match &sources[*at] {
            Source::Event(of) => {
                !events.contains_key(of) || followed.netlist.inputs()[*at].name.ends_with(')')
            }
            Source::Opaque(_) | Source::Elapsed { .. } => true,
            Source::Bit(_) | Source::Choice { .. } | Source::WordBit { .. } => false,
        })
        .collect();
    let (netlist, shown, left_out) = judged(followed, &free);
    let mut now = vec![false; sources.len()];
    let mut inputs = Vec::new();
    let mut seen: Vec<Vec<Datum>> = Vec::new();
    for _ in 0..scans {
        for value in &mut now {
            *value ^= random.below(4) == 0;
        }
        if random.below(3) == 0 {
            // Words are seldom 0 by themselves.
            let words = sources.iter().zip(&mut now);
            let words = words.filter(|(it, _)| matches!(it, Source::WordBit { .. }));
            words.for_each(|(_, value)| *value = false);
        }
        for (name, value) in followed.inputs.values(&now) {
            machine.set_input(&name, value);
        }
        machine.scan([0, 10, 10, 20, 50][random.below(5)]);
        let mut row = now.clone();
        for (at, source) in sources.iter().enumerate() {
            if let Source::Event(of) = source {
                let done = machine.is_on(&format!("{of}.DN"));
                row[at] = match events.get(of) {
                    _ if followed.netlist.inputs()[at].name.contains("is at 0") => {
                        machine.is_on(&format!("{of}.QD"))
                    }
                    Some(Some(TimerKind::OffDelay | TimerKind::Pulse)) => !done,
                    _ => done,
                };
            }
        }
        inputs.push(row);
        seen.push(shown.iter().map(|(name, _)| machine.value(name)).collect());
    }
    let trace = Trace {
        initial: Vec::new(),
        inputs,
    };
    let replayed = replay(&netlist, &trace);
    let mut compared = Compared {
        left_out,
        variables: shown.len(),
        ..Compared::default()
    };
    for (scan, (row, seen)) in replayed.outputs.iter().zip(&seen).enumerate() {
        let mut outputs = row.iter();
        for ((name, values), expected) in shown.iter().zip(seen) {
            let on: Vec<bool> = outputs.by_ref().take(values.outputs()).copied().collect();
            let held = values.held(&on, *expected);
            assert!(
                held,
                "{name} in scan {scan}: {values:?} {on:?}, but {expected:?}"
            );
            compared.values += 1;
        }
    }
    compared.changing = (0..shown.len())
        .filter(|at| seen.iter().any(|row| row[*at].key() != seen[0][*at].key()))
        .count();
    compared
}

/// What outputs stand for a variable.
#[derive(Debug)]
pub enum Shown {
    /// One for each value.
    Values(Vec<Datum>),
    /// One for each bit.
    Bits(usize),
}

impl Shown {
    /// What a translation holds, the values or the bits, as outputs of its netlist.
    /// `None` if it is not followed or depends on what is not.
    pub fn of(
        name: &Name,
        (cases, bits): (&[(Datum, Signal)], &[Signal]),
        touched: &Touched,
        netlist: &mut Netlist,
    ) -> Option<Self> {
        let signals = cases.iter().map(|(_, when)| when).chain(bits);
        let signals: Vec<Signal> = signals.copied().collect();
        if signals.is_empty() || signals.iter().any(|it| touched.contains(*it)) {
            return None;
        }
        for (at, signal) in signals.iter().enumerate() {
            netlist.output(format!("{name} {at}"), *signal);
        }
        let values = cases.iter().map(|(value, _)| *value);
        Some(match bits.len() {
            0 => Self::Values(values.collect()),
            bits => Self::Bits(bits),
        })
    }

    /// How many outputs it has.
    pub fn outputs(&self) -> usize {
        match self {
            Self::Values(values) => values.len(),
            Self::Bits(bits) => *bits,
        }
    }

    /// Whether they show this value.
    pub fn held(&self, on: &[bool], expected: Datum) -> bool {
        match self {
            Self::Values(values) => {
                let held = values.iter().zip(on).filter(|(_, on)| **on);
                let held: Vec<[u64; 2]> = held.map(|(value, _)| value.key()).collect();
                held == [expected.key()]
            }
            Self::Bits(_) => {
                let bits = on.iter().enumerate();
                bits.fold(0, |word, (at, on)| word | i64::from(*on) << at) == expected.integer()
                    && !matches!(expected, Datum::Real(_))
            }
        }
    }
}

/// The netlist with outputs for the variables that can be judged, and these
/// variables.
fn judged(followed: &Followed, free: &BTreeSet<usize>) -> (Netlist, Vec<(Name, Shown)>, usize) {
    let mut netlist = followed.netlist.clone();
    let touched = netlist.touched_by(&free.iter().copied().collect::<Vec<_>>());
    let mut shown = Vec::new();
    let mut left_out = 0;
    for name in followed.variables() {
        let held = (followed.cases(name), followed.bits(name));
        match Shown::of(name, held, &touched, &mut netlist) {
            Some(own) => shown.push((name.clone(), own)),
            None => left_out += 1,
        }
    }
    (netlist, shown, left_out)
}
