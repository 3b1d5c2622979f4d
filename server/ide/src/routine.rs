//! Where the names of routines are written.

use ::ladder::{Format, Program, Routine};
use source::Span;

use crate::Ladder;
use crate::names::word;

impl Ladder {
    /// The bytes that name a routine: in its heading, else in the heading of
    /// the unit around it. `None` where nothing in the text names it.
    pub fn routine_name(&self, routine: &Routine) -> Option<Span> {
        routine_name(self.program(), &self.text, routine)
    }

    /// The bytes that name the unit, a program or a POU, that a routine belongs
    /// to.
    pub fn unit_name(&self, routine: &Routine) -> Option<Span> {
        unit_name(self.program(), &self.text, routine)
    }
}

/// The same of a program that was read from `text` and not analysed.
pub(crate) fn routine_name(program: &Program, text: &str, routine: &Routine) -> Option<Span> {
    let whole = routine.span.range();
    let first_rung = routine.rungs.first().map_or(whole.end, |rung| {
        rung.span.range().start.clamp(whole.start, whole.end)
    });
    let heading = text.get(whole.start..first_rung)?;
    // A heading is one line, or one tag of XML.
    let end = heading.find(['\n', '\r', '>']).unwrap_or(heading.len());
    let at = |start: usize| Some(Span::new(start, start + routine.name.len()));
    if let Some(found) = word(&heading[..end], &routine.name) {
        return at(whole.start + found);
    }
    named_before(program, text, whole.start.max(first_rung), &routine.name)
}

/// The same of a program that was read from `text` and not analysed.
pub(crate) fn unit_name(program: &Program, text: &str, routine: &Routine) -> Option<Span> {
    named_before(program, text, routine.span.range().start, &routine.unit)
}

/// The last heading before the byte `end` that names a unit `name`.
fn named_before(program: &Program, text: &str, end: usize, name: &str) -> Option<Span> {
    let before = text.get(..end)?;
    let start = match program.format {
        Format::Ladder => program_line(before, name)?,
        Format::Plcopen | Format::L5x => {
            let attribute = |quote: char| {
                let written = format!("ame={quote}{name}{quote}");
                Some(before.rfind(&written)? + "ame=.".len())
            };
            attribute('"').or_else(|| attribute('\''))?
        }
        Format::L5k => {
            let words = ["PROGRAM ", "ADD_ON_INSTRUCTION_DEFINITION "];
            let heading = |word: &str| Some(before.rfind(&format!("{word}{name} "))? + word.len());
            words.into_iter().find_map(heading)?
        }
        _ => return None,
    };
    Some(Span::new(start, start + name.len()))
}

/// Where the last line `program NAME` of `text` has the name.
fn program_line(text: &str, name: &str) -> Option<usize> {
    let mut end = text.len();
    while end > 0 {
        let start = text[..end].rfind(['\n', '\r']).map_or(0, |at| at + 1);
        let line = &text[start..end];
        let begun = line.trim_start_matches(['\u{feff}', ' ', '\t']);
        if let Some(keyword) = begun.get(.."program".len())
            && keyword.eq_ignore_ascii_case("program")
        {
            let behind = start + line.len() - begun.len() + keyword.len();
            return Some(behind + word(&text[behind..end], name)?);
        }
        end = start.saturating_sub(1);
    }
    None
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    /// What stands before the name of every routine, on its line.
    fn names(text: &str) -> Vec<Option<String>> {
        let ladder = Ladder::read(text.into(), &Budget::default());
        let routines = ladder.program().routines.iter();
        let before = routines.map(|routine| {
            let span = ladder.routine_name(routine)?.range();
            assert_eq!(&text[span.clone()], &*routine.name);
            let line = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
            Some(text[line..span.start].trim().to_owned())
        });
        before.collect()
    }

    fn found(before: &str) -> Option<String> {
        Some(before.to_owned())
    }

    #[test]
    fn a_routine_is_named_in_its_line_and_the_main_one_in_the_programs() {
        let text =
            "program Tank\r\ninput Tank\r\nrung: a -> b\r\n\r\nroutine Doors\r\nrung: c -> d";
        assert_eq!(names(text), [found("program"), found("routine")]);
    }

    #[test]
    fn a_ladder_without_a_name_has_none() {
        assert_eq!(names("rung: main -> b"), [None]);
    }

    #[test]
    fn in_l5k_routines_and_units_have_headings() {
        let l5k = include_str!("../../../fixtures/rockwell/conveyor.L5K");
        let headings = names(l5k);
        assert_eq!(headings[0], found("ROUTINE"));
        let ladder = Ladder::read(l5k.into(), &Budget::default());
        let units = ladder.program().routines.iter().map(|routine| {
            let span = ladder.unit_name(routine)?;
            let line = l5k[..span.range().start].rfind('\n')?;
            Some(l5k[line..span.range().end].trim().to_owned())
        });
        let mut units: Vec<_> = units.collect();
        units.dedup();
        assert_eq!(
            units,
            [
                found("PROGRAM Belts"),
                found("PROGRAM Idle"),
                found("ADD_ON_INSTRUCTION_DEFINITION Jam")
            ]
        );
    }

    #[test]
    fn in_xml_the_attribute_names_it() {
        let l5x = include_str!("../../../fixtures/neutralization/neutralization.L5X");
        assert_eq!(names(l5x), [found("<Routine Name=\"")]);
        let plcopen = include_str!("../../../fixtures/neutralization/neutralization.xml");
        assert_eq!(names(plcopen), [found("<pou name=\"")]);
    }
}
