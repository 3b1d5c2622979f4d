//! What stands above a rung or a step: how its decisions stand.

use std::collections::HashMap;

use grafcet::Role;
use logic::Name;
use recovery::successions::Evidence;
use source::Span;

use crate::{Decided, Ladder, Spec, Standing};

/// A line above a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lens {
    /// The place.
    pub span: Span,
    /// What it says.
    pub title: String,
}

/// How many pairs of states stand how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Accepted, or read off a write and not rejected.
    pub accepted: usize,
    /// Not decided, of those that are shown.
    pub open: usize,
    /// Rejected.
    pub rejected: usize,
}

impl Count {
    fn add(&mut self, standing: Standing, evidence: Evidence, weakest: Evidence) {
        match standing {
            Standing::Rejected => self.rejected += 1,
            Standing::Accepted => self.accepted += 1,
            Standing::Open if evidence == Evidence::Written => self.accepted += 1,
            Standing::Open if evidence <= weakest => self.open += 1,
            Standing::Open => {}
        }
    }

    fn join(&mut self, other: Self) {
        self.accepted += other.accepted;
        self.open += other.open;
        self.rejected += other.rejected;
    }

    /// `4 may follow · 2 accepted · 1 rejected`; `None` if there is nothing to
    /// say.
    fn said(self) -> Option<String> {
        let parts = [
            (self.open, "may follow"),
            (self.accepted, "accepted"),
            (self.rejected, "rejected"),
        ];
        let parts = parts.into_iter().filter(|(count, _)| *count > 0);
        let said: Vec<String> = parts
            .map(|(count, word)| format!("{count} {word}"))
            .collect();
        (!said.is_empty()).then(|| said.join(" · "))
    }
}

/// How the pairs of states stand, by the state before. Of those that are open,
/// only suggestions at least as strong as `weakest` count.
fn counts<'l>(
    ladder: &'l Ladder,
    spec: Option<&Spec>,
    weakest: Evidence,
) -> HashMap<&'l Name, Count> {
    let decided = spec.map(Decided::of).unwrap_or_default();
    let mut counts: HashMap<&Name, Count> = HashMap::new();
    for succession in ladder.analysis.successions() {
        let standing = decided.standing(&succession.from, &succession.to);
        let count = counts.entry(&succession.from).or_default();
        count.add(standing, succession.evidence, weakest);
    }
    counts
}

/// How all pairs of a ladder stand together.
pub fn count(ladder: &Ladder, spec: Option<&Spec>, weakest: Evidence) -> Count {
    let mut all = Count::default();
    counts(ladder, spec, weakest)
        .into_values()
        .for_each(|count| all.join(count));
    all
}

/// The lenses of a ladder: one above each rung that writes states about which
/// something is suggested or decided.
pub fn lenses_in_ladder(ladder: &Ladder, spec: Option<&Spec>, weakest: Evidence) -> Vec<Lens> {
    let counts = counts(ladder, spec, weakest);
    let registers = &ladder.analysis.registers;
    let mut lenses = Vec::new();
    for (_, rung) in ladder.program().rungs() {
        let mut sum = Count::default();
        let mut written: Vec<&Name> = rung
            .network
            .elements()
            .flat_map(|(_, element)| element.kind.writes())
            .map(|operand| &operand.name)
            .collect();
        written.sort();
        written.dedup();
        for name in written {
            if let Some(count) = counts.get(name) {
                sum.join(*count);
            }
        }
        let moves = registers.iter().flat_map(|register| &register.arcs);
        sum.accepted += moves
            .flat_map(|arc| &arc.written_at)
            .filter(|(_, at)| rung.span.start <= at.start && at.end <= rung.span.end)
            .count();
        if let Some(title) = sum.said() {
            lenses.push(Lens {
                span: rung.span,
                title,
            });
        }
    }
    lenses
}

/// The lenses of a spec: one above the declaration of each step that stands for
/// a state.
pub fn lenses_in_spec(spec: &Spec, ladder: &Ladder, weakest: Evidence) -> Vec<Lens> {
    let counts = counts(ladder, Some(spec), weakest);
    let grafcet = &spec.reading.spec.grafcet;
    let states: HashMap<&Name, &Name> = grafcet
        .steps()
        .filter_map(|step| Some((&step.name, step.state.as_ref()?)))
        .collect();
    let mentions = spec.reading.places.mentions.iter();
    let steps = mentions.filter(|it| it.declares && it.role == Role::Step);
    let found = steps.filter_map(|mention| {
        let state = states.get(&mention.name)?;
        Some(Lens {
            span: mention.span,
            title: counts.get(*state)?.said()?,
        })
    });
    found.collect()
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    const TANK: &str = "\
rung: (s + v1) * /ls2 -> v1
rung: (ls2 + v2) * s -> v2
rung: v2 -> lamp
";

    fn said(lenses: &[Lens], text: &str) -> Vec<String> {
        let place = |lens: &Lens| {
            text[lens.span.range()]
                .lines()
                .next()
                .unwrap_or("")
                .to_owned()
        };
        let all = lenses.iter();
        all.map(|lens| format!("{}: {}", place(lens), lens.title))
            .collect()
    }

    #[test]
    fn a_rung_says_how_its_state_stands() {
        let ladder = Ladder::read(TANK.into(), &Budget::default());
        let lenses = lenses_in_ladder(&ladder, None, Evidence::Possible);
        assert_eq!(
            said(&lenses, TANK),
            [
                "rung: (s + v1) * /ls2 -> v1: 1 may follow",
                "rung: (ls2 + v2) * s -> v2: 1 may follow",
            ]
        );
        let spec = Spec::read("Step Xv1 for v1\n//! accept v1 -> v2\n//! reject v2 -> v1\n".into());
        let lenses = lenses_in_ladder(&ladder, Some(&spec), Evidence::Possible);
        let titles: Vec<&str> = lenses.iter().map(|lens| &*lens.title).collect();
        assert_eq!(titles, ["1 accepted", "1 rejected"]);
        let lenses = lenses_in_spec(&spec, &ladder, Evidence::Possible);
        assert_eq!(said(&lenses, &spec.text), ["Xv1: 1 accepted"]);
    }

    #[test]
    fn weaker_suggestions_can_be_left_out() {
        let ladder = Ladder::read(TANK.into(), &Budget::default());
        let all = count(&ladder, None, Evidence::Possible);
        let strong = count(&ladder, None, Evidence::Handover);
        assert_eq!((all.open, strong.open), (2, 1));
    }
}
