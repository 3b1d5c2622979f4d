use std::cell::Cell;

use recovery::simulation::{Extent, Subject, recorded, simulate_within};

use crate::halves;
use crate::rules::are_inside;

/// More scans than a short text can ask for in many steps, and few enough to be
/// run at once.
const SCANS: u64 = 2_000;

/// Reads `bytes` as a scenario. Places lie in the text; the layout is stable and
/// says the same; so does what is written.
pub fn keeps_scenarios(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let reading = scenario::read(text);
    for it in &reading.diagnostics {
        are_inside(text, it);
    }
    let laid_out = scenario::format(text);
    let again = scenario::format(&laid_out.text);
    assert_eq!(laid_out.text, again.text, "laid out twice");
    let said = scenario::write(&reading.scenario);
    let rest = scenario::read(&laid_out.text).scenario;
    assert_eq!(scenario::write(&rest), said, "laid out: {}", laid_out.text);
    let back = scenario::read(&said);
    assert_eq!(scenario::write(&back.scenario), said, "written: {said}");
}

/// Runs the scenario before the line of `=` on the spec after it, and, what came
/// out written down as a scenario, once more: then every expectation is met.
pub fn runs_scenarios(bytes: &[u8]) {
    let Some((text, spec)) = halves(bytes) else {
        return;
    };
    let scenario = scenario::read(text).scenario;
    let spec = grafcet::read(spec).spec;
    let subject = Subject {
        ladder: None,
        grafcet: Some(&spec.grafcet),
    };
    // Without a clock: so many scans, however often they are asked for.
    let scans = Cell::new(0);
    let wanted = || {
        scans.set(scans.get() + 1);
        scans.get() <= SCANS
    };
    let extent = Extent {
        scans: SCANS,
        wanted: &wanted,
    };
    let came = simulate_within(&scenario, subject, extent);
    if came.stopped.is_some() {
        return;
    }
    let recorded = recorded(&scenario, &came);
    scans.set(0);
    let again = simulate_within(&recorded, subject, extent);
    let failed = again.rows.iter().flat_map(|row| &row.failures);
    let failed: Vec<_> = failed.collect();
    assert!(failed.is_empty(), "{failed:?}: {}", scenario::write(&recorded));
}
