use std::collections::hash_map::Entry;
use std::sync::Arc;

use foldhash::HashMap;
use logic::Name;
use source::Span;

use crate::shift::Shift;

/// What a declared variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// Comes from the plant or the caller.
    Input,
    /// Goes to the plant or the caller.
    Output,
    /// Both.
    InOut,
    /// Kept inside.
    Internal,
    /// Never changes.
    Constant,
    /// Declared without a purpose, or elsewhere (external, alias).
    Unknown,
}

/// A variable that the source declares.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declaration {
    /// Its canonical name, as operands give it.
    pub name: Name,
    /// Its address: `%QX0.1`, `Local:1:I.Data.4`.
    pub address: Option<Name>,
    /// What the source says about it.
    pub description: Option<Name>,
    /// What it is for.
    pub class: Class,
    /// Its type in the source's notation: `BOOL`, `TIMER`.
    pub data_type: Option<Name>,
    /// Its initial value in the source's notation.
    pub initial: Option<Name>,
    /// Where it is declared.
    pub span: Span,
}

impl Declaration {
    /// A declaration of `name` at `span` with nothing else said.
    pub fn new(name: impl Into<Name>, class: Class, span: Span) -> Self {
        Self {
            name: name.into(),
            address: None,
            description: None,
            class,
            data_type: None,
            initial: None,
            span,
        }
    }
}

/// The declarations of a program in the order of the source, found by name.
/// A clone costs nothing.
#[derive(Clone, Debug, Default)]
pub struct Declarations {
    list: Arc<Vec<Declaration>>,
    places: Arc<HashMap<Name, usize>>,
}

impl PartialEq for Declarations {
    fn eq(&self, other: &Self) -> bool {
        self.list == other.list
    }
}

impl Declarations {
    /// Adds a declaration. If the name has one already the first stays found
    /// by name, and its place is the answer.
    pub fn add(&mut self, declaration: Declaration) -> Option<&Declaration> {
        let place = self.list.len();
        let name = declaration.name.clone();
        let list = Arc::make_mut(&mut self.list);
        list.push(declaration);
        match Arc::make_mut(&mut self.places).entry(name) {
            Entry::Vacant(free) => {
                free.insert(place);
                None
            }
            Entry::Occupied(taken) => Some(&list[*taken.get()]),
        }
    }

    /// All of them after an edit of other statements.
    pub(crate) fn shifted(&self, shift: Shift) -> Self {
        let mut shifted = self.clone();
        if shift.by != 0 && self.iter().any(|it| shift.moves(it.span.start)) {
            for declaration in Arc::make_mut(&mut shifted.list) {
                declaration.span = shift.span(declaration.span);
            }
        }
        shifted
    }

    /// The declaration of `name`.
    pub fn find(&self, name: &str) -> Option<&Declaration> {
        self.places.get(name).map(|&at| &self.list[at])
    }

    /// The place of the declaration of `name` in the order of the source.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Whether both declare the same, perhaps in other places of the text, and
    /// that can be told at a glance.
    pub fn is_moved(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.places, &other.places)
    }

    /// All, in the order of the source.
    pub fn iter(&self) -> std::slice::Iter<'_, Declaration> {
        self.list.iter()
    }

    /// Number of declarations.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether nothing is declared.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}
