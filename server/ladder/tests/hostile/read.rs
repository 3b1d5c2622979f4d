//! Every form is read, and what was read can be copied, shown, written and
//! dropped.

use crate::forms::{self, FORMS};
use crate::{gives, on_a_small_stack, read};

/// As large as every form is tried.
const MANY: usize = 400;

#[test]
fn every_form_gives_its_findings_and_can_be_handled_on_a_small_stack() {
    for form in FORMS {
        let text = (form.text)(MANY);
        on_a_small_stack(|| {
            let reading = read(text.as_bytes());
            for code in form.codes {
                assert!(gives(&reading, code), "{}: no {code}", form.name);
            }
            let copy = reading.clone();
            drop(reading);
            assert!(!format!("{copy:?}").is_empty());
            let written = ladder::text::write(&copy.program);
            drop(copy);
            ladder::text::format(&written.text);
            ladder::text::format(&text);
        });
    }
}

/// The limits on nesting are far above what real programs need: text that
/// nests half as deep as a limit is read without an error.
#[test]
fn nesting_below_the_limits_is_read() {
    let round = |depth: usize| ("(".repeat(depth), ")".repeat(depth));
    let (open, close) = round(100);
    let branches = "[XIC(b),".repeat(32) + "XIC(c)" + &"]".repeat(32);
    for text in [
        format!("rung: {open}a{close} -> v\n"),
        format!("rung: a -> {}v{}\n", "(c -> ".repeat(100), ")".repeat(100)),
        format!("XIC(a){branches}OTE(v);"),
        forms::l5x(&format!("{}{}", "<a>".repeat(128), "</a>".repeat(128))),
    ] {
        assert_eq!(on_a_small_stack(|| read(text.as_bytes())).diagnostics, []);
    }
}

/// Contacts of one rung, as many as an unoptimised build reads in a few
/// seconds; `cargo test --release` takes all.
const LONG: usize = if cfg!(debug_assertions) {
    4_000
} else {
    200_000
};

#[test]
fn a_rung_of_very_many_contacts_is_read_whole() {
    let rungs = FORMS
        .iter()
        .filter(|form| form.name.contains("contacts in"));
    for form in rungs {
        let text = (form.text)(LONG);
        let count = on_a_small_stack(|| {
            let reading = read(text.as_bytes());
            let lengths = reading.program.rungs().map(|(_, rung)| rung.network.len());
            let longest = lengths.max().unwrap_or_default();
            drop(reading.clone());
            longest
        });
        assert!(count > LONG, "{}: {count} elements", form.name);
    }
}

/// 64 MiB of what opens and never closes.
#[test]
fn mebibytes_of_nesting_are_refused() {
    const SIZE: usize = 64 << 20;
    for (opening, code) in [("<a>", "G1005"), ("<a b=\"\">", "G1005")] {
        for text in [forms::l5x, forms::plcopen] {
            let text = text(&opening.repeat(SIZE / opening.len()));
            let reading = on_a_small_stack(|| read(text.as_bytes()));
            assert!(gives(&reading, code), "{opening}");
        }
    }
}
