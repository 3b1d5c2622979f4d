//! Actions about a sequence that shows a difference: keep it as a scenario, or
//! say that the plant cannot do it.

use source::{Fix, codes};

use super::{Action, ActionKind, Asked, Effect};
use crate::verdict::{Judged, Observed, exclusions, trace_scenario, verdict_findings};

/// All that can be done about what a verdict says at a place in the spec.
/// `observed` tells what was seen at the plant.
pub fn actions_on_verdict(
    judged: Judged<'_>,
    observed: &dyn Fn() -> Vec<Observed>,
    asked: Asked<'_>,
) -> Vec<Action> {
    let shown = [codes::SPEC_DIFFERS, codes::PROPERTY_VIOLATED];
    if !asked.findings.iter().any(|it| shown.contains(&it.code)) {
        return Vec::new();
    }
    let observed = observed();
    let mut all = Vec::new();
    for found in verdict_findings(judged) {
        let is_here = asked.findings.contains(&found.finding.diagnostic);
        let Some(about) = found.about.filter(|_| is_here) else {
            continue;
        };
        if trace_scenario(judged, &about, &[]).is_some() {
            all.push(Action {
                title: "Add this trace as a scenario".to_owned(),
                kind: ActionKind::Trace,
                preferred: false,
                effect: Effect::Scenario(about.clone()),
            });
        }
        let rules = exclusions(judged, &about, &observed).into_iter();
        all.extend(rules.map(|it| {
            let title = format!(
                "Exclude it by an environment rule: {} ({})",
                it.fact, it.rule
            );
            Action {
                title: title.clone(),
                kind: ActionKind::Exclude,
                preferred: false,
                effect: Effect::Here(Fix {
                    title,
                    edits: it.edits,
                }),
            }
        }));
    }
    all
}
