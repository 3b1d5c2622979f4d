//! What holds for every scenario and every text.

use logic::{Datum, Name, Relation};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;
use scenario::{
    Change, Expectation, FileName, Passing, Scenario, Step, Test, Timing, format, read, write,
};
use source::Span;

const NAMES: [&str; 9] = [
    "s",
    "ls2",
    "on",
    "wait",
    "Local:1:I.Data.4",
    "%I0",
    "T1.DN",
    "drill up",
    "für",
];

fn names() -> impl Strategy<Value = Name> {
    select(&NAMES[..]).prop_map(Name::from)
}

fn numbers() -> impl Strategy<Value = Datum> {
    prop_oneof![
        any::<i64>().prop_map(Datum::Integer),
        (-1e9..1e9f64).prop_map(Datum::Real),
        Just(Datum::Real(3.0)),
        Just(Datum::Real(1e-7)),
    ]
}

fn changes() -> impl Strategy<Value = Change> {
    let value = prop_oneof![any::<bool>().prop_map(Datum::Bool), numbers()];
    (names(), value).prop_map(|(name, value)| Change {
        name,
        value,
        span: Span::default(),
    })
}

fn expectations() -> impl Strategy<Value = Expectation> {
    use Relation::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
    let relations = vec![Equal, NotEqual, Less, LessOrEqual, Greater, GreaterOrEqual];
    let test = prop_oneof![
        Just(Test::On),
        Just(Test::Off),
        (select(relations), numbers())
            .prop_map(|(relation, value)| Test::Compares(relation, value)),
    ];
    (names(), test).prop_map(|(name, test)| Expectation {
        name,
        test,
        span: Span::default(),
        named: Span::default(),
    })
}

fn steps() -> impl Strategy<Value = Step> {
    let passing = prop_oneof![
        3 => Just(Passing::Scans(1)),
        1 => (1..9u32).prop_map(Passing::Scans),
        1 => (0..1_000_000u64).prop_map(Passing::Wait),
    ];
    let comment = option::of(select(vec!["go", "/ x // y", "été"]).prop_map(Name::from));
    (
        vec(changes(), 0..3),
        passing,
        vec(expectations(), 0..3),
        any::<bool>(),
        comment,
    )
        .prop_map(|(changes, passing, expected, only, comment)| Step {
            changes,
            passing,
            expected,
            only,
            comment,
            span: Span::default(),
        })
}

fn scenarios() -> impl Strategy<Value = Scenario> {
    let file = select(vec!["tank.ladder", "line 3/a.L5X"]).prop_map(|path| FileName {
        path: path.into(),
        span: Span::default(),
    });
    (
        option::of(select(vec!["Filling", "on s", ""]).prop_map(Name::from)),
        vec(file, 0..3),
        select(vec![Timing::Scan, Timing::Settled]),
        1..100_000u64,
        vec(steps(), 0..6),
    )
        .prop_map(|(title, files, timing, cycle_ms, steps)| Scenario {
            title,
            files,
            timing,
            cycle_ms,
            steps,
        })
}

/// Without the places in the text.
fn placeless(mut scenario: Scenario) -> Scenario {
    let files = scenario.files.iter_mut().map(|it| &mut it.span);
    files.for_each(|span| *span = Span::default());
    for step in &mut scenario.steps {
        step.span = Span::default();
        step.changes
            .iter_mut()
            .for_each(|it| it.span = Span::default());
        for expectation in &mut step.expected {
            expectation.span = Span::default();
            expectation.named = Span::default();
        }
    }
    scenario
}

proptest! {
    #[test]
    fn what_is_written_reads_back_as_it_was(scenario in scenarios()) {
        let text = write(&scenario);
        let reading = read(&text);
        prop_assert_eq!(&reading.diagnostics, &[]);
        prop_assert_eq!(write(&reading.scenario), text.clone());
        prop_assert_eq!(&format(&text).text, &text);
        prop_assert_eq!(placeless(reading.scenario), scenario);
    }

    #[test]
    fn no_text_is_too_much_and_layout_keeps_what_it_says(
        pieces in vec(select(vec![
            "on", "off", "wait", "scan", "only", "scenario", "for", "timing", "cycle", " ", " ",
            "\n", "\r\n", "\r", "=>", "=", ",", "//", "-", "5", "5s", "0", "s", "\"", "é", "\u{feff}", "{",
            "<>", "9999999999999999999", "on s => on q\n",
        ]), 0..40),
    ) {
        let text = pieces.concat();
        let before = read(&text);
        let formatted = format(&text);
        let after = read(&formatted.text);
        prop_assert_eq!(placeless(before.scenario), placeless(after.scenario));
        prop_assert_eq!(before.diagnostics.len(), after.diagnostics.len());
        prop_assert_eq!(&format(&formatted.text).text, &formatted.text);
        let comments = |text: &str| text.matches("//").count();
        prop_assert_eq!(comments(&text), comments(&formatted.text));
    }
}
