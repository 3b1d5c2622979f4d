//! What `convert --accept none` writes does what the ladder does.

use std::sync::Arc;

use ladder::Program;
use logic::Budget;
use proof::Limits;
use recovery::conversion::{Accept, decide, spec};
use verification::{Timing, Verification, verify};

use crate::program::Program as Random;
use crate::random;
use crate::{assert_told, program, text, told};

/// The product form of a program, against it.
pub fn product(
    program: &Arc<Program>,
    limits: &Limits,
) -> Result<Verification, verification::Refusal> {
    let budget = Budget::default();
    let analysis = recovery::analyse(program, &budget);
    let decisions = decide(&analysis, &[], &Accept::None);
    let spec = spec(&analysis, &decisions, &budget);
    verify(program, &spec, Timing::Scan, limits)
}

#[test]
fn the_product_form_of_the_neutralization_needs_no_rule() {
    for ladder in ["ladder", "L5X", "xml"] {
        let text = text(&format!("fixtures/neutralization/neutralization.{ladder}"));
        let found = product(&program(&text), &Limits::default()).expect("a translation");
        assert_told(&found.verdict, "equivalent");
        assert_eq!((found.outputs.len(), found.missing.len()), (8, 0));
    }
}

/// The verdict about the product form of a ladder, and what it does not say
/// exactly.
fn judged(text: &str) -> (String, Vec<String>, String) {
    let program = program(text);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let spec = spec(&analysis, &[], &budget);
    let unsaid = recovery::conversion::unsaid(&analysis, &[], &budget);
    let unsaid = unsaid
        .iter()
        .map(|(name, why)| format!("{name}: {}", why.words()));
    let limits = Limits {
        steps: 30_000_000,
        ..Limits::default()
    };
    let verdict = match verify(&program, &spec, Timing::Scan, &limits) {
        Ok(found) => told(&found.verdict),
        Err(refusal) => format!("refused: {refusal}"),
    };
    (verdict, unsaid.collect(), grafcet::write(&spec))
}

/// A condition over inputs and coils.
fn condition(random: &mut random::Random, depth: usize, edges: bool) -> String {
    let names = ["a", "b", "c", "p", "q", "r", "s"];
    let name = random.one_of(&names);
    let kinds = if depth == 0 { 6 } else { 10 };
    match random.below(kinds) {
        0 if edges => format!("rise({name})"),
        1 if edges => format!("fall({name})"),
        0..=3 => name.to_owned(),
        4..=5 => format!("/{name}"),
        kind => {
            let mut part = || condition(random, depth - 1, edges);
            let (one, other) = (part(), part());
            match kind {
                6..=7 => format!("({one} + {other})"),
                _ => format!("{one}*{other}"),
            }
        }
    }
}

/// A ladder in which rungs look at coils of rungs above and below, and write
/// coils that others write too.
fn ladder(random: &mut random::Random, edges: bool) -> String {
    let mut text = "program Random\n".to_owned();
    for name in ["a", "b", "c"] {
        text += &format!("input {name}\n");
    }
    for name in ["p", "q", "r", "s"] {
        let initial = random.one_of(&["", "", "", " := 1"]);
        text += &format!("output {name}{initial}\n");
    }
    for _ in 0..2 + random.below(5) {
        let coil = random.one_of(&["p", "q", "r", "s"]);
        let kind = random.one_of(&["", "", "", "/", "set ", "reset "]);
        let on = condition(random, 2, edges);
        text += &match random.below(5) {
            0 => format!(
                "rung: {on} + {coil}*{} -> {coil}\n",
                condition(random, 0, edges)
            ),
            1 => {
                let (leg, other) = (condition(random, 1, edges), random.one_of(&["p", "q"]));
                format!("rung: {on} -> {kind}{coil}, ({leg} -> {other})\n")
            }
            _ => format!("rung: {on} -> {kind}{coil}\n"),
        };
    }
    text
}

#[test]
fn the_product_form_of_random_ladders_does_what_they_do() {
    let mut random = random::Random::new(5);
    let mut counts = std::collections::BTreeMap::new();
    for number in 0..400 {
        let text = ladder(&mut random, number % 2 == 1);
        let (verdict, unsaid, spec) = judged(&text);
        let verdict = verdict.lines().next().unwrap_or_default().to_owned();
        let word = verdict.split(' ').next().unwrap_or_default().to_owned();
        *counts.entry((unsaid.is_empty(), word.clone())).or_insert(0) += 1;
        assert!(
            word == "equivalent" || verdict.ends_with("Nothing") || !unsaid.is_empty(),
            "{number}: {verdict}\n{text}\n{spec}\n{unsaid:?}"
        );
    }
    panic!("{counts:?}");
}

#[test]
fn random_ladders_with_everything() {
    let mut random = random::Random::new(6);
    let mut counts = std::collections::BTreeMap::new();
    for number in 0..300 {
        let text = crate::random_text::text(&Random::random(&mut random));
        let (verdict, unsaid, spec) = judged(&text);
        let word = verdict.split(' ').next().unwrap_or_default().to_owned();
        let word =
            if word.starts_with("unknown") || word.starts_with("refused") || word == "equivalent" {
                word
            } else {
                "different".into()
            };
        for it in &unsaid {
            eprintln!(
                "WHY {}",
                it.split_once(": ").unwrap().1.split('`').next().unwrap()
            );
        }
        *counts.entry((unsaid.is_empty(), word.clone())).or_insert(0) += 1;
        assert!(
            word != "different" || !unsaid.is_empty(),
            "{number}: {verdict}\n{text}\n{spec}\n{unsaid:?}"
        );
    }
    panic!("{counts:?}");
}
