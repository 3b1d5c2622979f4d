//! A ladder and a spec to judge, and what is said of them.

use ::proof::Limits;
use ::scenario::read;
use ::verification::{Timing, verify};
use logic::Budget;
use recovery::simulation::{Simulation, Subject, simulate};

use super::*;
use crate::edited;
use crate::navigate::Side;
use crate::scenario::tests_of_runs::{LADDER, SPEC};

/// A ladder and a spec with what was found about them.
struct Judgement {
    ladder: Ladder,
    spec: Spec,
    verdict: Verdict,
}

impl Judgement {
    fn new(ladder: &str, spec: &str, timing: Timing, limits: &Limits) -> Self {
        let ladder = Ladder::read(ladder.into(), &Budget::default());
        let spec = Spec::read(spec.into());
        let verdict = verify(ladder.program(), &spec.reading.spec, timing, limits);
        Self {
            ladder,
            spec,
            verdict,
        }
    }

    fn of(ladder: &str, spec: &str) -> Self {
        Self::new(ladder, spec, Timing::Scan, &Limits::default())
    }

    fn judged(&self) -> Judged<'_> {
        Judged {
            ladder: &self.ladder,
            spec: &self.spec,
            verdict: &self.verdict,
        }
    }

    fn line(&self) -> String {
        verdict_line(&self.verdict)
    }

    /// What is said, with the text that it is said of, and the other places.
    fn said(&self) -> Vec<String> {
        let all = verdict_findings(self.judged()).into_iter();
        all.map(|it| {
            let found = it.finding.diagnostic;
            let place = &self.spec.text[found.span.range()];
            let mut line = format!("{} {place}: {}", found.code, found.message);
            for (target, message) in it.finding.related {
                let text = match target.side {
                    Side::Ladder => &self.ladder.text,
                    Side::Spec => &self.spec.text,
                };
                line += &format!(" [{}: {message}]", &text[target.name.range()]);
            }
            line
        })
        .collect()
    }

    fn scenario(&self, about: &About) -> Option<String> {
        let files = ["tank.ladder", "tank.grafcet"].map(str::to_owned);
        trace_scenario(self.judged(), about, &files)
    }

    fn simulated(&self, text: &str) -> Simulation {
        let subject = Subject {
            ladder: Some(self.ladder.program()),
            grafcet: None,
        };
        simulate(&read(text).scenario, subject, &logic::Cancel::default())
    }

    /// `rule // fact` for each rule that is offered.
    fn rules(&self, about: &About, observed: &[&str]) -> Vec<String> {
        let observed = observed.iter();
        let observed = observed.map(|text| Observed::of(&self.simulated(text)));
        let observed: Vec<Observed> = observed.collect();
        let all = exclusions(self.judged(), about, &observed).into_iter();
        all.map(|it| format!("{} // {}", it.rule, it.fact))
            .collect()
    }
}

fn fixture(name: &str) -> String {
    let path = end_to_end::path(&format!("fixtures/neutralization/{name}"));
    std::fs::read_to_string(path).expect("a fixture")
}

/// The shipped spec of the tank without the rule of a label.
fn without(label: &str) -> Judgement {
    let rule = format!("{label}:");
    let text = fixture("sequence.grafcet");
    let lines = text.lines().filter(|line| !line.starts_with(&rule));
    let fewer: String = lines.map(|line| line.to_owned() + "\n").collect();
    Judgement::of(&fixture("neutralization.ladder"), &fewer)
}

/// The tables of the paper: what was seen at the plant.
fn tables() -> [String; 3] {
    [2, 3, 4].map(|number| fixture(&format!("table-{number}.scenario")))
}

/// The spec stays in `Xv1` when the tank is full.
fn overflowing() -> Judgement {
    Judgement::of(LADDER, &SPEC.replacen("t2: Xv1*ls2", "t2: Xv1*ls2*s", 1))
}

#[test]
fn of_what_is_equivalent_nothing_is_found() {
    let same = Judgement::of(LADDER, SPEC);
    assert_eq!(same.line(), "equivalent (scan timing)");
    assert_eq!(verdict_word(&same.verdict), "equivalent");
    assert_eq!(same.said(), [""; 0]);
    assert_eq!(same.scenario(&About::Outputs), None);
    assert_eq!(same.rules(&About::Outputs, &[]), [""; 0]);
    let shipped = Judgement::of(
        &fixture("neutralization.ladder"),
        &fixture("sequence.grafcet"),
    );
    assert_eq!(shipped.line(), "equivalent under 7 rules (scan timing)");
}

#[test]
fn a_difference_is_said_where_the_spec_acts_with_the_rungs_that_decide() {
    let found = overflowing();
    assert_eq!(found.line(), "different after 2 scans: v1");
    assert_eq!(
        found.said(),
        [
            "G3201 v1: after 2 scans, in the last with ls2 on, the ladder has v1 off and the spec \
             has it on (scan timing) [v1: rung 0 of main has v1 off in scan 2]"
        ]
    );
}

#[test]
fn several_outputs_are_one_finding() {
    let found = without("e5");
    assert_eq!(
        found.said(),
        [
            "G3201 v2: after 1 scan, with ls2 and ls1 on, the ladder has v2, h and m on and the \
             spec has them off (scan timing) \
             [v2: rung 1 of Neutralization (Add neutralizer up to ls3) has v2 on in scan 1] \
             [h: rung 4 of Neutralization (Heat) has h on in scan 1] \
             [m: rung 5 of Neutralization (Mix) has m on in scan 1] \
             [v2: the spec has v2 off in scan 1] \
             [h: the spec has h off in scan 1] \
             [m: the spec has m off in scan 1]"
        ]
    );
}

#[test]
fn of_many_outputs_the_first_are_named() {
    let outputs: Vec<String> = (0..12).map(|at| format!("q{at}")).collect();
    let mut ladder = "input a\n".to_owned();
    let mut spec = format!(
        "Step X0\nInput a\nOutput {}\nMarking X0\nSteps:\n",
        outputs.join(", ")
    );
    for output in &outputs {
        ladder += &format!("output {output}\nrung: a -> {output}\n");
        spec += &format!("X0: 0 |- {output}\n");
    }
    let found = Judgement::of(&ladder, &spec);
    assert_eq!(found.line(), "different after 1 scan: q0, q1, q2, 9 more");
    let said = found.said().remove(0);
    let named = "the ladder has q0, q1, q2, q3, q4, q5, q6 and q7 on and the spec has them off, and 4 \
                 more outputs differ (scan timing)";
    assert!(said.contains(named), "{said}");
    assert_eq!(said.matches(" [").count(), 8 + 7, "{said}");
}

#[test]
fn a_property_is_said_where_it_stands() {
    let spec = SPEC.replacen("Steps:", "Never:\nn1: v1*s // both\nn2: v1*/v1\nSteps:", 1);
    let found = Judgement::of(LADDER, &spec);
    assert_eq!(
        found.line(),
        "equivalent (scan timing) · 1 property proved · n1 violated after 1 scan"
    );
    assert_eq!(verdict_word(&found.verdict), "different");
    assert_eq!(
        found.said(),
        [
            "G3202 n1: v1*s: after 1 scan, with s on, what should never be is so, by n1 (scan \
             timing) [v1: rung 0 of main has v1 on in scan 1]"
        ]
    );
}

#[test]
fn rules_that_allow_nothing_are_said_to() {
    let spec = SPEC.replacen(
        "Steps:",
        "Environment:\ne1: /s |- @(s*ls2)\ne2: ls2 |- /s\nSteps:",
        1,
    );
    let found = Judgement::of(LADDER, &spec);
    assert_eq!(
        found.line(),
        "equivalent under 2 rules, which allow no more than 0 scans (scan timing)"
    );
    assert_eq!(
        found.said(),
        [
            "G3203 e2: ls2 |- /s: the environment rules allow no sequence of more than 0 scans, so \
             what is proved under them says little"
        ]
    );
}

#[test]
fn a_circle_is_said_at_a_step_of_it() {
    let found = Judgement::of(LADDER, &SPEC.replacen("X0*s*/ls2", "X0*s", 1));
    assert_eq!(
        found.line(),
        "different after 1 scan: the spec finds no stable situation"
    );
    assert_eq!(
        found.said(),
        [
            "G3201 X0: after 1 scan, with s and ls2 on, the spec never becomes stable: t1, t2, \
             over and over (steps X0, Xv1) (scan timing)"
        ]
    );
}

#[test]
fn what_is_not_known_or_cannot_be_is_said_at_the_head() {
    let limits = Limits {
        steps: 1,
        ..Limits::default()
    };
    let spec = format!("Grafcet Tank\n{}", fixture("sequence.grafcet"));
    let ladder = fixture("neutralization.ladder");
    let unknown = Judgement::new(&ladder, &spec, Timing::Scan, &limits);
    assert_eq!(
        unknown.line(),
        "cannot be verified: it is too large for the effort that is allowed"
    );
    let said = unknown.said();
    assert!(
        said[0].starts_with("G3204 Tank: spec and ladder cannot be compared"),
        "{said:?}"
    );
    let rule = SPEC.replacen("Steps:", "Environment:\ne1: s |- /v1\nSteps:", 1);
    let refused = Judgement::of(LADDER, &rule);
    assert_eq!(verdict_word(&refused.verdict), "refused");
    assert_eq!(
        refused.said(),
        [
            "G3204 e1: s |- /v1: spec and ladder cannot be compared: the rule `e1` speaks of `v1`, \
             which the ladder writes; a rule about outputs says with `@` what the plant does next"
        ]
    );
}

#[test]
fn a_spec_that_says_nothing_of_outputs_so_far_is_left_alone() {
    for spec in [
        "",
        "Grafcet Tank\n",
        "//! accept v1 -> v2\n",
        "Step X0\nMarking X0\n",
    ] {
        let found = Judgement::of(LADDER, spec);
        let line = "not known: the spec has no output that the ladder knows";
        assert_eq!(
            (found.line(), found.said()),
            (line.to_owned(), vec![]),
            "{spec}"
        );
    }
}

#[test]
fn a_trace_becomes_a_scenario_that_passes_on_the_ladder_and_fails_on_the_spec() {
    let found = overflowing();
    let text = found.scenario(&About::Outputs).expect("a scenario");
    assert_eq!(
        text,
        "scenario \"v1 differs after 2 scans\"\nfor tank.ladder, tank.grafcet\n\n\
         on s\noff s, on ls2 => off v1\n"
    );
    let spec = SPEC.replacen("Steps:", "Never:\nn1: v1*s\nSteps:", 1);
    let found = Judgement::of(LADDER, &spec);
    let about = About::Property("n1".into());
    let text = found.scenario(&about).expect("a scenario");
    assert_eq!(
        text,
        "scenario \"n1 violated after 1 scan\"\nfor tank.ladder, tank.grafcet\n\non s => on v1\n"
    );
    assert_eq!(found.scenario(&About::Outputs), None);
}

#[test]
fn what_the_shipped_rules_say_is_offered_where_one_is_missing() {
    let tables = tables();
    let tables: Vec<&str> = tables.iter().map(|it| &**it).collect();
    for (label, rule) in [
        ("e1", "ls2 |- ls1 // ls1 is on whenever ls2 is"),
        (
            "e2",
            "tl*ls1 |- @(tl + /ls1) // tl stays on as long as ls1 is on",
        ),
        (
            "e3",
            "as*tl |- @(as + /tl) // as stays on as long as tl is on",
        ),
        ("e4", "ls2*/v3 |- @ls2 // ls2 stays on while v3 is off"),
        ("e5", "/ls2*/v1 |- /@ls2 // ls2 stays off while v1 is off"),
        (
            "e6",
            "v3 |- /@s // s is off in the scan after one with v3 on",
        ),
        ("e7", "/as*/v2 |- /@as // as stays off while v2 is off"),
    ] {
        let offered = without(label).rules(&About::Outputs, &tables);
        assert!(offered.iter().any(|it| it == rule), "{label}: {offered:#?}");
        assert!(offered.len() <= 4, "{offered:#?}");
    }
}

#[test]
fn what_was_seen_at_the_plant_is_not_excluded() {
    let found = without("e1");
    let rules = |observed: &[&str]| found.rules(&About::Outputs, observed);
    let first = "ls2 |- ls1 // ls1 is on whenever ls2 is";
    assert_eq!(rules(&[])[0], first);
    // Here the lower sensor is broken; and this is what the trace itself does.
    let broken = "on ls2\n";
    assert!(!rules(&[broken]).iter().any(|it| it == first));
    let own = found.scenario(&About::Outputs).expect("a scenario");
    assert_eq!(rules(&[&own]), rules(&[]));
}

#[test]
fn a_rule_that_is_added_excludes_the_trace_and_nothing_else_of_the_text_changes() {
    let found = without("e1");
    let first = exclusions(found.judged(), &About::Outputs, &[]).remove(0);
    let new = edited(&found.spec.text, &first.edits);
    let is_new = |line: &&str| !found.spec.text.lines().any(|old| old == *line);
    let added: Vec<&str> = new.lines().filter(is_new).collect();
    assert_eq!(added, ["e1: ls2 |- ls1  // ls1 is on whenever ls2 is"]);
    assert_eq!(new.lines().count(), found.spec.text.lines().count() + 1);
    let again = Judgement::of(&found.ladder.text, &new);
    assert_eq!(again.line(), "equivalent under 7 rules (scan timing)");
}

#[test]
fn the_section_is_made_where_there_is_none_and_labels_are_free() {
    // Something else is called `e1`.
    let found = Judgement::of(LADDER, &SPEC.replacen("X0*s*/ls2", "X0*s*/ls2*/e1", 1));
    let all = exclusions(found.judged(), &About::Outputs, &[]);
    let new = edited(&found.spec.text, &all[0].edits);
    let section = new.split("Environment:\n").nth(1);
    assert_eq!(
        section.map(str::trim_end),
        Some("e2: s |- ls2  // ls2 is on whenever s is"),
        "{new}"
    );
}

#[test]
fn names_that_need_quotes_and_numbers_are_said_as_they_are_written() {
    let ladder = "\
input \"Local:1:I\"
input Level
output \"a b\"
rung: \"Local:1:I\" * (Level > 5) -> \"a b\"
";
    let spec = "\
Step X0
Input \"Local:1:I\", Level
Output \"a b\"
Marking X0
Steps:
X0: \"Local:1:I\" * (Level > 7) |- \"a b\"
";
    let found = Judgement::of(ladder, spec);
    assert_eq!(found.line(), "different after 1 scan: \"a b\"");
    let said = found.said();
    assert!(
        said[0].starts_with(
            "G3201 \"a b\": after 1 scan, with \"Local:1:I\" and Level=6 on, the ladder has \
             \"a b\" on and the spec has it off (scan timing)"
        ),
        "{said:?}"
    );
    let text = found.scenario(&About::Outputs).expect("a scenario");
    assert!(
        text.ends_with("\non \"Local:1:I\", Level = 6 => on \"a b\"\n"),
        "{text}"
    );
    for rule in found.rules(&About::Outputs, &[]) {
        assert!(
            rule.contains("Local:1:I") && !rule.contains("Level"),
            "{rule}"
        );
    }
}
