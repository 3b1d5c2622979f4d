//! What a rung says, as written: a tree of places in the text, before names
//! are folded and elements drawn.

use logic::notation::{Node, Token};
use source::Span;

use crate::{CoilKind, CounterKind, TimerKind};

/// A rung.
#[derive(Clone, Debug, Default)]
pub(super) struct RungText {
    /// Its title, in quotes.
    pub(super) title: Option<Token>,
    /// The label that jumps lead to.
    pub(super) label: Option<Token>,
    /// `CONDITION -> OUTPUTS`.
    pub(super) leg: Leg,
}

/// A condition and what it drives: a whole rung, or a part of one in
/// parentheses.
#[derive(Clone, Debug, Default)]
pub(super) struct Leg {
    /// When power flows.
    pub(super) condition: Condition,
    /// What it drives, in the order of solving.
    pub(super) outputs: Vec<OutputText>,
}

/// The left side of a leg.
#[derive(Clone, Debug, Default)]
pub(super) enum Condition {
    /// There is none.
    #[default]
    Missing,
    /// An expression.
    Read(Node),
    /// Something that is no expression.
    NotRead(Span),
}

/// One thing that a leg drives.
#[derive(Clone, Debug)]
pub(super) struct OutputText {
    /// The whole of it.
    pub(super) span: Span,
    /// What it is.
    pub(super) kind: OutputKind,
}

/// What a leg can drive.
#[derive(Clone, Debug)]
pub(super) enum OutputKind {
    /// `v1`, `/v1`, `set v1`
    Coil(CoilKind, Token),
    /// `x := y + 1`
    Assign(Token, Term),
    /// `jump again`
    Jump(Token),
    /// `call Doors(a, b)`
    Call(Token, Vec<Argument>),
    /// `return`, or `return program` to end the program for this scan.
    Return {
        /// Whether the whole program ends.
        program: bool,
    },
    /// `TON(t1, 5s)`
    Timer(TimerKind, Token, Option<Preset<u64>>),
    /// `CTU(c1, 10)`
    Counter(CounterKind, Token, Option<Preset<i64>>),
    /// `RES(t1)`
    Reset(Token),
    /// `MCR()`
    Zone,
    /// Any other `NAME(...)`.
    Box(Token, Vec<Argument>),
    /// `(b -> v2)`
    Leg(Leg),
    /// Something that is no output.
    NotRead,
}

/// How far a timer or counter runs.
#[derive(Clone, Copy, Debug)]
pub(super) enum Preset<T> {
    /// `5s`, `10`
    Constant(T),
    /// `delay`: what the variable holds when the program runs.
    Variable(Token),
}

/// A value, or an arithmetic term of values.
#[derive(Clone, Debug)]
pub(super) struct Term {
    /// Its tokens, one or more.
    pub(super) tokens: Vec<Token>,
    /// From the first to the last.
    pub(super) span: Span,
}

/// What stands at a pin of a box.
#[derive(Clone, Debug)]
pub(super) struct Argument {
    /// The pin: `IN` in `IN := a`.
    pub(super) pin: Option<Pin>,
    /// The value at it; `None` where nothing stands between two commas.
    pub(super) value: Option<Term>,
}

/// A pin that an argument names.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pin {
    /// `IN := a`
    Input(Token),
    /// `OUT => a`
    Output(Token),
}
