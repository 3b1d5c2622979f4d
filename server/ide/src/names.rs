//! Where the names of a ladder stand.
//!
//! A hover, a jump, a renaming begin with a place in the text and need what is
//! written there; or begin with a name and need all its places.

use std::collections::HashMap;

use ::ladder::{Declaration, Element, Program, Rung};
use logic::Name;
use petgraph::graph::NodeIndex;
use recovery::conditions::Place;
use source::Span;

/// A name where it stands in a ladder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mention {
    /// The variable.
    pub name: Name,
    /// The bytes that name it.
    pub span: Span,
    /// What happens to it there.
    pub usage: Usage,
    /// The element that names it; `None` where it is declared.
    pub place: Option<Place>,
}

/// What happens to a variable where it is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Usage {
    /// It is declared.
    Declared,
    /// Its value is read.
    Read,
    /// Its value is written.
    Written,
}

/// All names of a ladder, and all elements, by their places.
#[derive(Clone, Debug, Default)]
pub struct Names {
    mentions: Vec<Mention>,
    of: HashMap<Name, Vec<usize>>,
    elements: Vec<(Span, Place)>,
    /// For each element, where the farthest of those up to it ends: elements
    /// may hold others.
    reach: Vec<u32>,
}

impl Names {
    /// Finds all names of `program`, which was read from `text`.
    pub fn new(program: &Program, text: &str) -> Self {
        let mut names = Self::default();
        for declaration in program.declarations.iter() {
            names.mentions.push(Mention {
                name: declaration.name.clone(),
                span: name_span(declaration, text),
                usage: Usage::Declared,
                place: None,
            });
        }
        for (at, routine) in program.routines.iter().enumerate() {
            for (rung, within) in routine.rungs.iter().enumerate() {
                for (element, it) in within.network.elements().skip(1) {
                    let place = Place {
                        routine: at,
                        rung,
                        element: element.index(),
                    };
                    names.elements.push((within.place(it.within), place));
                    names.add_operands(within, &it.kind, place);
                }
            }
        }
        names.sort();
        names
    }

    fn add_operands(&mut self, rung: &Rung, kind: &::ladder::ElementKind, place: Place) {
        let reads = kind.reads().into_iter().map(|it| (it, Usage::Read));
        let writes = kind.writes().into_iter().map(|it| (it, Usage::Written));
        for (operand, usage) in reads.chain(writes) {
            self.mentions.push(Mention {
                name: operand.name.clone(),
                span: rung.place(operand.within),
                usage,
                place: Some(place),
            });
        }
    }

    fn sort(&mut self) {
        self.mentions
            .sort_by_key(|it| (it.span, it.place.is_some()));
        self.elements.sort();
        for (at, mention) in self.mentions.iter().enumerate() {
            self.of.entry(mention.name.clone()).or_default().push(at);
        }
        let mut farthest = 0;
        for (span, _) in &self.elements {
            farthest = farthest.max(span.end);
            self.reach.push(farthest);
        }
    }

    /// The name at the byte `offset`, or just before it.
    pub fn at(&self, offset: usize) -> Option<&Mention> {
        let after = self
            .mentions
            .partition_point(|it| it.span.range().start <= offset);
        let last = self.mentions.get(after.checked_sub(1)?)?;
        last.span.touches(offset).then_some(last)
    }

    /// All places of the variable called `name`, in the order of the text.
    pub fn of(&self, name: &str) -> impl Iterator<Item = &Mention> {
        let places = self.of.get(name).map_or(&[][..], Vec::as_slice);
        places.iter().map(|&at| &self.mentions[at])
    }

    /// All names, in the order of the text.
    pub fn all(&self) -> &[Mention] {
        &self.mentions
    }

    /// The innermost element at the byte `offset`, or just before it.
    pub fn element_at(&self, offset: usize) -> Option<Place> {
        let after = self
            .elements
            .partition_point(|(span, _)| span.range().start <= offset);
        let mut before = self.elements[..after].iter().zip(&self.reach).rev();
        let found = before
            .by_ref()
            .take_while(|(_, reach)| **reach as usize >= offset)
            .find(|((span, _), _)| span.touches(offset))?;
        Some(found.0.1)
    }
}

/// The bytes of the name in a declaration: the first word in it that is the
/// name, or the part of the name after its scope. Names of one variable may
/// differ in case where the format ignores it.
fn name_span(declaration: &Declaration, text: &str) -> Span {
    let whole = declaration.span.range();
    let Some(written) = text.get(whole.clone()) else {
        return declaration.span;
    };
    let name = &*declaration.name;
    let local = name.rsplit(['/', ':']).next().unwrap_or(name);
    let found = [name, local]
        .into_iter()
        .filter(|name| !name.is_empty())
        .find_map(|name| Some((word(written, name)?, name.len())));
    match found {
        Some((at, length)) => Span::new(whole.start + at, whole.start + at + length),
        None => declaration.span,
    }
}

/// Where `word` stands in `text` as a whole word.
pub(crate) fn word(text: &str, word: &str) -> Option<usize> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let same = |at: usize| {
        let here = text.get(at..at + word.len());
        here.is_some_and(|here| here.eq_ignore_ascii_case(word))
    };
    text.char_indices().map(|(at, _)| at).find(|&at| {
        same(at) && !text[..at].ends_with(is_part) && !text[at + word.len()..].starts_with(is_part)
    })
}

/// The element at a place of a program, with its rung.
pub fn element(program: &Program, place: Place) -> Option<(&Rung, &Element)> {
    let rung = program.routines.get(place.routine)?.rungs.get(place.rung)?;
    let exists = place.element < rung.network.len();
    exists.then(|| (rung, rung.network.element(NodeIndex::new(place.element))))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is named at `$0`.
    fn at_cursor(text: &str) -> Option<(String, Usage)> {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let reading = ::ladder::read(text.as_bytes());
        let names = Names::new(&reading.program, &text);
        let mention = names.at(offset)?;
        assert_eq!(&text[mention.span.range()], &*mention.name);
        Some((mention.name.to_string(), mention.usage))
    }

    #[test]
    fn a_name_is_found_from_its_first_byte_to_the_caret_behind_it() {
        let read = Some(("start".to_owned(), Usage::Read));
        assert_eq!(at_cursor("rung: $0start -> run"), read);
        assert_eq!(at_cursor("rung: start$0 -> run"), read);
        assert_eq!(at_cursor("rung: /st$0art -> run"), read);
        assert_eq!(at_cursor("$0rung: start -> run"), None);
    }

    #[test]
    fn coils_write_and_declarations_declare() {
        let written = Some(("run".to_owned(), Usage::Written));
        assert_eq!(at_cursor("rung: start -> r$0un"), written);
        let declared = Some(("put".to_owned(), Usage::Declared));
        assert_eq!(
            at_cursor("input p$0ut // put on\nrung: put -> run"),
            declared
        );
    }

    #[test]
    fn the_innermost_element_is_found() {
        let text = "rung: (a + b) -> TON(t1, 5s)";
        let reading = ::ladder::read(text.as_bytes());
        let names = Names::new(&reading.program, text);
        let found = |part: &str| {
            let place = names.element_at(text.find(part).expect("in the text"))?;
            let (rung, element) = element(&reading.program, place)?;
            Some(&text[rung.place(element.within).range()])
        };
        assert_eq!(found("b)"), Some("b"));
        assert_eq!(found("t1"), Some("TON(t1, 5s)"));
        assert_eq!(found("a"), Some("a"));
        assert_eq!(found("rung"), None);
    }
}
