//! Rule texts that nest too deep, go on for ever, or are faulty in thousands of
//! places: each is read, laid out, written and rewritten within a small stack.

use end_to_end::on_a_small_stack;
use grafcet::{format, read, rewrite, write};

const HEAD: &str =
    "Input m\nStep p1, p2\nTransition t0\nMarking p1\n\nTransitions:\nt0: p1*m |- @p2\n";

/// A piece that is repeated after a spec, and whether that is an error.
const PIECES: [(&str, bool); 22] = [
    ("(", true),
    ("t1: p1*(", true),
    ("t1: p1*m |- @p2\n", true),
    ("t1: p1*m |- @p2*", true),
    ("@", true),
    ("|-", true),
    (":", true),
    ("\"", true),
    ("$", true),
    ("é", true),
    ("\u{feff}", false),
    ("Step p1\n", true),
    ("Step ", true),
    ("Input a, ", true),
    ("Transitions:\n", false),
    ("//! accept a -> b\n", false),
    ("//! nonsense\n", false),
    ("// remark\n", false),
    ("\r", false),
    ("\t", false),
    ("Macro M\n", true),
    ("t1:\n", true),
];

#[test]
fn whatever_is_repeated_is_read_laid_out_and_kept() {
    for (piece, is_wrong) in PIECES {
        let text = HEAD.to_owned() + &piece.repeat(400);
        on_a_small_stack(|| {
            let reading = read(&text);
            for it in &reading.diagnostics {
                assert!(text.get(it.span.range()).is_some(), "{piece:?}: {it:?}");
                assert!(!it.message.is_empty());
            }
            let found = reading
                .diagnostics
                .iter()
                .any(|it| it.severity == source::Severity::Error);
            assert_eq!(
                found,
                is_wrong,
                "{piece:?}: {:?}",
                reading.diagnostics.first()
            );
            // What stands before it is read.
            let kept = reading.spec.grafcet.chart.transition("t0").is_some();
            assert!(kept, "{piece:?}");
            let laid_out = format(&text);
            assert_eq!(format(&laid_out.text).text, laid_out.text, "{piece:?}");
            assert_eq!(rewrite(&text, &reading.spec), text, "{piece:?}");
            let written = write(&reading.spec);
            assert_eq!(write(&read(&written).spec), written, "{piece:?}");
            drop(reading.spec.clone());
        });
    }
}

#[test]
fn nesting_is_refused_at_its_place() {
    for open in ["(", "/(", "rise(", "^", "@p2*("] {
        let text = format!("{HEAD}t0: p1*{}\nt1: p2*m |- @p1\n", open.repeat(50_000));
        let reading = on_a_small_stack(|| read(&text));
        let it = reading
            .diagnostics
            .iter()
            .find(|it| it.code == source::codes::SPEC_SYNTAX);
        let it = it.unwrap_or_else(|| panic!("{open}: {:?}", reading.diagnostics));
        assert!(
            it.span.range().start < HEAD.len() + 20 + 210 * open.len(),
            "{open}: {it:?}"
        );
        // The next rule is read.
        assert!(
            reading.spec.grafcet.chart.transition("t1").is_some(),
            "{open}"
        );
    }
}

/// Twice the text asks memory for twice the bytes.
#[test]
fn twice_the_text_takes_twice_the_work() {
    for (piece, _) in PIECES {
        let bytes = |count: usize| {
            let text = HEAD.to_owned() + &piece.repeat(count);
            let counted = allocation_counter::measure(|| {
                read(&text);
            });
            counted.bytes_total
        };
        let (once, twice) = (bytes(1_000), bytes(2_000));
        assert!(
            twice <= once * 22 / 10 + 20_000,
            "{piece:?}: {once}, {twice}"
        );
    }
}

#[test]
fn a_text_cut_anywhere_is_read_to_the_cut() {
    let text = include_str!("../../../fixtures/grafcet/everything.grafcet");
    for at in (0..text.len()).filter(|&at| text.is_char_boundary(at)) {
        let cut = &text[..at];
        let reading = read(cut);
        let mut spans = reading.diagnostics.iter().map(|it| it.span);
        assert!(
            spans.all(|span| cut.get(span.range()).is_some()),
            "cut at {at}"
        );
        assert_eq!(rewrite(cut, &reading.spec), cut, "cut at {at}");
    }
}
