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
