//! A verdict as findings in the spec, each with the rungs that decide.

use ::proof::Why;
use ::verification::{Difference, Reason, Refusal, Step, Verdict as Found, Verification, What};
use grafcet::Role;
use logic::notation::quoted;
use logic::{Datum, Name};
use source::{Diagnostic, Span, codes};

use super::line::reason;
use super::{About, Judged, first_of, rule_of, steps};
use crate::change::listed;
use crate::hover::rung_title;
use crate::navigate::{Side, Target, driving, standing};
use crate::{Finding, Spec, link_in_spec};

/// So many outputs, inputs and other places are told of a difference.
const MOST_NAMES: usize = 8;

/// Something to say about a spec since a verdict is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerdictFinding {
    /// What is said, and the places in the ladder and in the spec that have to
    /// do with it.
    pub finding: Finding,
    /// The sequence that shows it, if one does.
    pub about: Option<About>,
}

/// Everything that a verdict says about the spec. Nothing is said of a spec that
/// does what its ladder does, and of one in which there is nothing to compare
/// so far.
pub fn verdict_findings(judged: Judged<'_>) -> Vec<VerdictFinding> {
    let found = match judged.verdict {
        Ok(found) => found,
        Err(Refusal::Cancelled) => return Vec::new(),
        Err(refusal) => return vec![refused(judged.spec, refusal)],
    };
    let mut all: Vec<VerdictFinding> = outputs(judged, found).into_iter().collect();
    for (label, verdict) in &found.properties {
        all.extend(property(judged, found, label, verdict));
    }
    all.extend(
        found
            .deadlock
            .map(|most| overdone(judged.spec, most, found)),
    );
    all
}

/// That the environment rules allow so little that a proof under them says
/// little.
fn overdone(spec: &Spec, most: usize, found: &Verification) -> VerdictFinding {
    let rules = spec.reading.spec.environment.iter();
    let last = rules.map(|it| rule_place(spec, &it.name)).max();
    let message = format!(
        "the environment rules allow no sequence of more than {}, so what is proved under them \
         says little",
        steps(most, found.timing)
    );
    let help = "look for rules that contradict each other, or what the plant does at its start";
    let span = last.unwrap_or_else(|| head(spec));
    VerdictFinding {
        finding: Finding {
            diagnostic: Diagnostic::new(codes::VERDICT_UNKNOWN, span, message).help(help),
            related: Vec::new(),
        },
        about: None,
    }
}

fn outputs(judged: Judged<'_>, found: &Verification) -> Option<VerdictFinding> {
    match &found.verdict {
        Found::Equivalent => None,
        Found::Unknown { bound, why } => {
            let subject = "whether the spec does what the ladder does";
            unknown(head(judged.spec), subject, *bound, why, found)
        }
        Found::Different(difference) => {
            let last = difference.trace.steps.last()?;
            let (span, said, names): (_, _, &[Name]) = match &difference.what {
                What::Outputs(names) => (
                    place(judged.spec, names.first()?, last),
                    format!("the ladder has {}", both_sides(names, last)),
                    names,
                ),
                What::Unstable(unstable) => {
                    let steps = unstable.steps.iter();
                    let places = &judged.spec.reading.places;
                    let declared = steps.filter_map(|it| places.declaration(it, Role::Step));
                    let span = declared.map(|it| it.span).next();
                    let said = format!("the spec {unstable}");
                    (span.unwrap_or_else(|| head(judged.spec)), said, &[])
                }
                What::Restless | What::Property => {
                    let said = "ladder and spec do not come to rest: something changes in every \
                                scan with the same inputs";
                    (head(judged.spec), said.to_owned(), &[])
                }
            };
            let message = told(&said, difference, found, last);
            let help = "change the spec, or state the fact about the plant for which this cannot \
                        happen, under `Environment:`";
            let diagnostic = Diagnostic::new(codes::SPEC_DIFFERS, span, message).help(help);
            Some(VerdictFinding {
                finding: Finding {
                    diagnostic,
                    related: related(judged, names, difference, span),
                },
                about: Some(About::Outputs),
            })
        }
    }
}

fn property(
    judged: Judged<'_>,
    found: &Verification,
    label: &Name,
    verdict: &Found,
) -> Option<VerdictFinding> {
    let spec = judged.spec;
    let span = rule_place(spec, label);
    match verdict {
        Found::Equivalent => None,
        Found::Unknown { bound, why } => {
            let subject = format!("whether what {} says never happens", quoted(label));
            unknown(span, &subject, *bound, why, found)
        }
        Found::Different(difference) => {
            let last = difference.trace.steps.last()?;
            let said = format!("what should never be is so, by {}", quoted(label));
            let message = told(&said, difference, found, last);
            let help = "change the ladder, or state the fact about the plant for which this cannot \
                        happen, under `Environment:`";
            let diagnostic = Diagnostic::new(codes::PROPERTY_VIOLATED, span, message).help(help);
            let names = judged.names_of_property(label);
            Some(VerdictFinding {
                finding: Finding {
                    diagnostic,
                    related: related(judged, &names, difference, span),
                },
                about: Some(About::Property(label.clone())),
            })
        }
    }
}

/// What is so after how many steps, on which inputs, and for how long.
fn told(said: &str, difference: &Difference, found: &Verification, last: &Step) -> String {
    let after = steps(difference.trace.steps.len(), found.timing);
    let on: Vec<Name> = last
        .inputs
        .iter()
        .filter(|(_, value)| value.is_on())
        .map(|(name, value)| match value {
            Datum::Bool(_) => quoted(name).into(),
            number => format!("{}={number}", quoted(name)).into(),
        })
        .collect();
    let inputs = match on.is_empty() {
        true => "all inputs off".to_owned(),
        false => format!("{} on", listed(&first_of(&on, MOST_NAMES))),
    };
    let brief = match difference.is_brief {
        true => "; it is over after another scan with the same inputs",
        false => "",
    };
    let in_last = match difference.trace.steps.len() {
        1 => "with",
        _ => "in the last with",
    };
    format!(
        "after {after}, {in_last} {inputs}, {said} ({} timing){brief}",
        found.timing.word()
    )
}

/// `v1 on and the spec has it off; h and m off and the spec has them on`.
fn both_sides(names: &[Name], last: &Step) -> String {
    let mut groups: Vec<(String, String, Vec<Name>)> = Vec::new();
    for name in names.iter().take(MOST_NAMES) {
        let (ladder, spec) = (
            word(value(&last.ladder, name)),
            word(value(&last.grafcet, name)),
        );
        let quoted: Name = quoted(name).into();
        let known = groups.iter_mut().find(|it| it.0 == ladder && it.1 == spec);
        match known {
            Some((.., names)) => names.push(quoted),
            None => groups.push((ladder, spec, vec![quoted])),
        }
    }
    let said = groups.iter().map(|(ladder, spec, names)| {
        let them = if names.len() == 1 { "it" } else { "them" };
        format!("{} {ladder} and the spec has {them} {spec}", listed(names))
    });
    let said = said.collect::<Vec<_>>().join(", and the ladder has ");
    match names.len().saturating_sub(MOST_NAMES) {
        0 => said,
        more => format!("{said}, and {more} more outputs differ"),
    }
}

fn value(values: &[(Name, Datum)], name: &Name) -> Datum {
    let mut all = values.iter();
    all.find(|(it, _)| it == name)
        .map_or_else(Datum::default, |(_, value)| *value)
}

fn word(value: Datum) -> String {
    match value {
        Datum::Bool(true) => "on".to_owned(),
        Datum::Bool(false) => "off".to_owned(),
        number => format!("at {number}"),
    }
}

/// Where the spec speaks of an output: the action that gives it its value in the
/// last step, else the first that writes it, else where it is declared.
fn place(spec: &Spec, output: &Name, last: &Step) -> Span {
    let all = standing(spec, output);
    let acts = |target: &&Target| {
        let rules = spec.reading.places.rules.iter();
        let mut around = rules.filter(|rule| rule.span.cover(target.name) == rule.span);
        around.any(|rule| rule.role == Role::Step && last.active.contains(&rule.name))
    };
    let best = all.iter().find(acts).or(all.first());
    best.map_or_else(|| head(spec), |target| target.name)
}

/// Where an environment rule or a property stands.
fn rule_place(spec: &Spec, label: &Name) -> Span {
    rule_of(spec, label).map_or_else(|| head(spec), |rule| rule.span)
}

/// What stands for the spec as a whole.
fn head(spec: &Spec) -> Span {
    link_in_spec(spec).unwrap_or(Span::at(0))
}

/// The rungs that drive names, and the actions of the spec that write them, but
/// for the one at `own`; each with the value in the last step.
fn related(
    judged: Judged<'_>,
    names: &[Name],
    difference: &Difference,
    own: Span,
) -> Vec<(Target, String)> {
    let number = difference.trace.steps.len();
    let Some(last) = difference.trace.steps.last() else {
        return Vec::new();
    };
    let word_of = |values: &[(Name, Datum)], name| word(value(values, name));
    let names = &names[..names.len().min(MOST_NAMES)];
    let mut all = Vec::new();
    for name in names {
        let is = word_of(&last.ladder, name);
        for target in driving(judged.ladder, name) {
            let place = judged.ladder.rung_at(target.name.range().start);
            if let Some(title) = place.and_then(|it| rung_title(judged.ladder, it)) {
                let said = format!("{title} has {} {is} in scan {number}", quoted(name));
                all.push((target, said));
            }
        }
    }
    if !matches!(difference.what, What::Outputs(_)) {
        return all;
    }
    for name in names {
        let is = word_of(&last.grafcet, name);
        let others = standing(judged.spec, name).into_iter();
        for target in others.filter(|target| target.name != own) {
            debug_assert_eq!(target.side, Side::Spec);
            let said = format!("the spec has {} {is} in scan {number}", quoted(name));
            all.push((target, said));
        }
    }
    all
}

/// That something is not known. Nothing is said where there is nothing to
/// compare, or somebody wanted no answer.
fn unknown(
    span: Span,
    subject: &str,
    bound: usize,
    why: &Reason,
    found: &Verification,
) -> Option<VerdictFinding> {
    let help = match why {
        Reason::Nothing | Reason::Limits(Why::Cancelled) => return None,
        Reason::Limits(Why::Steps | Why::Memory | Why::Scans) => {
            "the lens above verifies with more effort; environment rules make it easier"
        }
        Reason::Limits(Why::Unconfirmed) => "please report it: `gradus.report` says what to tell",
        Reason::Numbers(_) => {
            "the other outputs are compared as usual if the spec leaves these out"
        }
        Reason::Unconfirmed => "let the spec read the ladder's own timers, or try it as a scenario",
        Reason::Rounds => "look for transitions that clear one after the other in one scan",
    };
    let far = match bound {
        0 => String::new(),
        bound => format!("; no difference within {}", steps(bound, found.timing)),
    };
    let message = format!("it is not known {subject}: {}{far}", reason(why));
    let diagnostic = Diagnostic::new(codes::VERDICT_UNKNOWN, span, message).help(help);
    Some(VerdictFinding {
        finding: Finding {
            diagnostic,
            related: Vec::new(),
        },
        about: None,
    })
}

fn refused(spec: &Spec, refusal: &Refusal) -> VerdictFinding {
    let (span, help) = match refusal {
        Refusal::RuleAboutOutput(rule, _)
        | Refusal::RuleAboutTime(rule)
        | Refusal::RuleAboutNumber(rule) => (
            rule_place(spec, rule),
            "say it of inputs that are on or off, or put `@` before what the plant does next",
        ),
        Refusal::NotStable => (
            head(spec),
            "look for transitions that clear each other in a circle",
        ),
        Refusal::TooLarge | Refusal::TooManyValues | Refusal::TooManyVisits => (
            head(spec),
            "the lens above verifies with more effort; scenarios try single sequences",
        ),
        _ => (
            head(spec),
            "nothing is proved about these two; scenarios try single sequences of inputs",
        ),
    };
    let message = format!("spec and ladder cannot be compared: {refusal}");
    VerdictFinding {
        finding: Finding {
            diagnostic: Diagnostic::new(codes::NOT_VERIFIED, span, message).help(help),
            related: Vec::new(),
        },
        about: None,
    }
}
