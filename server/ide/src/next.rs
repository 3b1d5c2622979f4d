//! What a spec may say next: rules that the ladder gives and the spec lacks,
//! and decisions that nobody has made.

use grafcet::{Decision, Verdict, action_rule, decision_text, transition_rule};
use logic::{Budget, Name};
use recovery::conversion::{Departure, update};
use recovery::successions::{Evidence, Kind, Succession};
use source::Span;

use crate::section::{Section, section};
use crate::{Decided, Ladder, Spec, Standing, legible, statement};

/// A line that a spec may hold next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Next {
    /// The whole line.
    pub line: String,
    /// What it is.
    pub kind: NextKind,
    /// What it rests on, in a word or two.
    pub evidence: String,
    /// Why it is suggested, in sentences.
    pub reason: String,
}

/// What a suggested line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NextKind {
    /// A rule of a transition.
    Transition,
    /// A rule of an action.
    Action,
    /// A decision.
    Decision,
}

/// Lines that `spec` may hold next, best first: what the ladder gives for the
/// decisions that are made, then decisions that are open, those of weaker
/// evidence than `weakest` left out.
pub fn next(spec: &Spec, ladder: &Ladder, weakest: Evidence, budget: &Budget) -> Vec<Next> {
    let mut lines = missing_rules(spec, ladder, budget);
    lines.extend(open_decisions(spec, ladder, weakest, budget));
    lines
}

/// Lines that the line with a caret at the byte `offset` may become, best first,
/// and the bytes that they replace. Nothing where something stands behind the
/// caret; decisions only behind all else, or where one is begun.
pub fn next_at(
    spec: &Spec,
    ladder: &Ladder,
    offset: usize,
    weakest: Evidence,
    budget: &Budget,
) -> Option<(Span, Vec<Next>)> {
    let text = &*spec.text;
    let offset = statement::boundary(text, offset);
    let line = statement::line(text, offset);
    let before = text.get(line.start..offset)?.trim_start_matches('\u{feff}');
    let typed = before.trim_start();
    let is_alone = text.get(offset..line.end)?.trim().is_empty();
    if !is_alone || statement::in_spec(text, offset).start < line.start {
        return None;
    }
    let section = section(text, line.start);
    let ends_text = statement::code(text, line.end..text.len()).is_empty();
    let decides = typed.starts_with("//!") || typed.is_empty() && ends_text;
    if !decides && !matches!(section, Section::Transitions | Section::Steps) {
        return None;
    }
    let mut lines = next(spec, ladder, weakest, budget);
    lines.retain(|it| {
        let wanted = it.kind != NextKind::Decision || decides;
        wanted && it.fits(section) && it.line.starts_with(typed) && it.line != typed
    });
    let span = Span::new(offset - typed.len(), line.end);
    Some((span, lines)).filter(|(_, lines)| !lines.is_empty())
}

impl Next {
    /// Whether the line can stand in a section.
    pub(crate) fn fits(&self, section: Section) -> bool {
        match self.kind {
            NextKind::Transition => section == Section::Transitions,
            NextKind::Action => section == Section::Steps,
            NextKind::Decision => true,
        }
    }
}

fn missing_rules(spec: &Spec, ladder: &Ladder, budget: &Budget) -> Vec<Next> {
    let made = &spec.reading.spec;
    let updated = update(&ladder.analysis, made, &made.decisions, budget);
    let rule = |departure: &Departure| {
        let (line, kind, what) = match departure {
            Departure::MissingTransition(transition) => (
                transition_rule(transition, &made.grafcet),
                NextKind::Transition,
                format!(
                    "The ladder goes from {} to {} on {}; the spec has no such rule.",
                    transition.from.join(" and "),
                    transition.to.join(" and "),
                    transition.receptivity
                ),
            ),
            Departure::MissingAction(action) => (
                action_rule(action),
                NextKind::Action,
                format!(
                    "The ladder writes {} while {} is active; the spec has no such rule.",
                    action.output, action.step
                ),
            ),
            Departure::Transition { .. } | Departure::Action { .. } => return None,
        };
        Some(Next {
            line,
            kind,
            evidence: "the ladder gives it".to_owned(),
            reason: what,
        })
    };
    updated.departures.iter().filter_map(rule).collect()
}

/// Past these many nobody looks, and each costs a condition to be said.
const MOST_DECISIONS: usize = 100;

fn open_decisions(spec: &Spec, ladder: &Ladder, weakest: Evidence, budget: &Budget) -> Vec<Next> {
    let decided = Decided::of(spec);
    let open: Vec<&Succession> = followers(ladder, &decided, weakest).collect();
    let mut lines = Vec::new();
    let mut said: Vec<(&Name, Evidence)> = Vec::new();
    for succession in &open {
        if lines.len() == MOST_DECISIONS {
            break;
        }
        let company: Vec<&Succession> = match succession.kind {
            Kind::Or => vec![succession],
            Kind::And => {
                let group = (&succession.from, succession.evidence);
                if said.contains(&group) {
                    continue;
                }
                said.push(group);
                let same =
                    |it: &&&Succession| it.kind == Kind::And && (&it.from, it.evidence) == group;
                open.iter().filter(same).copied().collect()
            }
        };
        lines.push(decision(&company, ladder, budget));
    }
    lines
}

/// The successions that are suggested and about which nothing is decided, best
/// first. Arcs of registers are read off the program and need no decision.
pub(crate) fn followers<'l>(
    ladder: &'l Ladder,
    decided: &'l Decided,
    weakest: Evidence,
) -> impl Iterator<Item = &'l Succession> {
    let all = ladder.analysis.successions().iter();
    all.filter(move |it| {
        it.evidence != Evidence::Written
            && it.evidence <= weakest
            && decided.standing(&it.from, &it.to) == Standing::Open
    })
}

/// Accepts states that start together, most often one.
fn decision(company: &[&Succession], ladder: &Ladder, budget: &Budget) -> Next {
    let from = company
        .first()
        .map_or_else(|| "".into(), |it| it.from.clone());
    let to: Vec<Name> = company.iter().map(|it| it.to.clone()).collect();
    let evidence = company.first().map_or("", |it| it.evidence.word());
    let mut reason: Vec<String> = company.iter().map(|it| why(it, ladder, budget)).collect();
    if company.len() > 1 {
        reason.push("They start together, for the same cause.".to_owned());
    }
    Next {
        line: decision_text(&Decision::from(Verdict::Accept { from, to })),
        kind: NextKind::Decision,
        evidence: match company.len() {
            0 | 1 => evidence.to_owned(),
            _ => format!("{evidence}, together"),
        },
        reason: reason.join("\n"),
    }
}

/// Why a succession is suggested, in a sentence.
pub(crate) fn why(succession: &Succession, ladder: &Ladder, budget: &Budget) -> String {
    let Succession { from, to, .. } = succession;
    let rests = match succession.evidence {
        Evidence::Written => format!("A rung writes {to} after {from}."),
        Evidence::Handover => format!("What ends {from} is what starts {to}."),
        Evidence::Witnessed => format!("{from} can be seen to end in the scan that starts {to}."),
        Evidence::Delayed => format!(
            "{to} can be seen to start after {from} has ended, with no other state on in between."
        ),
        Evidence::Possible => {
            format!("What ends {from} and what starts {to} share a variable and can hold together.")
        }
    };
    let condition = succession.condition.as_ref();
    let condition = condition.and_then(|it| legible(it, &ladder.analysis.conditions, budget));
    let mut words = match condition {
        Some(condition) => format!("{rests} Condition: {condition}"),
        None => rests,
    };
    if let Some(witness) = &succession.witness {
        words += &format!("\nSeen after: {}", witness.in_words());
    }
    words
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Two valves, of which the second follows the first.
    pub(crate) const TANK: &str = "\
input s
input ls2
input ls3
output v1
output v2
rung: (s + v1) * /ls2 -> v1
rung: (v2 + ls2*/v1) * /ls3 -> v2
";

    #[track_caller]
    fn check(spec: &str, expected: &[&str]) {
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let spec = Spec::read(spec.into());
        let lines = next(&spec, &ladder, Evidence::Possible, &budget);
        let lines: Vec<&str> = lines.iter().map(|it| &*it.line).collect();
        assert_eq!(lines, expected);
    }

    #[test]
    fn open_decisions_come_until_they_are_made() {
        check("", &["//! accept v1 -> v2"]);
        check("//! reject v1 -> v2\n", &[]);
    }

    /// The first line that may stand at `$0`, and what it replaces.
    #[track_caller]
    fn check_at(spec: &str, expected: Option<(&str, &str)>) {
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let offset = spec.find("$0").expect("a cursor");
        let spec = Spec::read(spec.replace("$0", "").into());
        let found = next_at(&spec, &ladder, offset, Evidence::Possible, &budget);
        let found = found.map(|(span, lines)| (spec.text[span.range()].to_owned(), lines));
        let first = found.as_ref().map(|(old, lines)| (&**old, &*lines[0].line));
        assert_eq!(first, expected);
    }

    /// What the ladder gives when `v1 -> v2` is accepted, without one rule.
    fn accepted_without(label: &str) -> String {
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let made = grafcet::read("//! accept v1 -> v2\n").spec.decisions;
        let text = grafcet::write(&recovery::conversion::spec(
            &ladder.analysis,
            &made,
            &budget,
        ));
        let line = text
            .lines()
            .find(|line| line.starts_with(label))
            .expect("the rule");
        text.replace(line, "$0")
    }

    #[test]
    fn a_rule_that_is_missing_comes_in_its_section() {
        check_at(
            &accepted_without("v1_to_Dv1:"),
            Some(("", "v1_to_Dv1: Xv1*ls2 |- @Dv1")),
        );
        let begun = accepted_without("v1_to_Dv1:").replace("$0", "v1_to$0");
        check_at(&begun, Some(("v1_to", "v1_to_Dv1: Xv1*ls2 |- @Dv1")));
    }

    #[test]
    fn a_decision_comes_at_the_end_or_where_one_is_begun() {
        check_at("Step a\n$0", Some(("", "//! accept v1 -> v2")));
        check_at(
            "//! acc$0\nStep a\n",
            Some(("//! acc", "//! accept v1 -> v2")),
        );
        check_at("$0\nStep a\n", None);
        check_at("Step a$0\n", None);
        check_at("//! accept v1 $0 -> v2\n", None);
    }
}
