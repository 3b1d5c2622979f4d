//! What each name of a text is, for colouring.
//!
//! Only names that were understood are told, in text and inside XML alike.
//! Words and signs of the notations are left to the grammars of editors.

use std::collections::HashSet;

use ::ladder::{Block, Class, ContactKind, ElementKind, Familiarity, Rung};
use grafcet::Role;
use logic::{Atom, Name};
use recovery::conditions::WriteKind;
use source::Span;

use crate::names::word;
use crate::{Ladder, Mention, Spec, Usage, element};

/// A name that is coloured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// The bytes.
    pub span: Span,
    /// What it names.
    pub kind: TokenKind,
    /// What else holds of it.
    pub marks: Marks,
}

/// What a token names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TokenKind {
    /// A program, a grafcet, a part.
    Namespace,
    /// A routine, a box.
    Function,
    /// A variable.
    Variable,
    /// A parameter of a reusable grafcet.
    Parameter,
    /// An environment rule or a property.
    Property,
    /// A step.
    EnumMember,
    /// A transition.
    Event,
    /// A number.
    Number,
    /// A label.
    Label,
    /// The variable of a contact.
    Contact,
    /// The variable of a coil; in a spec a state of the ladder.
    Coil,
}

impl TokenKind {
    /// All of them, each at its own place.
    pub const ALL: [Self; 11] = [
        Self::Namespace,
        Self::Function,
        Self::Variable,
        Self::Parameter,
        Self::Property,
        Self::EnumMember,
        Self::Event,
        Self::Number,
        Self::Label,
        Self::Contact,
        Self::Coil,
    ];

    /// Its name in the protocol.
    pub fn word(self) -> &'static str {
        match self {
            Self::Namespace => "namespace",
            Self::Function => "function",
            Self::Variable => "variable",
            Self::Parameter => "parameter",
            Self::Property => "property",
            Self::EnumMember => "enumMember",
            Self::Event => "event",
            Self::Number => "number",
            Self::Label => "label",
            Self::Contact => "contact",
            Self::Coil => "coil",
        }
    }
}

/// What else holds of a token: a set of [`Mark`]s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Marks(u32);

impl Marks {
    /// The set with one more.
    #[must_use]
    pub fn with(self, mark: Mark) -> Self {
        Self(self.0 | 1 << mark as u32)
    }

    /// Whether the set has it.
    pub fn has(self, mark: Mark) -> bool {
        self.0 & 1 << mark as u32 != 0
    }

    /// The set as the protocol has it: bit n stands for `Mark::ALL[n]`.
    pub fn bits(self) -> u32 {
        self.0
    }
}

/// Something that holds of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mark {
    /// It is declared here.
    Declaration,
    /// It is written here.
    Modification,
    /// It never changes.
    Readonly,
    /// It holds a state of the process.
    State,
    /// It keeps a state from starting while another is active.
    Interlock,
    /// What it does is not known.
    Opaque,
}

impl Mark {
    /// All of them, each at its own place.
    pub const ALL: [Self; 6] = [
        Self::Declaration,
        Self::Modification,
        Self::Readonly,
        Self::State,
        Self::Interlock,
        Self::Opaque,
    ];

    /// Its name in the protocol.
    pub fn word(self) -> &'static str {
        match self {
            Self::Declaration => "declaration",
            Self::Modification => "modification",
            Self::Readonly => "readonly",
            Self::State => "state",
            Self::Interlock => "interlock",
            Self::Opaque => "opaque",
        }
    }
}

/// The names of a ladder, in the order of the text; none overlaps another.
pub fn tokens_in_ladder(ladder: &Ladder) -> Vec<Token> {
    let opaque = opaque(ladder);
    let mut tokens: Vec<Token> = Vec::new();
    let mentions = ladder.names().all().iter();
    tokens.extend(mentions.filter_map(|it| of_mention(ladder, it, &opaque)));
    for routine in &ladder.program().routines {
        tokens.extend(ladder.routine_name(routine).map(|span| {
            let kind = match routine.name == routine.unit {
                true => TokenKind::Namespace,
                false => TokenKind::Function,
            };
            plain(span, kind, Mark::Declaration)
        }));
        tokens.extend(routine.rungs.iter().flat_map(|it| of_rung(ladder, it)));
    }
    apart(tokens, &ladder.text)
}

fn plain(span: Span, kind: TokenKind, mark: Mark) -> Token {
    Token {
        span,
        kind,
        marks: Marks::default().with(mark),
    }
}

/// Those that overlap no token before them.
pub(crate) fn apart(mut tokens: Vec<Token>, text: &str) -> Vec<Token> {
    tokens.retain(|it| text.get(it.span.range()).is_some_and(|it| !it.is_empty()));
    tokens.sort_by_key(|it| it.span);
    let mut end = 0;
    tokens.retain(|it| {
        let free = it.span.start >= end;
        if free {
            end = it.span.end;
        }
        free
    });
    tokens
}

/// The variables that get values which nobody knows: outputs of unknown boxes,
/// and what these write.
fn opaque(ladder: &Ladder) -> HashSet<&Name> {
    let conditions = &ladder.analysis.conditions;
    let outputs = conditions.opaque.iter();
    let outputs = outputs.filter_map(|atom| match conditions.atoms.atom(*atom) {
        Atom::Variable(name) => Some(name),
        _ => None,
    });
    let variables = conditions.variables.iter().filter(|variable| {
        let mut writes = variable.writes.iter();
        writes.any(|it| matches!(it.kind, WriteKind::Unknown(_)))
    });
    let mentions = ladder.names().all().iter();
    let by_boxes = mentions.filter(|mention| {
        let element = mention
            .place
            .and_then(|place| element(ladder.program(), place));
        let by_unknown = element.is_some_and(|(_, it)| match &it.kind {
            ElementKind::Block(block) => block.familiarity == Familiarity::Unknown,
            _ => false,
        });
        mention.usage == Usage::Written && by_unknown
    });
    outputs
        .chain(variables.map(|variable| &variable.name))
        .chain(by_boxes.map(|mention| &mention.name))
        .collect()
}

fn of_mention(ladder: &Ladder, mention: &Mention, opaque: &HashSet<&Name>) -> Option<Token> {
    if !ladder.is_variable(&mention.name) {
        let is_number = mention.name.parse::<f64>().is_ok();
        return is_number.then_some(Token {
            span: mention.span,
            kind: TokenKind::Number,
            marks: Marks::default(),
        });
    }
    let analysis = &ladder.analysis;
    let at = mention
        .place
        .and_then(|place| element(ladder.program(), place));
    let kind = match at.map(|(_, it)| &it.kind) {
        Some(ElementKind::Contact(_)) => TokenKind::Contact,
        Some(ElementKind::Coil(_)) => TokenKind::Coil,
        _ => TokenKind::Variable,
    };
    let mut marks = Marks::default();
    match mention.usage {
        Usage::Declared => marks = marks.with(Mark::Declaration),
        Usage::Read => {}
        Usage::Written => marks = marks.with(Mark::Modification),
    }
    let declared = ladder.program().declarations.find(&mention.name);
    if declared.is_some_and(|it| it.class == Class::Constant) {
        marks = marks.with(Mark::Readonly);
    }
    if analysis.states().find(&mention.name).is_some() {
        marks = marks.with(Mark::State);
    }
    if is_interlock(ladder, mention) {
        marks = marks.with(Mark::Interlock);
    }
    if opaque.contains(&mention.name) {
        marks = marks.with(Mark::Opaque);
    }
    Some(Token {
        span: mention.span,
        kind,
        marks,
    })
}

/// Whether a mention is the normally closed contact of a state, in a rung of
/// another state that it keeps from starting.
fn is_interlock(ladder: &Ladder, mention: &Mention) -> bool {
    let analysis = &ladder.analysis;
    let Some(place) = mention.place else {
        return false;
    };
    let is_closed = element(ladder.program(), place).is_some_and(|(_, it)| match &it.kind {
        ElementKind::Contact(contact) => contact.kind == ContactKind::Closed,
        _ => false,
    });
    let Some(own) = analysis.states().find(&mention.name).filter(|_| is_closed) else {
        return false;
    };
    let rung = ladder.rung(place).map(|(_, rung)| rung);
    let elements = rung.into_iter().flat_map(|it| it.network.elements());
    let mut coils = elements.filter_map(|(_, it)| match &it.kind {
        ElementKind::Coil(coil) => analysis.states().find(&coil.operand.name),
        _ => None,
    });
    coils.any(|state| state.interlocks.contains(&own.atom))
}

/// The names of boxes, of what is called and jumped to.
fn of_rung<'l>(ladder: &'l Ladder, rung: &'l Rung) -> impl Iterator<Item = Token> + 'l {
    let elements = rung.network.elements();
    elements.filter_map(|(_, element)| {
        let token = |span, kind| Token {
            span,
            kind,
            marks: Marks::default(),
        };
        let whole = rung.place(element.within);
        match &element.kind {
            ElementKind::Call(call) => {
                Some(token(rung.place(call.routine.within), TokenKind::Function))
            }
            ElementKind::Jump(label) => Some(token(rung.place(label.within), TokenKind::Label)),
            ElementKind::Label(label) => Some(plain(
                rung.place(label.within),
                TokenKind::Label,
                Mark::Declaration,
            )),
            ElementKind::Block(block) => {
                let token = token(named_in(ladder, whole, &block.name)?, TokenKind::Function);
                Some(Token {
                    marks: of_block(block),
                    ..token
                })
            }
            ElementKind::Timer(_) | ElementKind::Counter(_) | ElementKind::ResetBox(_) => {
                let text = ladder.text.get(whole.range())?;
                let end = text.find('(')?;
                let name = text[..end].trim_end();
                let is_name = !name.is_empty() && name.chars().all(char::is_alphanumeric);
                let start = whole.range().start;
                is_name.then(|| token(Span::new(start, start + name.len()), TokenKind::Function))
            }
            _ => None,
        }
    })
}

fn of_block(block: &Block) -> Marks {
    match block.familiarity {
        Familiarity::Unknown => Marks::default().with(Mark::Opaque),
        Familiarity::Known | Familiarity::Defined => Marks::default(),
    }
}

/// Where an element writes `name`.
fn named_in(ladder: &Ladder, whole: Span, name: &str) -> Option<Span> {
    let text = ladder.text.get(whole.range())?;
    let start = whole.range().start + word(text, name)?;
    Some(Span::new(start, start + name.len()))
}

/// The names of a spec, in the order of the text.
pub fn tokens_in_spec(spec: &Spec) -> Vec<Token> {
    let mentions = spec.reading.places.mentions.iter();
    let tokens = mentions.map(|mention| {
        let mut marks = Marks::default();
        if mention.declares {
            marks = marks.with(Mark::Declaration);
        }
        if mention.written {
            marks = marks.with(Mark::Modification);
        }
        let kind = match mention.role {
            Role::Grafcet | Role::Part => TokenKind::Namespace,
            Role::Step => TokenKind::EnumMember,
            Role::Variable | Role::Instance => TokenKind::Variable,
            Role::Transition => TokenKind::Event,
            Role::Parameter => TokenKind::Parameter,
            Role::Rule => TokenKind::Property,
            Role::State => {
                marks = marks.with(Mark::State);
                TokenKind::Coil
            }
        };
        Token {
            span: mention.span,
            kind,
            marks,
        }
    });
    apart(tokens.collect(), &spec.text)
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    /// `text: kind, marks`, one a line.
    fn shown(text: &str, tokens: &[Token]) -> String {
        let mut out = String::new();
        for token in tokens {
            out += &format!("{}: {}", &text[token.span.range()], token.kind.word());
            for mark in Mark::ALL.into_iter().filter(|it| token.marks.has(*it)) {
                out += &format!(" {}", mark.word());
            }
            out += "\n";
        }
        out
    }

    fn in_ladder(text: &str) -> String {
        let ladder = Ladder::read(text.into(), &Budget::default());
        shown(text, &tokens_in_ladder(&ladder))
    }

    #[test]
    fn contacts_coils_states_and_interlocks_are_told_apart() {
        assert_eq!(
            in_ladder(
                "\
program Tank
input s
rung: (s + v1) * /ls2 * /v2 -> v1
rung: (ls2 + v2) * /s -> set lamp, v2
"
            ),
            "\
Tank: namespace declaration
s: variable declaration
s: contact
v1: contact state
ls2: contact
v2: contact state interlock
v1: coil modification state
ls2: contact
v2: contact state
s: contact
lamp: coil modification
v2: coil modification state
"
        );
    }

    #[test]
    fn boxes_labels_and_numbers_are_told() {
        assert_eq!(
            in_ladder(
                "\
constant most = 5
rung: n > 5 -> TON(t1, 5s), jump again
rung label again: a -> SORT(OUT => x), call Doors

routine Doors
rung: x -> n := most
"
            ),
            "\
most: variable declaration readonly
n: variable
5: number
TON: function
t1: variable modification
again: label
again: label declaration
a: contact
SORT: function opaque
x: variable modification opaque
Doors: function
Doors: function declaration
x: contact opaque
n: variable modification
most: variable readonly
"
        );
    }

    #[test]
    fn a_spec_has_steps_transitions_and_states() {
        let text = "\
Grafcet G
Step X0, Xv1 for v1
Input s
Transitions:
t1: X0*s |- @Xv1
Steps:
Xv1: |- q
Never:
n1: s
//! accept v1 -> v2
";
        let spec = Spec::read(text.into());
        assert_eq!(
            shown(text, &tokens_in_spec(&spec)),
            "\
G: namespace declaration
X0: enumMember declaration
Xv1: enumMember declaration
v1: coil state
s: variable declaration
t1: event
X0: enumMember
s: variable
Xv1: enumMember modification
Xv1: enumMember
q: variable modification
n1: property declaration
s: variable
v1: coil state
v2: coil state
"
        );
    }

    #[test]
    fn every_word_stands_at_its_own_place() {
        for (at, kind) in TokenKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, at);
        }
        for (at, mark) in Mark::ALL.into_iter().enumerate() {
            assert_eq!(mark as usize, at);
        }
    }
}
