//! The text as a list of statements, each with its bytes: what reading,
//! rewriting and formatting have in common.
//!
//! Every line of the text belongs to exactly one statement; blank lines and
//! comment lines are statements too, so that nothing can get lost between.
//! What a transition's rule means depends on which names are steps, so its
//! statement keeps the left side open ([`TransitionRule::meaning`]).

use std::collections::HashSet;

use logic::notation::{Problem, Token};
use logic::{Expr, Name};
use source::Span;

use super::words::{Section, Word};
use crate::{
    Action, Decision, EnvironmentRule, Instance, PartKind, Property, Step, Transition, Variable,
};

/// A whole text.
#[derive(Clone, Debug)]
pub(crate) struct Document<'t> {
    pub(crate) text: &'t str,
    pub(crate) statements: Vec<Statement>,
}

/// A statement: usually a line, several where one goes on in the next.
#[derive(Clone, Debug)]
pub(crate) struct Statement {
    /// The lines it takes.
    pub(crate) lines: Vec<Line>,
    /// Its tokens, comments and line ends left out.
    pub(crate) tokens: Vec<Token>,
    /// What it is.
    pub(crate) kind: Kind,
    /// The names in it.
    pub(crate) marks: Vec<Mark>,
    /// What could not be understood. What comes before it in a list counts.
    pub(crate) problem: Option<Problem>,
    /// The part it stands in.
    pub(crate) part: Option<Name>,
    /// The section it stands in.
    pub(crate) section: Option<Section>,
}

/// A line of the text.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    /// Its first byte, a byte order mark passed over.
    pub(crate) start: usize,
    /// One past its last byte, the line end left out.
    pub(crate) end: usize,
    /// Where the next line starts.
    pub(crate) next: usize,
    /// Its tokens, comment and line end left out.
    pub(crate) tokens: Vec<Token>,
    /// Its comment.
    pub(crate) comment: Option<Token>,
}

/// What a statement is.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Blank,
    Comment,
    Decision(Decision),
    Grafcet(Name),
    List(Word, Vec<Entry>),
    Part(Name, PartKind),
    Section(Section),
    Transition(TransitionRule),
    Action(Action),
    Environment(EnvironmentRule),
    Never(Property),
    /// Not understood; with the label, if it has one.
    Broken(Option<Name>),
}

/// One name of a list with what is said about it.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) item: Item,
    /// Its tokens.
    pub(crate) span: Span,
    /// The comma after it.
    pub(crate) comma: Option<Span>,
    /// The line of the statement that it begins in.
    pub(crate) line: usize,
    /// Whether its line declares nothing else, so that the line's comment is
    /// its own.
    pub(crate) alone: bool,
}

/// What an entry declares, or the name that it marks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    Step(Step),
    Variable(Variable),
    Instance(Instance),
    Name(Name),
}

impl Item {
    pub(crate) fn name(&self) -> &Name {
        match self {
            Self::Step(step) => &step.name,
            Self::Variable(variable) => &variable.name,
            Self::Instance(instance) => &instance.name,
            Self::Name(name) => name,
        }
    }

    pub(crate) fn comment(&self) -> Option<&Name> {
        match self {
            Self::Step(step) => step.comment.as_ref(),
            Self::Variable(variable) => variable.comment.as_ref(),
            Self::Instance(instance) => instance.comment.as_ref(),
            Self::Name(_) => None,
        }
    }

    pub(crate) fn set_comment(&mut self, comment: Option<Name>) {
        match self {
            Self::Step(step) => step.comment = comment,
            Self::Variable(variable) => variable.comment = comment,
            Self::Instance(instance) => instance.comment = comment,
            Self::Name(_) => {}
        }
    }
}

/// A rule of the section `Transitions:`.
#[derive(Clone, Debug)]
pub(crate) struct TransitionRule {
    pub(crate) name: Name,
    /// The factors of the left side.
    pub(crate) left: Vec<Factor>,
    pub(crate) to: Vec<Name>,
    pub(crate) comment: Option<Name>,
}

/// A factor of a left side.
#[derive(Clone, Debug)]
pub(crate) struct Factor {
    pub(crate) expr: Expr,
    /// The name, if the factor is a name without parentheses: only such a one
    /// can be an upstream step.
    pub(crate) plain: Option<Name>,
}

impl TransitionRule {
    /// The transition, where `steps` are the names of steps: the leading
    /// factors that are plain names of steps stand before it, the others are
    /// its receptivity.
    pub(crate) fn meaning(&self, steps: &HashSet<Name>) -> Transition {
        let upstream = self
            .left
            .iter()
            .map_while(|factor| factor.plain.as_ref().filter(|name| steps.contains(*name)));
        let from: Vec<Name> = upstream.cloned().collect();
        let rest = self.left.iter().skip(from.len());
        let mut conditions: Vec<Expr> = rest.map(|factor| factor.expr.clone()).collect();
        let receptivity = match conditions.len() {
            0 => Expr::Constant(true),
            1 => conditions.remove(0),
            _ => Expr::And(conditions),
        };
        Transition {
            name: self.name.clone(),
            from,
            to: self.to.clone(),
            receptivity,
            comment: self.comment.clone(),
        }
    }
}

/// A name where it stands, and what it is there for.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    pub(crate) name: Name,
    pub(crate) span: Span,
    pub(crate) usage: Usage,
}

/// What a name is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Usage {
    /// Declares what the word says.
    Declares(Word),
    /// Declares a part.
    DeclaresPart,
    /// Declares a parameter of a reusable grafcet.
    DeclaresParameter,
    /// The label of a rule that needs no other declaration.
    DeclaresRule,
    /// Names the grafcet.
    DeclaresGrafcet,
    /// The label of a transition's rule.
    Transition,
    /// A step.
    Step,
    /// A variable or a step, in an expression.
    Value,
    /// What an action acts upon.
    Output,
    /// A part.
    Part,
    /// A state of the ladder.
    State,
    /// A rule, in a decision.
    Rule,
}

impl Statement {
    /// From the first token to the last; of a comment line, the comment.
    pub(crate) fn span(&self) -> Span {
        match (self.tokens.first(), self.tokens.last()) {
            (Some(first), Some(last)) => first.span.cover(last.span),
            _ => self
                .trailing_comment()
                .map_or(Span::at(self.start()), |comment| comment.span),
        }
    }

    /// The first byte of its first line.
    pub(crate) fn start(&self) -> usize {
        self.lines.first().map_or(0, |line| line.start)
    }

    /// Where the line after it starts.
    pub(crate) fn next(&self) -> usize {
        self.lines.last().map_or(0, |line| line.next)
    }

    /// The comment of its last line.
    pub(crate) fn trailing_comment(&self) -> Option<Token> {
        self.lines.last().and_then(|line| line.comment)
    }

    /// The label of a rule.
    pub(crate) fn label(&self) -> Option<&Name> {
        match &self.kind {
            Kind::Transition(rule) => Some(&rule.name),
            Kind::Action(action) => Some(&action.step),
            Kind::Environment(rule) => Some(&rule.name),
            Kind::Never(rule) => Some(&rule.name),
            Kind::Broken(label) => label.as_ref(),
            _ => None,
        }
    }
}

impl Document<'_> {
    /// The names that the text declares as steps.
    pub(crate) fn step_names(&self) -> HashSet<Name> {
        let mut taken: HashSet<&Name> = HashSet::new();
        let mut steps = HashSet::new();
        for (_, word, entry) in self.entries() {
            let counts = word.declares_step() || word.declares_variable();
            if counts && taken.insert(entry.item.name()) && word.declares_step() {
                steps.insert(entry.item.name().clone());
            }
        }
        steps
    }

    /// The entries of all lists, with the places of their statements.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (usize, Word, &Entry)> {
        let lists = self.statements.iter().enumerate();
        lists.flat_map(|(at, statement)| {
            let (word, entries) = match &statement.kind {
                Kind::List(word, entries) => (*word, entries.as_slice()),
                _ => (Word::Step, [].as_slice()),
            };
            entries.iter().map(move |entry| (at, word, entry))
        })
    }

    /// The line end of the text: that of its first line, else `\n`.
    pub(crate) fn line_end(&self) -> &'static str {
        let first = self.text.find(['\n', '\r']);
        match first.and_then(|at| self.text.get(at..)) {
            Some(rest) if rest.starts_with("\r\n") => "\r\n",
            Some(rest) if rest.starts_with('\r') => "\r",
            _ => "\n",
        }
    }
}

/// The text of a comment without its sign; `None` where it says nothing.
pub(crate) fn comment_text(text: &str, comment: Token) -> Option<Name> {
    let whole = comment.text(text);
    let said = whole.strip_prefix("//").unwrap_or(whole).trim();
    (!said.is_empty()).then(|| said.into())
}
