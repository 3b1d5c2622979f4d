use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

use ::ladder::{Edition, Format, Program, Routine, Rung, reread};
use logic::{Budget, Function, Name};
use petgraph::graph::NodeIndex;
use recovery::conditions::{Place, Walk, powers};
use recovery::successions::Sights;
use recovery::{Analysis, analyse, analyse_after};
use source::Diagnostic;

use crate::Names;

/// How many hints of one kind are told. A plant has thousands of rungs that read
/// a coil before and after it is written; nobody goes through them one by one,
/// and editors draw every one of them anew after each keystroke.
const HINTS: usize = 100;

/// A ladder that somebody looks at: its text, what was read from it and what
/// was recovered.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// The text, as the file or the editor has it.
    pub text: Arc<str>,
    /// The same with what was read from it.
    edition: Edition,
    /// What was recovered; it holds the program too.
    pub analysis: Analysis,
    names: OnceLock<Names>,
}

impl Ladder {
    /// Reads and analyses `text`, whatever it holds. When `budget` is cancelled
    /// the answer comes early and is not complete.
    pub fn read(text: Arc<str>, budget: &Budget) -> Self {
        Self::following(None, text, budget)
    }

    /// The same, where the ladder was `before` until somebody edited it: what
    /// the edit does not touch is kept.
    pub fn following(before: Option<&Self>, text: Arc<str>, budget: &Budget) -> Self {
        let edition = match before {
            Some(before) => reread(&before.edition, Arc::clone(&text)),
            None => Edition::new(Arc::clone(&text)),
        };
        let program = &edition.reading.program;
        Self {
            names: OnceLock::new(),
            analysis: match before {
                Some(before) => analyse_after(&before.analysis, program, budget),
                None => analyse(program, budget),
            },
            text,
            edition,
        }
    }

    /// The same with what a search through the sequences of inputs has seen.
    pub fn seeing(&self, sights: Sights) -> Self {
        Self {
            analysis: self.analysis.seeing(sights),
            ..self.clone()
        }
    }

    /// Where its names stand.
    pub fn names(&self) -> &Names {
        self.names
            .get_or_init(|| Names::new(self.program(), &self.text))
    }

    /// Whether everything was worked out to its end.
    pub fn is_whole(&self) -> bool {
        self.analysis.is_whole()
    }

    /// Findings about the text.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.edition.reading.diagnostics
    }

    /// The program.
    pub fn program(&self) -> &Program {
        &self.analysis.program
    }

    /// Whether the text is a ladder of any known form.
    pub fn is_known(&self) -> bool {
        self.program().format != Format::Unknown
    }

    /// The rung that holds a place, with its routine.
    pub fn rung(&self, place: Place) -> Option<(&Routine, &Rung)> {
        let routine = self.program().routines.get(place.routine)?;
        Some((routine, routine.rungs.get(place.rung)?))
    }

    /// The rung at the byte `offset`, as a place without an element. Elements of
    /// one rung may stand among those of another in XML; then it is the
    /// shortest that holds the byte.
    pub fn rung_at(&self, offset: usize) -> Option<Place> {
        let routines = self.program().routines.iter().enumerate();
        let rungs = routines.flat_map(|(routine, it)| {
            let rungs = it.rungs.iter().enumerate();
            rungs.map(move |(rung, it)| {
                (
                    Place {
                        routine,
                        rung,
                        element: 0,
                    },
                    it.span,
                )
            })
        });
        let holding = rungs.filter(|(_, span)| span.touches(offset));
        let shortest = holding.min_by_key(|(_, span)| span.len());
        shortest.map(|(place, _)| place)
    }

    /// Whether `name`, as an element gives it, is a variable: not a constant,
    /// not a term.
    pub fn is_variable(&self, name: &Name) -> bool {
        let known = self.program().declarations.find(name).is_some()
            || self.analysis.conditions.atoms.find_variable(name).is_some();
        let mut signs = name.chars();
        let begins = |c: char| c.is_alphabetic() || matches!(c, '_' | '%' | '\\');
        known
            || signs.next().is_some_and(begins)
                && signs.all(|c| c.is_alphanumeric() || "_.:[],\\".contains(c))
                && !["true", "false"]
                    .iter()
                    .any(|it| name.eq_ignore_ascii_case(it))
    }

    /// The condition under which the element at `place` gets power; `None` past
    /// the budget.
    pub fn power_at(&self, place: Place, budget: &Budget) -> Option<Function> {
        let (_, rung) = self.rung(place)?;
        let mut atoms = self.analysis.conditions.atoms.clone();
        let mut walk = Walk {
            atoms: &mut atoms,
            opaque: &mut HashSet::new(),
            budget,
        };
        let powers = powers(&rung.network, &mut walk);
        powers.at(NodeIndex::new(place.element)).ok().cloned()
    }

    /// Everything there is to say about the ladder, in the order of the places:
    /// about its text and about its meaning. Where there are hundreds of hints of
    /// one kind the first of them stand for all.
    pub fn findings(&self) -> Vec<Diagnostic> {
        let mut found = self.diagnostics().to_vec();
        if self.is_known() {
            found.extend(self.analysis.findings(HINTS));
        }
        found.sort_by_key(|finding| (finding.span, finding.code));
        found
    }
}
