//! What leaves an output: power, a value, or both.
//!
//! A wire of a drawing carries a Boolean or a value, and nothing on it says
//! which. A [`Signal`] keeps both readings open: the elements that power
//! leaves from, if it is power, and the [`Term`] that says it in words. Which
//! one is used is the consumer's choice: a coil takes power, an adder takes
//! the term.

use std::rc::Rc;

use logic::{Name, Relation};
use petgraph::graph::NodeIndex;
use source::Span;

use super::expression::{self, Meaning};
use super::names::Names;
use super::network::MadeUp;
use super::xml::Text;
use crate::{Network, Operand, Port, Value};

/// Terms longer than this are not spelt out: nested blocks that use a value
/// twice would double them at each level.
const LONGEST: usize = 300;

/// An element and the port that power leaves it from.
pub(super) type Tap = (NodeIndex, Port);

/// What leaves an output.
#[derive(Clone, Debug)]
pub(super) struct Signal {
    /// Where power leaves; on if any of them is. `None` while nobody asked for
    /// power and no element stands for the term.
    pub(super) taps: Option<Vec<Tap>>,
    /// Whether it is a Boolean; `None` if that is not known.
    pub(super) boolean: Option<bool>,
    pub(super) term: Term,
    /// The element that shows it.
    pub(super) span: Span,
}

impl Signal {
    /// The left rail.
    pub(super) fn rail(span: Span) -> Self {
        Self {
            taps: Some(vec![(Network::rail(), Port::Power)]),
            boolean: Some(true),
            term: Term::truth(true, span),
            span,
        }
    }

    /// Power that never is.
    pub(super) fn off(span: Span) -> Self {
        Self {
            taps: Some(Vec::new()),
            boolean: Some(true),
            term: Term::truth(false, span),
            span,
        }
    }

    /// Power that leaves an element.
    pub(super) fn power(element: NodeIndex, port: Port, term: Term, span: Span) -> Self {
        Self {
            taps: Some(vec![(element, port)]),
            boolean: Some(true),
            term,
            span,
        }
    }

    /// A value that no element stands for.
    pub(super) fn value(term: Term, boolean: Option<bool>, span: Span) -> Self {
        Self {
            taps: None,
            boolean,
            term,
            span,
        }
    }
}

/// A value in words, with what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term {
    pub(super) text: Name,
    pub(super) span: Span,
    pub(super) form: Form,
    pub(super) reads: Rc<[Operand]>,
    /// The function that made it, where one did.
    pub(super) mnemonic: Option<Name>,
}

/// The form of a term.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Form {
    Variable,
    Truth(bool),
    Integer(i64),
    /// A constant of another kind.
    Literal,
    /// The complement of a variable.
    Not(Operand),
    /// A comparison.
    Relation(Operand, Relation, Operand),
    /// A variable plus a constant.
    Sum(Name, i64),
    /// Anything else.
    Other,
}

impl Term {
    /// The expression `text` of a unit.
    pub(super) fn of(text: &Text<'_>, unit: usize, names: &mut Names) -> Self {
        let value = &*text.value;
        let place = |range: &std::ops::Range<usize>| part(text, range);
        let rewritten = names.rewrite(unit, value);
        let reads: Rc<[Operand]> = rewritten
            .reads
            .iter()
            .map(|(name, range)| Operand::new(name.clone(), place(range)))
            .collect();
        let mut side = |range: std::ops::Range<usize>| {
            let term = names.rewrite(unit, value.get(range.clone()).unwrap_or_default());
            let number = expression::integer(&term.text);
            let name = number.map_or(term.text, |number| number.to_string());
            Operand::new(name, part(text, &range))
        };
        let (folded, form) = match expression::meaning(value) {
            Meaning::Variable => (rewritten.text, Form::Variable),
            Meaning::Truth(truth) => (truth_word(truth).to_owned(), Form::Truth(truth)),
            Meaning::Integer(number) => (number.to_string(), Form::Integer(number)),
            Meaning::Literal => (rewritten.text, Form::Literal),
            Meaning::Not(inner) => (rewritten.text, Form::Not(side(inner))),
            Meaning::Relation(left, relation, right) => {
                let (left, right) = (side(left), side(right));
                (rewritten.text, Form::Relation(left, relation, right))
            }
            Meaning::Term => (rewritten.text, Form::Other),
        };
        Self {
            text: folded.into(),
            span: text.span,
            form,
            reads,
            mnemonic: None,
        }
    }

    /// A variable by its folded name.
    pub(super) fn variable(operand: Operand) -> Self {
        Self {
            text: operand.name.clone(),
            span: operand.within.while_building(),
            form: Form::Variable,
            reads: Rc::new([operand]),
            mnemonic: None,
        }
    }

    pub(super) fn truth(truth: bool, span: Span) -> Self {
        Self {
            text: truth_word(truth).into(),
            span,
            form: Form::Truth(truth),
            reads: Rc::new([]),
            mnemonic: None,
        }
    }

    /// `text`, made of `parts`; a made-up name if that is too long.
    pub(super) fn composed(text: String, parts: &[Term], span: Span, made_up: &MadeUp<'_>) -> Self {
        let reads = reads_of(parts);
        let text = if text.len() > LONGEST {
            made_up.name()
        } else {
            text.into()
        };
        Self {
            text,
            span,
            form: Form::Other,
            reads,
            mnemonic: None,
        }
    }

    /// The complement.
    pub(super) fn complement(&self, span: Span, made_up: &MadeUp<'_>) -> Self {
        let mut term = match &self.form {
            Form::Truth(truth) => return Self::truth(!truth, span),
            Form::Not(operand) => return Self::variable(operand.clone()),
            Form::Variable => Self::composed(
                format!("NOT {}", self.text),
                std::slice::from_ref(self),
                span,
                made_up,
            ),
            _ => Self::composed(
                format!("NOT ({})", self.text),
                std::slice::from_ref(self),
                span,
                made_up,
            ),
        };
        if self.form == Form::Variable {
            term.form = Form::Not(Operand::new(self.text.clone(), self.span));
        }
        term
    }

    /// All of `parts`, joined by `word`.
    pub(super) fn joined(
        mut parts: Vec<Term>,
        word: &str,
        span: Span,
        made_up: &MadeUp<'_>,
    ) -> Self {
        if parts.len() == 1
            && let Some(only) = parts.pop()
        {
            return only;
        }
        let texts: Vec<_> = parts.iter().map(Term::enclosed).collect();
        let text = format!("({})", texts.join(&format!(" {word} ")));
        Self::composed(text, &parts, span, made_up)
    }

    /// As an operand of a comparison or a pin.
    pub(super) fn operand(&self) -> Operand {
        Operand::new(self.text.clone(), self.span)
    }

    /// The text as a part of a larger one: in brackets, unless it is one thing.
    pub(super) fn enclosed(&self) -> String {
        let whole = match self.form {
            Form::Relation(..) => false,
            Form::Other | Form::Sum(..) => is_enclosed(&self.text),
            _ => true,
        };
        if whole {
            self.text.to_string()
        } else {
            format!("({})", self.text)
        }
    }

    /// As what is written to `target`.
    pub(super) fn written_to(&self, target: &Operand) -> Value {
        match &self.form {
            Form::Integer(number) => Value::Constant(*number),
            Form::Truth(truth) => Value::Constant((*truth).into()),
            Form::Variable => Value::Copy(self.operand()),
            Form::Sum(variable, amount) if *variable == target.name => Value::Increment(*amount),
            _ => Value::Term {
                text: self.text.clone(),
                reads: self.reads.to_vec(),
            },
        }
    }
}

/// What `parts` read, at most [`LONGEST`] of it. A long series hands its list
/// on from contact to contact; once it is full, all share one.
fn reads_of(parts: &[Term]) -> Rc<[Operand]> {
    let Some((first, rest)) = parts.split_first() else {
        return Rc::new([]);
    };
    let room = LONGEST.saturating_sub(first.reads.len());
    if room == 0 || rest.iter().all(|part| part.reads.is_empty()) {
        return Rc::clone(&first.reads);
    }
    let mut reads = first.reads.to_vec();
    for read in rest.iter().flat_map(|part| part.reads.iter()).take(room) {
        if !reads.contains(read) {
            reads.push(read.clone());
        }
    }
    reads.into()
}

/// Whether the text is a name, a call, or stands in brackets.
fn is_enclosed(text: &str) -> bool {
    let name = text
        .find(|c| !expression::continues_name(c) && c != '.')
        .unwrap_or(text.len());
    let mut depth = 0usize;
    for (at, c) in text.char_indices().skip_while(|(at, _)| *at < name) {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return at + c.len_utf8() == text.len();
        }
    }
    true
}

fn truth_word(truth: bool) -> &'static str {
    if truth { "TRUE" } else { "FALSE" }
}

/// The bytes of a part of a text. Where its value has another length than its
/// bytes (an entity), the bytes of the whole.
fn part(text: &Text<'_>, range: &std::ops::Range<usize>) -> Span {
    if text.value.len() != text.span.len() {
        return text.span;
    }
    let start = text.span.start as usize;
    Span::new(start + range.start, start + range.end)
}
