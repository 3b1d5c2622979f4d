//! What `convert --accept none` writes does what the ladder does.

use std::sync::Arc;

use ladder::Program;
use logic::Budget;
use proof::Limits;
use recovery::conversion::{Accept, decide, spec};
use verification::{Timing, Verification, verify};

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

/// Real programs, read in place: what is written of them is never told to be
/// equal where it is not, and the shortest difference is shown where it is.
#[test]
fn the_product_forms_of_real_programs_are_proved_where_they_can_be() {
    let Some(folder) = end_to_end::corpus() else {
        return;
    };
    let mut found = std::collections::BTreeMap::<String, usize>::new();
    let mut paths: Vec<_> = ["l5x", "plcopen", "ascii", "openplc-ld"]
        .iter()
        .filter_map(|kind| std::fs::read_dir(folder.join(kind)).ok())
        .flat_map(|entries| entries.filter_map(|entry| Some(entry.ok()?.path())))
        .collect();
    paths.sort();
    for path in paths {
        let Ok(bytes) = std::fs::read(&path) else {
            continue;
        };
        let program = ladder::read(&bytes).program;
        if program.rungs().next().is_none() {
            continue;
        }
        let limits = Limits {
            steps: 50_000_000,
            ..Limits::default()
        };
        let now = std::time::Instant::now();
        let verdict = match product(&program, &limits) {
            Ok(it) if it.outputs.is_empty() => "no outputs".to_owned(),
            Ok(it) => crate::told(&it.verdict),
            Err(refusal) => refusal.to_string(),
        };
        println!(
            "{} {:?}\n{verdict}",
            path.file_name().unwrap_or_default().to_string_lossy(),
            now.elapsed()
        );
        let kind = verdict
            .lines()
            .last()
            .unwrap_or_default()
            .split([':', '`'])
            .next()
            .unwrap_or_default();
        *found.entry(kind.to_owned()).or_default() += 1;
    }
    println!("{found:#?}");
}
