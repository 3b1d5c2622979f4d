//! Actions about findings and about decisions that stand in the text.

use grafcet::Verdict;
use logic::notation;
use source::{Diagnostic, Edit, Fix, Span, codes};

use super::{Action, ActionKind, Effect};
use crate::{Change, Departing, Spec};

/// What mends the findings.
pub(super) fn fixing(findings: &[Diagnostic]) -> Vec<Action> {
    let fixes = findings.iter().filter_map(|finding| {
        let fix = finding.fix.clone()?;
        Some(Action {
            title: fix.title.clone(),
            kind: ActionKind::Fix,
            preferred: true,
            effect: Effect::Here(fix),
        })
    });
    fixes.collect()
}

/// What explains the findings.
pub(super) fn explaining(findings: &[Diagnostic]) -> Vec<Action> {
    let mut codes: Vec<_> = findings.iter().map(|finding| finding.code).collect();
    codes.sort();
    codes.dedup();
    let explained = codes.into_iter().map(|code| Action {
        title: format!("Explain {code}: {}", code.title()),
        kind: ActionKind::Explain,
        preferred: false,
        effect: Effect::Show(code),
    });
    explained.collect()
}

/// What mends all rules that depart from the ladder at once, offered at each.
pub(super) fn renewing(findings: &[Diagnostic]) -> Option<Action> {
    let departs = |it: &Diagnostic| it.code == codes::RULE_NOT_SUPPORTED;
    findings.iter().any(departs).then(|| Action {
        title: "Take over all that the ladder gives".to_owned(),
        kind: ActionKind::Fix,
        preferred: false,
        effect: Effect::Spec(Vec::new(), Departing::Renewed),
    })
}

/// Lets rules that depart from the ladder stay as they are, by saying so.
pub(super) fn keeping(spec: &Spec, findings: &[Diagnostic]) -> Vec<Action> {
    let rules = &spec.reading.places.rules;
    let departing = findings
        .iter()
        .filter(|it| it.code == codes::RULE_NOT_SUPPORTED);
    let kept = departing.filter_map(|finding| {
        let rule = rules.iter().find(|rule| rule.span == finding.span)?;
        let label = notation::quoted(&rule.name);
        let end = spec.text.len();
        let line_end = match spec.text.ends_with('\n') || end == 0 {
            true => "",
            false => "\n",
        };
        Some(Action {
            title: format!("Keep {label} as it is"),
            kind: ActionKind::Fix,
            preferred: false,
            effect: Effect::Here(Fix {
                title: format!("Keep {label} as it is"),
                edits: vec![Edit {
                    span: Span::at(end),
                    text: format!("{line_end}//! keep {label}\n"),
                }],
            }),
        })
    });
    kept.collect()
}

/// Takes back the decision on the line of `span`.
pub(super) fn withdrawing(spec: &Spec, span: Span) -> Vec<Action> {
    let decisions = spec.reading.spec.decisions.iter();
    let here = decisions
        .zip(&spec.reading.places.decisions)
        .filter(|(_, place)| place.touches(span.range().start));
    here.map(|(decision, _)| Action {
        title: format!("Take back: {}", said(&decision.verdict)),
        kind: ActionKind::Undo,
        preferred: false,
        effect: Effect::Spec(
            vec![Change::Withdraw(decision.verdict.clone())],
            Departing::Stay,
        ),
    })
    .collect()
}

/// A decision in words.
pub(super) fn said(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Accept { from, to } => {
            format!("{from} -> {} accepted", crate::change::listed(to))
        }
        Verdict::Reject { from, to } => format!("{from} -> {to} rejected"),
        Verdict::Initial(state) => format!("the sequence starts in {state}"),
        Verdict::Keep(rule) => format!("{rule} stays as it is"),
        Verdict::End(state) => format!("the branch of {state} ends by itself"),
    }
}
