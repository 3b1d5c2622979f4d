use logic::Name;
use source::Span;

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
    pub span: Span,
}

impl Operand {
    /// The operand `name`, written at `span`.
    pub fn new(name: impl Into<Name>, span: Span) -> Self {
        Self {
            name: name.into(),
            span,
        }
    }
}
