use logic::Name;
use source::Span;

use super::Within;

/// A variable as an element of a rung names it.
///
/// The name is canonical: readers fold aliases, addresses and, where the
/// format ignores case, spellings onto one name a variable, and prefix it with
/// its scope where two scopes declare the same. Equal names mean equal
/// variables in the whole program; `Word.3` is bit 3 of `Word`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Operand {
    /// The variable, or an arithmetic term or constant in the notation of the
    /// source where the element allows one.
    pub name: Name,
    /// Where it is written.
    pub within: Within,
}

impl Operand {
    /// The operand `name`, written at `span` of the file, for an element of a
    /// [`NetworkBuilder`](super::NetworkBuilder).
    pub fn new(name: impl Into<Name>, span: Span) -> Self {
        Self {
            name: name.into(),
            within: Within::in_file(span),
        }
    }

    /// Another variable, written at the same place.
    pub fn renamed(&self, name: impl Into<Name>) -> Self {
        Self {
            name: name.into(),
            within: self.within,
        }
    }
}
