//! A scenario that somebody looks at: its names, its steps, and what comes of it
//! on a ladder, on a spec or on both.
//!
//! The ladder and the spec are a [`Pair`](crate::navigate::Pair), as for all
//! else; who calls decides which belong to the scenario. What comes of it is
//! worked out once, as a [`Run`], and then said in many ways.

mod hints;
mod lenses;
mod meaning;
mod run;
#[cfg(test)]
pub(crate) mod tests_of_runs;
mod tokens;

use std::sync::Arc;

use ::scenario::{Reading, Step};
use logic::Name;
use source::Span;

pub(crate) use hints::fields;
pub use hints::{hints_in_scenario, powered_in_ladder, situation_in_spec};
pub use lenses::{ScenarioLens, Shows, lenses_in_scenario};
pub(crate) use meaning::variable;
pub use meaning::{is_meant, meaning};
pub(crate) use run::most_scans;
pub use run::{Finding, Run, subject};
pub use tokens::tokens_in_scenario;

/// A scenario that somebody looks at.
#[derive(Debug)]
pub struct Scenario {
    /// The text, as the file or the editor has it.
    pub text: Arc<str>,
    /// What was read from it.
    pub reading: Reading,
}

/// A name where it stands in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepName<'s> {
    /// The name, without quotes.
    pub name: &'s Name,
    /// Where; quotes included.
    pub span: Span,
    /// Whether it is given a value there; else one is expected of it.
    pub is_driven: bool,
    /// The step, from 0.
    pub step: usize,
}

impl Scenario {
    /// Reads `text`, whatever it holds.
    pub fn read(text: Arc<str>) -> Self {
        Self {
            reading: ::scenario::read(&text),
            text,
        }
    }

    /// Its steps.
    pub fn steps(&self) -> &[Step] {
        &self.reading.scenario.steps
    }

    /// All names in its steps, in the order of the text.
    pub fn names(&self) -> impl Iterator<Item = StepName<'_>> {
        let steps = self.steps().iter().enumerate();
        steps.flat_map(|(step, it)| {
            let driven = it.changes.iter().map(move |change| StepName {
                name: &change.name,
                span: change.span,
                is_driven: true,
                step,
            });
            let expected = it.expected.iter().map(move |expectation| StepName {
                name: &expectation.name,
                span: expectation.named,
                is_driven: false,
                step,
            });
            driven.chain(expected)
        })
    }

    /// The name at the byte `offset`, or just before it.
    pub fn name_at(&self, offset: usize) -> Option<StepName<'_>> {
        self.names().find(|it| it.span.touches(offset))
    }

    /// The step whose line holds the byte `offset`, from 0.
    pub fn step_at(&self, offset: usize) -> Option<usize> {
        let line = crate::statement::line(&self.text, offset);
        let in_line = |step: &Step| line.contains(&step.span.range().start);
        self.steps().iter().position(in_line)
    }

    /// What stands for the scenario as a whole: the words of its title, else the
    /// word that it begins with. Never a variable, for a link would stand in the
    /// way to its coil.
    pub fn heading(&self) -> Option<Span> {
        let lines = crate::statement::lines(&self.text);
        let said = lines
            .into_iter()
            .map(|line| crate::statement::code(&self.text, line));
        let mut said = said.filter(|tokens| !tokens.is_empty());
        let title = |tokens: &Vec<logic::notation::Token>| {
            tokens.len() == 2 && tokens[0].text(&self.text) == "scenario"
        };
        let lines: Vec<_> = said.by_ref().collect();
        match lines.iter().find(|tokens| title(tokens)) {
            Some(tokens) => Some(tokens[1].span),
            None => {
                let first = lines.first()?.first()?;
                let is_word = ::scenario::WORDS.contains(&first.text(&self.text));
                Some(match is_word {
                    true => first.span,
                    false => Span::at(first.span.range().start),
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
// of a tank
scenario \"Filled\"
for tank.ladder

on s, \"Local:1\" = 5 => only on v1, \"a b\" > 2  // goes
wait 5s => off v1
";

    #[test]
    fn names_are_where_they_stand_in_steps() {
        let scenario = Scenario::read(TEXT.into());
        let shown = scenario.names().map(|it| {
            let mark = if it.is_driven { " driven" } else { "" };
            format!("{}: {}{mark}", it.step, &TEXT[it.span.range()])
        });
        assert_eq!(
            shown.collect::<Vec<_>>(),
            [
                "0: s driven",
                "0: \"Local:1\" driven",
                "0: v1",
                "0: \"a b\"",
                "1: v1"
            ]
        );
    }

    #[test]
    fn a_step_is_its_whole_line() {
        let scenario = Scenario::read(TEXT.into());
        let at = |part: &str| scenario.step_at(TEXT.find(part).expect("in the text"));
        assert_eq!(
            (at("on s"), at("goes"), at("wait")),
            (Some(0), Some(0), Some(1))
        );
        assert_eq!((at("// of"), at("for")), (None, None));
    }

    #[test]
    fn the_title_stands_for_it_else_its_first_word() {
        let heading = |text: &'static str| {
            let span = Scenario::read(text.into()).heading()?;
            Some(&text[span.range()])
        };
        assert_eq!(heading(TEXT), Some("\"Filled\""));
        assert_eq!(
            heading("\u{feff}// x\r\n on s => on q // y\r\n"),
            Some("on")
        );
        assert_eq!(heading("Level = 5\n"), Some(""));
        assert_eq!(heading("// nothing\n"), None);
    }
}
