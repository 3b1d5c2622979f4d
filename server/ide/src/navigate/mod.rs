//! From a name to the places that belong to it, in a ladder and in the spec
//! beside it.
//!
//! Both texts speak of the same things: a coil is a state, the state is a step
//! of the spec, the step's variable stands in its rules. A [`Subject`] is such a
//! thing, whichever text named it, so that one question has one answer in both:
//!
//! | from | [`definition`] leads to | [`declaration`] leads to |
//! |---|---|---|
//! | a contact | the coils that write it, else its declaration | its declaration |
//! | a coil | the step that stands for it, else its declaration | its declaration |
//! | a call, a jump | the routine, the label | |
//! | a step, a state, a variable of a spec | the coils, else its declaration | its declaration in the spec |
//! | a transition | its rule; from there its declaration | its declaration |

mod definition;
mod highlight;
mod references;
mod scenario;
mod subject;

use source::Span;

use crate::{Ladder, Spec};

pub use definition::{Jump, declaration, definition};
pub use highlight::highlights;
pub(crate) use references::is_part;
pub use references::references;
pub use scenario::{
    declaration_in_scenario, definition_in_scenario, highlights_in_scenario, references_in_scenario,
};
pub(crate) use scenario::{driving, standing};
pub use subject::{Subject, subject};
pub(crate) use subject::{of_state, state_of, written};

/// A ladder and the spec beside it, as far as they are there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pair<'a> {
    /// The ladder.
    pub ladder: Option<&'a Ladder>,
    /// The spec.
    pub spec: Option<&'a Spec>,
}

/// One of the two texts of a [`Pair`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The ladder.
    Ladder,
    /// The spec.
    Spec,
}

/// A place to go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Target {
    /// The text it is in.
    pub side: Side,
    /// All of it: an element, a rule.
    pub whole: Span,
    /// What names it.
    pub name: Span,
}

impl Target {
    pub(crate) fn new(side: Side, whole: Span, name: Span) -> Self {
        // Clients refuse a name outside of the whole.
        let whole = whole.cover(name);
        Self { side, whole, name }
    }
}

/// What happens to a thing at one of its places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Access {
    /// It is declared.
    Declared,
    /// Its value is read.
    Read,
    /// Its value is written.
    Written,
}

/// A place of a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Reference {
    /// The text it is in.
    pub side: Side,
    /// The bytes.
    pub span: Span,
    /// What happens there.
    pub access: Access,
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    /// The two texts with a cursor in one of them.
    pub(super) struct Fixture {
        pub(super) ladder: Ladder,
        pub(super) spec: Spec,
        pub(super) side: Side,
        pub(super) offset: usize,
    }

    impl Fixture {
        pub(super) fn new(ladder: &str, spec: &str) -> Self {
            let (side, offset) = match (ladder.find("$0"), spec.find("$0")) {
                (Some(at), None) => (Side::Ladder, at),
                (None, Some(at)) => (Side::Spec, at),
                _ => panic!("one cursor"),
            };
            Self {
                ladder: Ladder::read(ladder.replace("$0", "").into(), &Budget::default()),
                spec: Spec::read(spec.replace("$0", "").into()),
                side,
                offset,
            }
        }

        pub(super) fn pair(&self) -> Pair<'_> {
            Pair {
                ladder: Some(&self.ladder),
                spec: Some(&self.spec),
            }
        }

        /// `ladder 3: v1`: the line, counted from 1, and what stands there.
        pub(super) fn show(&self, side: Side, span: Span) -> String {
            let (word, text) = match side {
                Side::Ladder => ("ladder", &self.ladder.text),
                Side::Spec => ("spec", &self.spec.text),
            };
            let line = text[..span.range().start].matches('\n').count() + 1;
            format!("{word} {line}: {}", &text[span.range()])
        }
    }

    pub(super) const LADDER: &str = "\
input s
input ls2
output v1 %Q0
rung: (s + v1) * /ls2 -> v1
rung: v1 * ls2 + v2 * s -> v2
rung: v1 -> lamp
";

    pub(super) const SPEC: &str = "\
Step X0, Xv1 for v1
Transition t1
Input s
Marking X0
Transitions:
t1: X0*s |- @Xv1
//! accept v1 -> v2
";

    /// `text` with the cursor before the first `before` that ends with `at`.
    pub(super) fn with_cursor(text: &str, context: &str) -> String {
        let bare = context.replace("$0", "");
        assert!(text.contains(&bare), "{bare}");
        text.replacen(&bare, context, 1)
    }
}
