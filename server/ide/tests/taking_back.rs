//! What is decided and then taken back leaves the spec as it was, byte for byte.

use std::fs;

use grafcet::Verdict;
use ide::{Change, Departing, Ladder, Spec, changed_spec};
use logic::{Budget, Name};
use proptest::prelude::*;
use proptest::sample::{Index, select};
use recovery::successions::{Evidence, Kind};

/// Programs in which states follow each other.
const REAL: [&str; 4] = [
    "l5x/francisboudreau7__l5x_sfc__MainProgram.L5X",
    "l5x/reh3376__acd-l5x-tool-lib__DropTub_AutoLogic_Program.L5X",
    "plcopen/SDC-UIUC__FactoryIO-PLC__FT_con01.xml",
    "plcopen/SDC-UIUC__FactoryIO-PLC__FT_con02.xml",
];

fn fixtures() -> Vec<Ladder> {
    let own = ["ladder", "L5X", "xml"].map(|form| {
        let path = format!("fixtures/neutralization/neutralization.{form}");
        end_to_end::path(&path)
    });
    let real = end_to_end::corpus().into_iter();
    let real = real.flat_map(|corpus| REAL.map(|name| corpus.join(name)));
    let ladders = own.into_iter().chain(real).map(|path| {
        let text = fs::read_to_string(path).expect("a ladder");
        Ladder::read(text.into(), &Budget::default())
    });
    ladders.collect()
}

fn changed(ladder: &Ladder, text: &str, change: Change) -> String {
    let spec = (!text.is_empty()).then(|| Spec::read(text.into()));
    let budget = Budget::default();
    changed_spec(ladder, spec.as_ref(), &[change], Departing::Stay, &budget)
}

/// Everything that can be decided and is not.
fn open(ladder: &Ladder, text: &str) -> Vec<Verdict> {
    let spec = Spec::read(text.into());
    let decided = ide::Decided::of(&spec);
    let all = ladder.analysis.successions().iter();
    let open = all.filter(|it| {
        it.evidence != Evidence::Written
            && decided.standing(&it.from, &it.to) == ide::Standing::Open
    });
    let mut verdicts = Vec::new();
    for succession in open.clone() {
        let (from, to) = (succession.from.clone(), succession.to.clone());
        let together: Vec<Name> = open
            .clone()
            .filter(|it| it.from == from && it.kind == Kind::And)
            .map(|it| it.to.clone())
            .collect();
        if together.len() > 1 && together.contains(&to) {
            verdicts.push(Verdict::Accept {
                from: from.clone(),
                to: together,
            });
        }
        verdicts.push(Verdict::Accept {
            from: from.clone(),
            to: vec![to.clone()],
        });
        verdicts.push(Verdict::Reject { from, to });
    }
    let has_initial = spec.reading.spec.decisions.iter();
    let has_initial = has_initial
        .filter(|it| matches!(it.verdict, Verdict::Initial(_)))
        .count()
        > 0;
    if !has_initial {
        let groups = ladder.analysis.groups().iter();
        let states = groups.flat_map(|group| group.states.first().cloned());
        let bits = states.filter(|it| ladder.analysis.states().find(it).is_some());
        verdicts.extend(bits.map(Verdict::Initial));
    }
    verdicts
}

/// What people do to a spec that no decision depends on.
fn noted(text: &str, note: Note) -> String {
    match note {
        Note::None => text.to_owned(),
        Note::AtTheTop => format!("// Seen at the plant, 🛑 not finished\n\n{text}"),
        Note::BehindTheName => text.replacen('\n', "  // ours\n", 1),
        Note::RuleOfTheirOwn => {
            let mut spec = grafcet::read(text).spec;
            let own = grafcet::read("Environment:\ne1: 1 |- /e_stop  // by wire\n").spec;
            spec.environment.extend(own.environment);
            grafcet::rewrite(text, &spec)
        }
        Note::WindowsLineEnds => text.replace('\n', "\r\n"),
        Note::ByteOrderMark => format!("\u{feff}{text}"),
    }
}

#[derive(Clone, Copy, Debug)]
enum Note {
    None,
    AtTheTop,
    BehindTheName,
    RuleOfTheirOwn,
    WindowsLineEnds,
    ByteOrderMark,
}

const NOTES: [Note; 6] = [
    Note::None,
    Note::AtTheTop,
    Note::BehindTheName,
    Note::RuleOfTheirOwn,
    Note::WindowsLineEnds,
    Note::ByteOrderMark,
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, max_shrink_iters: 20, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn taking_back_what_was_decided_last_changes_nothing(
        ladder in any::<Index>(),
        before in prop::collection::vec(any::<Index>(), 0..4),
        note in select(NOTES.as_slice()),
        last in any::<Index>(),
    ) {
        thread_local!(static LADDERS: Vec<Ladder> = fixtures());
        LADDERS.with(|ladders| {
            let ladder = ladder.get(ladders);
            let budget = Budget::default();
            let mut text = changed_spec(ladder, None, &[], Departing::Stay, &budget);
            for choice in &before {
                let open = open(ladder, &text);
                if !open.is_empty() {
                    text = changed(ladder, &text, Change::Make(choice.get(&open).clone()));
                }
            }
            let text = noted(&text, note);
            let open = open(ladder, &text);
            prop_assume!(!open.is_empty());
            let verdict = last.get(&open).clone();
            let decided = changed(ladder, &text, Change::Make(verdict.clone()));
            prop_assert_ne!(&decided, &text);
            let back = changed(ladder, &decided, Change::Withdraw(verdict.clone()));
            prop_assert_eq!(back, text, "{:?}", verdict);
            Ok(())
        })?;
    }
}
