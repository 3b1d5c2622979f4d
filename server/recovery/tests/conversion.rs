//! Conversion, and the spec beside the ladder as its only state.

use std::sync::Arc;

use grafcet::{Decision, Spec, Verdict, rewrite, write};
use logic::{Budget, Name, notation};
use recovery::conversion::{Accept, Departure, decide, spec, spec_findings, update};
use source::Severity;

const FORMS: [&str; 3] = [
    "fixtures/neutralization/neutralization.ladder",
    "fixtures/neutralization/neutralization.L5X",
    "fixtures/neutralization/neutralization.xml",
];

fn program(path: &str) -> Arc<ladder::Program> {
    let bytes = std::fs::read(end_to_end::path(path)).expect("a readable fixture");
    ladder::read(&bytes).program
}

fn converted(program: &Arc<ladder::Program>, accept: &Accept) -> Spec {
    let budget = Budget::default();
    let analysis = recovery::analyse(program, &budget);
    let decisions = decide(&analysis, &[], accept);
    spec(&analysis, &decisions, &budget)
}

/// The rules of a spec, without its declarations.
fn rules(spec: &Spec) -> String {
    let text = write(spec);
    let (_, rules) = text.split_once("Transitions:\n").expect("transitions");
    let (rules, _) = rules.split_once("\n//!").unwrap_or((rules, ""));
    rules.to_owned()
}

#[test]
fn before_anything_is_accepted_every_state_has_a_step_off_and_a_step_on() {
    let spec = converted(&program(FORMS[0]), &Accept::None);
    assert_eq!(
        rules(&spec),
        "\
v1_starts: v1_off*s*/ls2 |- @Xv1
v1_ends: Xv1*ls2 |- @v1_off
v2_starts: v2_off*ls2*/ls3*/as |- @Xv2
v2_ends: Xv2*(ls3 + tl*as) |- @v2_off
v3_starts: v3_off*ls1*tl*as |- @Xv3
v3_ends: Xv3*/ls1 |- @v3_off
v4_starts: v4_off*(/Xv3*ls2*ls3*/tl + /Xv3*ls2*ls3*/as) |- @Xv4
v4_ends: Xv4*(Xv3 + /ls2 + tl*as) |- @v4_off
h_starts: h_off*ls1*ls2*/tl |- @Xh
h_ends: Xh*(/ls1 + tl) |- @h_off
m_starts: m_off*ls1*ls2 |- @Xm
m_ends: Xm*/ls1 |- @m_off

Steps:
Xv1: |- v1
Xv2: |- v2
Xv3: |- v3
Xv4: |- v4
Xh: |- h
Xm: |- m
Always: tl |- light_tl
Always: as |- light_as
"
    );
}

#[test]
fn the_three_forms_of_one_ladder_give_the_same_rules() {
    for accept in [Accept::None, Accept::Handovers, Accept::All] {
        let [text, l5x, xml] = FORMS.map(|path| rules(&converted(&program(path), &accept)));
        assert_eq!(text, l5x, "{accept:?}");
        assert_eq!(text, xml, "{accept:?}");
    }
}

#[test]
fn an_and_divergence_after_v1_opens_a_branch_for_each_of_v2_h_and_m() {
    let these = Accept::These(vec![(
        "v1".into(),
        vec!["v2".into(), "h".into(), "m".into()],
    )]);
    let spec = converted(&program(FORMS[0]), &these);
    let opening = spec
        .grafcet
        .transition("v1_to_Wv2")
        .expect("the divergence");
    assert_eq!(opening.to.len(), 3);
    assert_eq!(opening.receptivity.to_string(), "ls2");
    let closing: Vec<_> = spec
        .grafcet
        .transitions()
        .filter(|transition| transition.from.len() == 3)
        .collect();
    assert_eq!(closing.len(), 1, "the branches wait for each other");
}

#[test]
fn accepting_in_steps_comes_to_the_same_as_accepting_at_once() {
    let program = program(FORMS[0]);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let all = decide(&analysis, &[], &Accept::Handovers);
    let mut text = write(&spec(&analysis, &[], &budget));
    for count in 1..=all.len() {
        let reading = grafcet::read(&text);
        let updated = update(&analysis, &reading.spec, &all[..count], &budget);
        assert_eq!(updated.departures, [], "after {count} decisions");
        text = rewrite(&text, &updated.spec);
    }
    let at_once = spec(&analysis, &all, &budget);
    let in_steps = grafcet::read(&text).spec;
    let sorted = |spec: &Spec| {
        let mut lines: Vec<String> = write(spec).lines().map(str::to_owned).collect();
        lines.retain(|line| line.contains("|-") || line.starts_with("//!"));
        lines.sort();
        lines
    };
    assert_eq!(sorted(&in_steps), sorted(&at_once));
}

#[test]
fn a_rule_edited_by_hand_survives_and_is_reported_with_a_fix() {
    let program = program(FORMS[0]);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let original = write(&spec(&analysis, &[], &budget));
    let edited = original.replace(
        "v1_ends: Xv1*ls2 |- @v1_off",
        "v1_ends: Xv1 * (ls2 + ls3) |- @v1_off  // overflow",
    );
    let reading = grafcet::read(&edited);

    let all = decide(&analysis, &[], &Accept::None);
    let updated = update(&analysis, &reading.spec, &all, &budget);
    assert_eq!(rewrite(&edited, &updated.spec), edited);

    let findings = spec_findings(&analysis, &reading, &edited, &budget);
    let [finding] = &findings[..] else {
        panic!("one finding, not {findings:#?}");
    };
    assert_eq!(finding.code, source::codes::RULE_NOT_SUPPORTED);
    let place = &edited[finding.span.range()];
    assert!(place.starts_with("v1_ends: Xv1 * (ls2 + ls3)"), "{place}");
    let fix = finding.fix.as_ref().expect("a fix");
    let mut mended = edited.clone();
    for edit in &fix.edits {
        mended.replace_range(edit.span.range(), &edit.text);
    }
    assert_eq!(
        grafcet::read(&mended).spec.grafcet.chart.transitions.len(),
        12
    );
    assert_eq!(
        spec_findings(&analysis, &grafcet::read(&mended), &mended, &budget),
        []
    );

    let keep = Decision::from(Verdict::Keep("v1_ends".into()));
    let kept = update(&analysis, &reading.spec, &[keep], &budget);
    assert_eq!(kept.departures, []);
}

#[test]
fn a_rule_deleted_by_hand_stays_deleted_and_a_rejection_stays_rejected() {
    let program = program(FORMS[0]);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let original = write(&spec(&analysis, &[], &budget));
    let line = "h_ends: Xh*(/ls1 + tl) |- @h_off\n";
    let edited = original.replace(line, "").replace(", h_ends", "");
    assert_ne!(edited, original);
    let reading = grafcet::read(&edited);
    let reject = Decision::from(Verdict::Reject {
        from: "v1".into(),
        to: "v4".into(),
    });
    let decisions = decide(&analysis, std::slice::from_ref(&reject), &Accept::Handovers);
    let accepts_v4 = decisions.iter().any(|decision| {
        matches!(&decision.verdict, Verdict::Accept { from, to }
            if **from == *"v1" && to.contains(&Name::from("v4")))
    });
    assert!(!accepts_v4);
    let updated = update(&analysis, &reading.spec, &[reject], &budget);
    assert!(updated.spec.grafcet.transition("h_ends").is_none());
    let [Departure::MissingTransition(missing)] = &updated.departures[..] else {
        panic!("one departure, not {:#?}", updated.departures);
    };
    assert_eq!(&*missing.name, "h_ends");
    assert_eq!(updated.spec.decisions.len(), 1);
}

#[test]
fn several_actions_of_one_step_on_one_output_all_survive() {
    let program = program(FORMS[0]);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let original = write(&spec(&analysis, &[], &budget));
    let edited = original.replace(
        "Xv1: |- v1\n",
        "Xv1: ls1 |- v1  // one\nXv1: ls3 |- v1  // two\n\
         Xv2: |- set v1\nXv2: |- set v1 on deactivation\n",
    );
    let reading = grafcet::read(&edited);
    let updated = update(&analysis, &reading.spec, &[], &budget);
    assert_eq!(rewrite(&edited, &updated.spec), edited);
    let given: Vec<bool> = updated
        .departures
        .iter()
        .map(|departure| match departure {
            Departure::Action { ladder, .. } => ladder.is_some(),
            other => panic!("an action, not {other:?}"),
        })
        .collect();
    assert_eq!(given, [true, false, false, false]);
}

/// What becomes of a spec in which a person changes a decision from `old` to
/// `new` by hand: the same as if the new decisions had been made at once.
#[track_caller]
fn check_by_hand(old: &str, new: &str) {
    let program = program(FORMS[0]);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let decisions = |lines: &str| grafcet::read(lines).spec.decisions;
    let before = write(&spec(&analysis, &decisions(old), &budget));
    let rules = before.split("\n//!").next().expect("rules");
    let edited = format!("{rules}\n{new}");
    let reading = grafcet::read(&edited);
    let updated = update(&analysis, &reading.spec, &reading.spec.decisions, &budget);
    assert_eq!(updated.departures, [], "{old:?} to {new:?}");
    let text = rewrite(&edited, &updated.spec);
    let at_once = spec(&analysis, &decisions(new), &budget);
    assert_eq!(
        grafcet::differences(
            &grafcet::read(&text).spec.grafcet,
            &at_once.grafcet,
            &Default::default()
        ),
        [],
        "{old:?} to {new:?}"
    );
}

#[test]
fn a_decision_changed_by_hand_takes_the_rules_along() {
    let all = "//! accept v1 -> v2 & h & m\n//! accept v1 -> v4\n//! accept v2 -> v3\n\
               //! accept v4 -> v1\n//! accept h -> v3\n";
    check_by_hand("", "//! accept v1 -> v2 & h & m\n");
    check_by_hand(
        "//! accept v1 -> v2\n",
        "//! accept v1 -> v2\n//! accept v2 -> v3\n",
    );
    check_by_hand("//! accept v2 -> v3\n", "//! reject v2 -> v3\n");
    check_by_hand(all, &all.replace("//! accept v1 -> v4\n", ""));
    check_by_hand(all, &all.replace("accept v2 -> v3", "reject v2 -> v3"));
    check_by_hand(all, &format!("{all}//! initial v1\n"));
    check_by_hand(&format!("{all}//! initial v1\n"), all);
    check_by_hand(all, "");
}

#[test]
fn a_changed_ladder_makes_its_old_rules_stale() {
    let path = end_to_end::path(FORMS[0]);
    let before = std::fs::read_to_string(path).expect("a readable fixture");
    let after = before.replacen("/ls2", "/ls3", 1);
    assert_ne!(before, after);
    let budget = Budget::default();
    let (old, new) = (
        ladder::read(before.as_bytes()).program,
        ladder::read(after.as_bytes()).program,
    );
    let text = write(&spec(&recovery::analyse(&old, &budget), &[], &budget));
    let analysis = recovery::analyse(&new, &budget);
    let reading = grafcet::read(&text);
    let findings = spec_findings(&analysis, &reading, &text, &budget);
    let stale: Vec<&str> = findings
        .iter()
        .map(|finding| text[finding.span.range()].split(':').next().unwrap_or(""))
        .collect();
    assert_eq!(stale, ["v1_starts", "v1_ends"]);
}

#[test]
fn what_is_written_for_real_files_reads_back_and_needs_no_update() {
    let Some(corpus) = end_to_end::corpus() else {
        return;
    };
    let budget = Budget::default();
    for folder in ["plcopen", "l5x"] {
        let entries = std::fs::read_dir(corpus.join(folder)).expect("a folder of the corpus");
        for entry in entries {
            let path = entry.expect("an entry").path();
            let bytes = std::fs::read(&path).expect("a readable file");
            // The largest plants take their time in an unoptimised build.
            if bytes.len() > 700_000 {
                continue;
            }
            let program = ladder::read(&bytes).program;
            let analysis = recovery::analyse(&program, &budget);
            let decisions = decide(&analysis, &[], &Accept::Handovers);
            let spec = spec(&analysis, &decisions, &budget);
            let text = write(&spec);
            let reading = grafcet::read(&text);
            let errors: Vec<_> = reading
                .diagnostics
                .iter()
                .filter(|it| it.severity == Severity::Error)
                .collect();
            assert!(errors.is_empty(), "{}: {errors:#?}", path.display());
            assert_eq!(reading.spec, spec, "{}", path.display());
            let updated = update(&analysis, &reading.spec, &decisions, &budget);
            assert_eq!(updated.departures, [], "{}", path.display());
            assert!(rewrite(&text, &updated.spec) == text, "{}", path.display());
        }
    }
}

#[test]
fn names_that_need_quotes_are_quoted_everywhere() {
    let program = program(FORMS[1]);
    let spec = converted(&program, &Accept::Handovers);
    for variable in spec.grafcet.variables() {
        let quoted = notation::quoted(&variable.name);
        assert!(write(&spec).contains(&quoted), "{quoted}");
    }
}
