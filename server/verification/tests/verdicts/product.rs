//! What `convert --accept none` writes does what the ladder does.

use std::sync::Arc;

use ladder::Program;
use logic::Budget;
use proof::Limits;
use recovery::conversion::{Accept, decide, spec};
use verification::{Timing, Verdict, Verification, verify};

use crate::{assert_told, program, text};

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

/// Real programs, read in place, up to a size: most are proved. What is told to
/// be different was seen to be so, and is a matter of the conversion.
#[test]
fn the_product_forms_of_most_small_real_programs_are_proved() {
    let Some(folder) = end_to_end::corpus() else {
        return;
    };
    let mut paths: Vec<_> = ["l5x", "plcopen", "ascii", "openplc-ld"]
        .iter()
        .filter_map(|kind| std::fs::read_dir(folder.join(kind)).ok())
        .flat_map(|entries| entries.filter_map(|entry| Some(entry.ok()?.path())))
        .filter(|path| std::fs::metadata(path).is_ok_and(|it| it.len() < 60_000))
        .collect();
    paths.sort();
    let (mut proved, mut others) = (0, 0);
    for path in paths {
        let program = ladder::read(&std::fs::read(&path).expect("a file")).program;
        let limits = Limits {
            steps: 50_000_000,
            ..Limits::default()
        };
        match product(&program, &limits) {
            Ok(it) if it.outputs.is_empty() => {}
            Ok(it) if it.verdict == Verdict::Equivalent => proved += 1,
            _ => others += 1,
        }
    }
    println!("{proved} proved, {others} not");
    assert!(proved > 3 * others, "{proved} proved, {others} not");
}
