//! Everything from bytes to suggestions.

use logic::Budget;

/// Reads a ladder and recovers all that is recovered before anybody decides
/// anything. How many successions were found.
pub fn successions(text: &str) -> usize {
    let reading = ladder::read(text.as_bytes());
    let analysis = recovery::analyse(&reading.program, &Budget::default());
    analysis.successions().len()
}
