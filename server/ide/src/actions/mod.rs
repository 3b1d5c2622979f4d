//! What can be done at a place: decide, mend, look up.
//!
//! An action says what it does in its title and why in its detail; what it
//! changes is worked out when somebody takes it.

mod mend;
mod scenario;
mod states;
mod verdict;

use logic::{Budget, Name};
use recovery::successions::Evidence;
use source::{Code, Diagnostic, Fix, Span};

use crate::{About, Change, Departing, Ladder, Shows, Spec};
use mend::{explaining, fixing, keeping, renewing, withdrawing};
pub use scenario::actions_in_scenario;
use states::{about_states, in_ladder, in_spec};
pub use verdict::actions_on_verdict;

/// Something that can be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Action {
    /// What it does, as a command.
    pub title: String,
    /// Which kind it is.
    pub kind: ActionKind,
    /// Whether it is what most people would do here.
    pub preferred: bool,
    /// What it does.
    pub effect: Effect,
}

/// The kinds of actions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ActionKind {
    /// Mends a finding.
    Fix,
    /// Says that one state follows another.
    Accept,
    /// Says that several states follow one, together.
    AcceptTogether,
    /// Says that one state does not follow another.
    Reject,
    /// Says where a sequence starts.
    Initial,
    /// Takes a decision back.
    Undo,
    /// Makes the spec.
    Convert,
    /// Explains a finding.
    Explain,
    /// Has a scenario expect what came out.
    Expect,
    /// Shows a scan in ladder and spec, or shows it no more.
    Scan,
    /// Keeps a sequence that shows a difference as a scenario.
    Trace,
    /// Says that the plant cannot do what such a sequence needs.
    Exclude,
}

/// What an action does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Changes the spec beside the ladder, which is made if there is none.
    Spec(Vec<Change>, Departing),
    /// Changes the document that the action is taken in.
    Here(Fix),
    /// Shows the page of a code.
    Show(Code),
    /// Shows a scan of the scenario that the action is taken in.
    Look(Shows),
    /// Makes a scenario of the sequence that shows this.
    Scenario(About),
}

/// Where somebody asks what can be done.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// What is selected; empty where a caret stands.
    pub span: Span,
    /// The findings that the place is about.
    pub findings: &'a [Diagnostic],
    /// Suggestions weaker than this are left out.
    pub weakest: Evidence,
    /// What answering may cost.
    pub budget: &'a Budget,
}

/// All that can be done at a place in a ladder, best first.
pub fn actions_in_ladder(ladder: &Ladder, spec: Option<&Spec>, asked: Asked<'_>) -> Vec<Action> {
    let mut all = fixing(asked.findings);
    let states = in_ladder(ladder, asked.span);
    all.extend(about_states(ladder, spec, &states, asked));
    if spec.is_none() && !ladder.analysis.groups().is_empty() {
        all.push(Action {
            title: "Create the spec beside the ladder".to_owned(),
            kind: ActionKind::Convert,
            preferred: false,
            effect: Effect::Spec(Vec::new(), Departing::Stay),
        });
    }
    all.extend(explaining(asked.findings));
    all
}

/// All that can be done at a place in a spec, best first.
pub fn actions_in_spec(spec: &Spec, ladder: Option<&Ladder>, asked: Asked<'_>) -> Vec<Action> {
    let mut all = fixing(asked.findings);
    all.extend(keeping(spec, asked.findings));
    if ladder.is_some() {
        all.extend(renewing(asked.findings));
    }
    if let Some(ladder) = ladder {
        all.extend(withdrawing(spec, asked.span));
        let states = in_spec(spec, asked.span);
        all.extend(about_states(ladder, Some(spec), &states, asked));
    }
    all.extend(explaining(asked.findings));
    all
}

/// States as an action names them.
fn pair(from: &Name, to: &Name) -> String {
    format!("{from} -> {to}")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TANK: &str = "\
rung: (s + v1) * /ls2 -> v1
rung: (ls2 + v2) * /ls3 -> v2
rung: (ls2 + m) * /e -> m
rung: (ls3 + v3) * ls1 -> v3
";

    /// A text without `$0` and `$1`, and what is selected between them.
    fn selected(text: &str) -> (String, Span) {
        let start = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let end = text.find("$1").unwrap_or(start);
        (text.replace("$1", ""), Span::new(start, end))
    }

    fn asked<'a>(span: Span, findings: &'a [Diagnostic], budget: &'a Budget) -> Asked<'a> {
        Asked {
            span,
            findings,
            weakest: Evidence::Possible,
            budget,
        }
    }

    /// The titles of what can be done at `$0`, or where `$0` and `$1` are around
    /// it, with `spec` beside the ladder.
    fn titles(text: &str, spec: Option<&str>) -> Vec<String> {
        let (text, span) = selected(text);
        let budget = Budget::default();
        let ladder = Ladder::read(text.into(), &budget);
        let spec = spec.map(|text| Spec::read(text.into()));
        let all = actions_in_ladder(&ladder, spec.as_ref(), asked(span, &[], &budget));
        all.into_iter().map(|action| action.title).collect()
    }

    fn at(before: &str) -> String {
        TANK.replacen(before, &format!("{before}$0"), 1)
    }

    #[test]
    fn on_a_state_its_followers_come_first() {
        assert_eq!(
            titles(&at("/ls2 -> v"), None),
            [
                "Accept v1 -> v2 and m together (AND, handover, all on ls2*/ls3*/e)",
                "Accept v1 -> v2 (handover on ls2*/ls3)",
                "Accept v1 -> m (handover on ls2*/e)",
                "Reject v1 -> v2 (handover on ls2*/ls3)",
                "Reject v1 -> m (handover on ls2*/e)",
                "Start the sequence in v1",
                "Create the spec beside the ladder",
            ]
        );
    }

    #[test]
    fn what_is_decided_can_be_taken_back() {
        let spec = "//! accept v1 -> v2 & m\n//! initial v1\n";
        assert_eq!(
            titles(&at("/ls2 -> v"), Some(spec)),
            [
                "Take back: v1 -> v2 and m accepted",
                "Take back: the sequence starts in v1",
            ]
        );
    }

    #[test]
    fn states_selected_one_after_the_other_may_follow_each_other() {
        let text = "rung: (m + $0v3) * ls1 -> v3\nrung: (s + v1$1) * /ls2 -> v1\n";
        let first = titles(text, None).into_iter().next();
        assert_eq!(first.as_deref(), Some("Accept v3 -> v1 (not suggested)"));
    }

    #[test]
    fn a_selection_of_one_name_or_none_is_a_cursor() {
        let cursor = titles(&at("/ls2 -> v"), None);
        let rung = "rung: (s + v1) * /ls2 -> v1\n";
        for selected in [
            "rung: (s + v1) * /ls2 -> $0v$11\n",
            "rung: (s + v1) * /ls2 -> v$01$1\n",
            "rung: (s + v1) * /ls2 $0-> v1$1\n",
            "r$0u$1ng: (s + v1) * /ls2 -> v1\n",
        ] {
            assert_eq!(titles(&TANK.replacen(rung, selected, 1), None), cursor);
        }
    }

    #[test]
    fn on_an_input_nothing_is_decided() {
        let spec = "//! initial v1\n";
        let text = "rung: 1 -> a\nrung: $0s -> b\n";
        assert_eq!(titles(text, Some(spec)), [""; 0]);
    }

    /// The titles of what can be done at `$0`, or where `$0` and `$1` are around
    /// it, in a spec beside the tank.
    fn in_spec(text: &str) -> Vec<String> {
        let (text, span) = selected(text);
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let spec = Spec::read(text.into());
        let findings = spec.findings(Some(&ladder), &budget);
        let start = span.range().start;
        let here = findings.into_iter().filter(|it| it.span.touches(start));
        let here: Vec<Diagnostic> = here.collect();
        let all = actions_in_spec(&spec, Some(&ladder), asked(span, &here, &budget));
        all.into_iter().map(|action| action.title).collect()
    }

    #[test]
    fn a_rule_that_departs_can_be_renewed_or_kept() {
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let spec = crate::changed_spec(&ladder, None, &[], Departing::Stay, &budget);
        let edited = spec.replacen("/ls2 |- @Xv1", "ls3 |- $0@Xv1", 1);
        let edited = match edited == spec {
            true => panic!("no such rule in\n{spec}"),
            false => edited,
        };
        let titles = in_spec(&edited);
        assert_eq!(titles[0], "Take over what the ladder gives");
        assert!(titles[1].starts_with("Keep "), "{titles:?}");
        assert_eq!(titles[2], "Take over all that the ladder gives");
        let last = titles.last().expect("an action");
        assert!(last.starts_with("Explain G3101"), "{titles:?}");
    }

    #[test]
    fn a_decision_can_be_taken_back_where_it_stands() {
        let titles = in_spec("//! accept v1 $0-> v2\n");
        assert_eq!(titles, ["Take back: v1 -> v2 accepted"]);
    }

    #[test]
    fn a_selection_of_one_name_or_none_is_a_cursor_in_a_spec_too() {
        let first = |text| {
            in_spec(text)
                .into_iter()
                .find(|it| it.starts_with("Accept"))
        };
        for selected in [
            "Step Xv1 for $0v1\nStep Xv3 for v3\n",
            "Step Xv1 for $0v$11\nStep Xv3 for v3\n",
            "Step Xv1 for v$01$1\nStep Xv3 for v3\n",
            "Step Xv1 $0for v1$1\nStep Xv3 for v3\n",
        ] {
            assert_eq!(
                first(selected).as_deref(),
                Some("Accept v1 -> v2 and m together (AND, handover, all on ls2*/ls3*/e)")
            );
        }
        assert_eq!(
            first("Step Xv3 for $0v3\nStep Xv1 for v1$1\n").as_deref(),
            Some("Accept v3 -> v1 (not suggested)")
        );
    }
}
