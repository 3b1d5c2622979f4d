//! The tank of the case study: its sequence, the same without one rule after the
//! other, and its product form.

use std::fs;
use std::path::Path;

use grafcet::Spec;
use logic::Budget;
use proof::Limits;
use recovery::conversion::spec;
use verification::{Timing, Verdict, verify};

use crate::tool;

#[test]
fn abc_agrees_about_the_tank() {
    let Some(abc) = tool::abc() else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abc-tank");
    fs::create_dir_all(&folder).expect("a folder");
    let text = |name: &str| {
        let path = end_to_end::path(&format!("fixtures/neutralization/{name}"));
        fs::read_to_string(path).expect("a fixture")
    };
    let program = ladder::read(text("neutralization.ladder").as_bytes()).program;
    let agreed = |spec: &Spec| -> Option<usize> {
        let limits = Limits::default();
        let found = verify(&program, spec, Timing::Scan, &limits).expect("a translation");
        let said = match &found.verdict {
            Verdict::Equivalent => None,
            Verdict::Different(it) => Some(it.trace.steps.len()),
            Verdict::Unknown { why, .. } => panic!("{why:?}"),
        };
        let says = tool::model_checked(&abc, &folder, &found.question, said);
        assert_eq!(said, says);
        said
    };
    let sequence = grafcet::read(&text("sequence.grafcet")).spec;
    assert_eq!(agreed(&sequence), None);
    for at in 0..sequence.environment.len() {
        let mut fewer = sequence.clone();
        fewer.environment.remove(at);
        assert!(agreed(&fewer).is_some());
    }
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    assert_eq!(agreed(&spec(&analysis, &[], &budget)), None);
}
