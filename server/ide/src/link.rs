//! Where a text names the one beside it.

use ::ladder::{Format, Role as RoutineRole};
use grafcet::Role;
use source::Span;

use crate::{Ladder, Scenario, Spec};

/// The bytes of a ladder that stand for its spec: the program's name, else the
/// first routine's, else how the text begins: a comment, or a word of the
/// notation. Never a variable, for a link would stand in the way to its coil.
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
        .or_else(|| beginning(ladder))
}

fn beginning(ladder: &Ladder) -> Option<Span> {
    if ladder.program().format != Format::Ladder {
        return None;
    }
    let (start, line) = first_line(&ladder.text)?;
    let is_word = |c: &char| c.is_alphanumeric();
    let length = match line.starts_with("//") {
        true => line.len(),
        false => line.chars().take_while(is_word).map(char::len_utf8).sum(),
    };
    (length > 0).then(|| Span::new(start, start + length))
}

/// The first line of `text` that holds something, without the blanks around it,
/// and where it begins.
fn first_line(text: &str) -> Option<(usize, &str)> {
    let said = text.trim_start_matches(['\u{feff}', '\r', '\n', ' ', '\t']);
    let line = said.split(['\r', '\n']).next().unwrap_or_default();
    let line = line.trim_end();
    (!line.is_empty()).then_some((text.len() - said.len(), line))
}

/// The bytes of a spec that stand for its ladder: the grafcet's name, else the
/// first line.
pub fn link_in_spec(spec: &Spec) -> Option<Span> {
    let mut mentions = spec.reading.places.mentions.iter();
    let name = mentions.find(|it| it.role == Role::Grafcet && it.declares);
    if let Some(name) = name {
        return Some(name.span);
    }
    let (start, line) = first_line(&spec.text)?;
    Some(Span::new(start, start + line.len()))
}

/// The bytes of a scenario that stand for files: each name behind `for`.
pub fn links_in_scenario(scenario: &Scenario) -> impl Iterator<Item = (Span, &str)> {
    let files = scenario.reading.scenario.files.iter();
    files.map(|file| (file.span, &*file.path))
}

/// Where a text, of whatever kind, names the file called `name`: in comments,
/// since nothing else of it speaks of files.
pub fn namings_of<'t>(text: &'t str, name: &'t str) -> impl Iterator<Item = Span> + 't {
    let is_part = |c: char| c.is_alphanumeric() || "_-.".contains(c);
    let places = text.match_indices(name);
    places.filter_map(move |(at, _)| {
        let end = at + name.len();
        let goes_on = text[end..].trim_start_matches('.').starts_with(is_part);
        let is_whole = !text[..at].ends_with(is_part) && !goes_on && !name.is_empty();
        is_whole.then(|| Span::new(at, end))
    })
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
        assert_eq!(in_ladder(""), None);
    }

    #[test]
    fn a_ladder_without_a_name_is_linked_where_it_begins() {
        assert_eq!(in_ladder("\nrung: a -> b"), Some((1, "rung")));
        assert_eq!(
            in_ladder("\u{feff}// Tänk \r\nrung: a -> b"),
            Some((3, "// Tänk"))
        );
        assert_eq!(in_ladder("XIC(a)OTE(b);"), None);
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

    #[test]
    fn a_scenario_is_linked_where_it_names_files() {
        let text = "scenario \"x\"\nfor tank.ladder, \"a b.grafcet\"\non s\n";
        let scenario = Scenario::read(text.into());
        let links: Vec<_> = links_in_scenario(&scenario)
            .map(|(span, path)| (&text[span.range()], path))
            .collect();
        assert_eq!(
            links,
            [
                ("tank.ladder", "tank.ladder"),
                ("\"a b.grafcet\"", "a b.grafcet")
            ]
        );
    }

    #[test]
    fn a_file_is_named_by_its_whole_name() {
        let text = "// fill.scenario, see refill.scenario\n// and fill.scenario.\n";
        let at = namings_of(text, "fill.scenario").map(|it| it.start);
        assert_eq!(at.collect::<Vec<_>>(), [3, 45]);
        assert_eq!(namings_of(text, "").count(), 0);
    }
}
