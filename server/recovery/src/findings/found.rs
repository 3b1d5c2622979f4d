use ladder::{ElementKind, Program, Rung};
use petgraph::graph::NodeIndex;
use source::{Code, Diagnostic, Span};

use crate::conditions::Place;

/// A finding whose places are those of elements, so that it stays true when the
/// text around them is edited.
#[derive(Clone, Debug)]
pub(super) struct Found {
    code: Code,
    mark: Mark,
    message: Message,
    help: Option<String>,
    related: Vec<(Mark, Message)>,
}

/// What a finding points at.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mark {
    /// A whole element.
    Element(Place),
    /// The variable's name in it, where it has one.
    Name(Place),
}

/// A sentence, in which a rung may be named.
#[derive(Clone, Debug)]
pub(super) struct Message {
    before: String,
    rung: Option<Place>,
    after: &'static str,
}

impl From<String> for Message {
    fn from(text: String) -> Self {
        Self {
            before: text,
            rung: None,
            after: "",
        }
    }
}

impl From<&str> for Message {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl Message {
    /// The sentence that names the rung of a place between two texts.
    pub(super) fn naming(before: String, rung: Place, after: &'static str) -> Self {
        Self {
            before,
            rung: Some(rung),
            after,
        }
    }

    fn said(&self, program: &Program) -> String {
        match self.rung {
            Some(place) => format!("{}{}{}", self.before, name(program, place), self.after),
            None => self.before.clone(),
        }
    }
}

impl Found {
    pub(super) fn new(code: Code, mark: Mark, message: impl Into<Message>) -> Self {
        Self {
            code,
            mark,
            message: message.into(),
            help: None,
            related: Vec::new(),
        }
    }

    /// Adds what to do about it.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds another place that has to do with it.
    pub(super) fn related(mut self, mark: Mark, message: impl Into<Message>) -> Self {
        self.related.push((mark, message.into()));
        self
    }

    pub(super) fn code(&self) -> Code {
        self.code
    }

    pub(super) fn place(&self) -> Place {
        match self.mark {
            Mark::Element(place) | Mark::Name(place) => place,
        }
    }

    /// The finding as the text stands now.
    pub(super) fn told(&self, program: &Program) -> Diagnostic {
        let message = self.message.said(program);
        let mut told = Diagnostic::new(self.code, self.mark.span(program), message);
        told.help = self.help.clone();
        for (mark, message) in &self.related {
            told = told.related(mark.span(program), message.said(program));
        }
        told
    }
}

impl Mark {
    fn span(self, program: &Program) -> Span {
        let place = match self {
            Self::Element(place) => return place.span(program),
            Self::Name(place) => place,
        };
        let Some(rung) = rung(program, place).filter(|it| place.element < it.network.len()) else {
            return Span::default();
        };
        let element = rung.network.element(NodeIndex::new(place.element));
        match &element.kind {
            ElementKind::Coil(coil) => rung.place(coil.operand.within),
            ElementKind::Contact(contact) => rung.place(contact.operand.within),
            ElementKind::Assign(assignment) => rung.place(assignment.target.within),
            _ => rung.place(element.within),
        }
    }
}

fn rung(program: &Program, place: Place) -> Option<&Rung> {
    program.routines.get(place.routine)?.rungs.get(place.rung)
}

/// A rung as people name it: its routine and number.
fn name(program: &Program, place: Place) -> String {
    let routine = program.routines.get(place.routine);
    let named = routine.zip(rung(program, place));
    named.map_or_else(String::new, |(routine, rung)| routine.name_of(rung))
}
