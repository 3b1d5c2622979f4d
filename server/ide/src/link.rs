//! Where a text names the one beside it.

use ::ladder::Role as RoutineRole;
use grafcet::Role;
use source::Span;

use crate::{Ladder, Spec};

/// The bytes of a ladder that stand for its spec: the program's name, else the
/// first routine's.
pub fn link_in_ladder(ladder: &Ladder) -> Option<Span> {
    let routines = &ladder.program().routines;
    // The bodies of blocks come first in exports; nobody calls the program by
    // their names.
    let own = routines
        .iter()
        .find(|it| it.role != RoutineRole::Definition);
    let routine = own.or(routines.first())?;
    let name = match routine.unit.is_empty() {
        true => None,
        false => ladder.unit_name(routine),
    };
    name.or_else(|| ladder.routine_name(routine))
}

/// The bytes of a spec that stand for its ladder: the grafcet's name, else the
/// first line.
pub fn link_in_spec(spec: &Spec) -> Option<Span> {
    let mut mentions = spec.reading.places.mentions.iter();
    let name = mentions.find(|it| it.role == Role::Grafcet && it.declares);
    if let Some(name) = name {
        return Some(name.span);
    }
    let said = spec
        .text
        .trim_start_matches(['\u{feff}', '\r', '\n', ' ', '\t']);
    let start = spec.text.len() - said.len();
    let line = said
        .split(['\r', '\n'])
        .next()
        .unwrap_or_default()
        .trim_end();
    (!line.is_empty()).then(|| Span::new(start, start + line.len()))
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    fn in_ladder(text: &str) -> Option<(usize, &str)> {
        let ladder = Ladder::read(text.into(), &Budget::default());
        let range = link_in_ladder(&ladder)?.range();
        Some((range.start, &text[range]))
    }

    #[test]
    fn a_ladder_is_linked_where_it_names_itself() {
        assert_eq!(
            in_ladder("program Tank\nrung: a -> Tank"),
            Some((8, "Tank"))
        );
        assert_eq!(
            in_ladder("routine Doors main\nrung: a -> b"),
            Some((8, "Doors"))
        );
        assert_eq!(in_ladder("rung: a -> b"), None);
        assert_eq!(in_ladder(""), None);
    }

    #[test]
    fn a_block_does_not_stand_for_the_program() {
        let text = "routine Valve block\nrung: a -> b\n\nroutine Doors main\nrung: a -> b";
        assert_eq!(in_ladder(text), Some((42, "Doors")));
    }

    #[test]
    fn a_spec_is_linked_at_its_name_or_its_first_line() {
        let linked = |text: &'static str| {
            let span = link_in_spec(&Spec::read(text.into()))?;
            Some(&text[span.range()])
        };
        assert_eq!(linked("// of\nGrafcet Tank\nStep X0"), Some("Tank"));
        assert_eq!(linked("\u{feff}\r\n  Step X0 \r\nStep X1"), Some("Step X0"));
        assert_eq!(linked(" \n"), None);
    }
}
