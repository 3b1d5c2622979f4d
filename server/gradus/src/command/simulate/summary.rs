//! How a simulation went, in a line or two for people.

use recovery::simulation::{Simulation, Subject};
use scenario::Scenario;

use crate::input::numbered;
use crate::report::printable;

/// `12 scans; all is as expected; ladder and spec agree`, and where the run was
/// stopped a second line that says why.
pub fn summary(
    scenario: &Scenario,
    simulation: &Simulation,
    subject: Subject<'_>,
    line_of: impl Fn(usize) -> Option<usize>,
) -> String {
    let scans = simulation.rows.last().map_or(0, |row| row.scan);
    let scans = usize::try_from(scans).unwrap_or(usize::MAX);
    let mut parts = vec![numbered(scans, "scan")];
    let expects = |step: &scenario::Step| step.only || !step.expected.is_empty();
    if scenario.steps.iter().any(expects) {
        let failed = simulation.failures().count();
        parts.push(match failed {
            0 => "all is as expected".to_owned(),
            failed => format!("{} not met", numbered(failed, "expectation")),
        });
    }
    if subject.ladder.is_some() && subject.grafcet.is_some() {
        let rows = simulation.rows.iter();
        let differing = rows.filter(|row| !row.differences.is_empty());
        parts.push(match differing.count() {
            0 => "ladder and spec agree".to_owned(),
            rows => format!("ladder and spec differ in {}", numbered(rows, "line")),
        });
    }
    let mut text = format!("{}\n", parts.join("; "));
    if let Some((step, stop)) = &simulation.stopped {
        let place = line_of(*step).map(|line| format!(" at line {line}"));
        let place = place.unwrap_or_default();
        let reason = printable(&stop.sentence(scenario.cycle_ms));
        text += &format!("stopped{place}: {reason}\n");
    }
    text
}
