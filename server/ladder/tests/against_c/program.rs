//! Random programs as trees, from which both texts are printed.

use crate::random::Random;

pub const INPUTS: [&str; 4] = ["i0", "i1", "i2", "i3"];
const BITS: [&str; 5] = ["q0", "q1", "q2", "q3", "q4"];
const NUMBERS: [&str; 3] = ["n0", "n1", "n2"];
const RELATIONS: [&str; 6] = ["=", "<>", "<", "<=", ">", ">="];

pub struct Program {
    pub main: Vec<Rung>,
    /// The rungs of the routine `Sub`.
    pub sub: Vec<Rung>,
    pub boxes: Vec<Boxed>,
}

pub struct Rung {
    /// Where jumps arrive.
    pub label: Option<usize>,
    pub kind: RungKind,
}

pub enum RungKind {
    Plain(Condition, Vec<Output>),
    /// Begins a zone under master control.
    ZoneBegin(Condition),
    ZoneEnd,
}

#[derive(Clone)]
pub enum Condition {
    Constant(bool),
    Open(String),
    Closed(String),
    /// An edge contact: of a variable.
    Edge {
        is_rising: bool,
        of: String,
    },
    /// A one shot: of power that comes through a piece of the rung.
    OneShot {
        is_rising: bool,
        of: Box<Condition>,
    },
    Compare(String, &'static str, String),
    All(Vec<Condition>),
    Any(Vec<Condition>),
}

#[derive(Clone)]
pub enum Output {
    Coil(Coil, &'static str),
    /// The target and the term, `n0`, `5`.
    Move(&'static str, Term),
    /// Solves a timer or counter, by its place.
    Box(usize),
    Reset(usize),
    Jump(usize),
    Call,
    Return,
    Leg(Condition, Vec<Output>),
}

#[derive(Clone, Copy)]
pub enum Coil {
    Plain,
    Negated,
    Set,
    Reset,
    Rising,
    Falling,
}

#[derive(Clone)]
pub enum Term {
    Value(String),
    Sum(String, &'static str, i64),
    Product(String, i64, i64),
}

/// A timer or counter.
pub struct Boxed {
    pub name: String,
    pub kind: &'static str,
    pub preset: usize,
}

impl Boxed {
    pub fn is_timer(&self) -> bool {
        !self.kind.starts_with('C')
    }
}

impl Program {
    /// The variables that are compared, as the rungs call them.
    pub fn shown(&self) -> Vec<String> {
        let bits = BITS.iter().chain(&NUMBERS).map(|name| (*name).to_owned());
        let boxes = self.boxes.iter().map(|it| format!("{}.Q", it.name));
        bits.chain(boxes).collect()
    }

    pub fn random(random: &mut Random) -> Self {
        let kinds = ["TON", "TOF", "TP", "RTO", "CTU", "CTC"];
        let boxes: Vec<Boxed> = (0..random.below(4))
            .map(|at| {
                let kind = random.one_of(&kinds);
                let is_timer = !kind.starts_with('C');
                Boxed {
                    name: format!("b{at}"),
                    kind,
                    preset: if is_timer {
                        10 * random.below(6)
                    } else {
                        random.below(5)
                    },
                }
            })
            .collect();
        let mut maker = Maker {
            // Inputs move everything else, so they stand in most conditions.
            readable: [INPUTS; 3]
                .as_flattened()
                .iter()
                .chain(&BITS)
                .map(|it| (*it).to_owned())
                .collect(),
            random,
            boxes: &boxes,
        };
        maker
            .readable
            .extend(boxes.iter().map(|it| format!("{}.Q", it.name)));
        let main = maker.main();
        let sub = maker.sub();
        Self { main, sub, boxes }
    }
}

struct Maker<'r> {
    random: &'r mut Random,
    readable: Vec<String>,
    boxes: &'r [Boxed],
}

impl Maker<'_> {
    fn main(&mut self) -> Vec<Rung> {
        let length = 4 + self.random.below(7);
        let mut rungs: Vec<Rung> = (0..length).map(|_| self.rung(true)).collect();
        // Each timer and counter is solved in one place.
        for at in 0..self.boxes.len() {
            let place = self.random.below(rungs.len());
            if let RungKind::Plain(_, outputs) = &mut rungs[place].kind {
                let place = self.random.below(outputs.len() + 1);
                outputs.insert(place, Output::Box(at));
            }
        }
        if self.random.below(3) == 0 {
            let from = self.random.below(rungs.len() - 1);
            let to = from + 1 + self.random.below(rungs.len() - from - 1);
            let condition = self.condition(2);
            rungs.insert(to, unlabelled(RungKind::ZoneEnd));
            rungs.insert(from, unlabelled(RungKind::ZoneBegin(condition)));
        }
        for label in 0..self.random.below(3) {
            let from = self.random.below(rungs.len() - 1);
            let to = from + 1 + self.random.below(rungs.len() - from - 1);
            let is_labelled = rungs[to].label.is_some();
            if let RungKind::Plain(_, outputs) = &mut rungs[from].kind
                && !is_labelled
            {
                let place = self.random.below(outputs.len() + 1);
                outputs.insert(place, Output::Jump(label));
                rungs[to].label = Some(label);
            }
        }
        rungs
    }

    fn sub(&mut self) -> Vec<Rung> {
        let mut rungs: Vec<Rung> = (0..1 + self.random.below(3))
            .map(|_| self.rung(false))
            .collect();
        if self.random.below(2) == 0 {
            let condition = self.condition(1);
            let leave = RungKind::Plain(condition, vec![Output::Return]);
            rungs.insert(self.random.below(rungs.len()), unlabelled(leave));
        }
        rungs
    }

    fn rung(&mut self, may_call: bool) -> Rung {
        let condition = self.condition(3);
        let outputs = self.outputs(may_call, 2);
        unlabelled(RungKind::Plain(condition, outputs))
    }

    fn outputs(&mut self, may_call: bool, depth: usize) -> Vec<Output> {
        let number = 1 + self.random.below(2);
        (0..number).map(|_| self.output(may_call, depth)).collect()
    }

    fn output(&mut self, may_call: bool, depth: usize) -> Output {
        use Coil::{Falling, Negated, Plain, Reset, Rising, Set};
        match self.random.below(14) {
            0..=6 => {
                let kinds = [Plain, Plain, Plain, Negated, Set, Reset, Rising, Falling];
                let kind = self.random.one_of(&kinds);
                Output::Coil(kind, self.random.one_of(&BITS))
            }
            7..=9 => Output::Move(self.random.one_of(&NUMBERS), self.term()),
            10 if may_call => Output::Call,
            11 => {
                // Resetting is defined for what keeps its value by itself.
                let all = self.boxes.iter().enumerate();
                let keep = all.filter(|(_, it)| matches!(it.kind, "RTO" | "CTU" | "CTC"));
                let keep: Vec<usize> = keep.map(|(at, _)| at).collect();
                match keep.is_empty() {
                    true => Output::Coil(Plain, self.random.one_of(&BITS)),
                    false => Output::Reset(self.random.one_of(&keep)),
                }
            }
            12 if depth > 0 => {
                let condition = self.condition(1);
                Output::Leg(condition, self.outputs(may_call, depth - 1))
            }
            _ => Output::Coil(Plain, self.random.one_of(&BITS)),
        }
    }

    fn term(&mut self) -> Term {
        let small = |random: &mut Random| i64::try_from(random.below(6)).expect("small");
        let name = self.random.one_of(&NUMBERS).to_owned();
        match self.random.below(5) {
            0 => Term::Value(small(self.random).to_string()),
            1 => Term::Value(name),
            2 => Term::Product(name, small(self.random), 1 + small(self.random)),
            _ => Term::Sum(name, self.random.one_of(&["+", "-"]), small(self.random)),
        }
    }

    fn condition(&mut self, depth: usize) -> Condition {
        let name = self.random.one_of(&self.readable);
        match self.random.below(if depth == 0 { 9 } else { 16 }) {
            0 if self.random.below(8) == 0 => Condition::Constant(self.random.below(8) > 0),
            1 => {
                // Compilers refuse to compare a number with itself.
                let at = self.random.below(NUMBERS.len());
                let number = NUMBERS[at].to_owned();
                let other = match self.random.below(2) {
                    0 => self.random.below(6).to_string(),
                    _ => NUMBERS[(at + 1) % NUMBERS.len()].to_owned(),
                };
                Condition::Compare(number, self.random.one_of(&RELATIONS), other)
            }
            2 => Condition::Edge {
                is_rising: self.random.below(2) == 0,
                of: name,
            },
            3..=4 => Condition::Closed(name),
            0 | 5..=8 => Condition::Open(name),
            9 => {
                let parts = vec![self.condition(0), self.condition(depth - 1)];
                let of = match self.random.below(2) {
                    0 => Condition::All(parts),
                    _ => Condition::Any(parts),
                };
                Condition::OneShot {
                    is_rising: self.random.below(2) == 0,
                    of: Box::new(of),
                }
            }
            10..=11 => Condition::All(self.parts(depth)),
            _ => Condition::Any(self.parts(depth)),
        }
    }

    fn parts(&mut self, depth: usize) -> Vec<Condition> {
        let number = 2 + self.random.below(2);
        (0..number).map(|_| self.condition(depth - 1)).collect()
    }
}

fn unlabelled(kind: RungKind) -> Rung {
    Rung { label: None, kind }
}
