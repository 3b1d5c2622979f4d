//! Texts that are cut, encoded otherwise, nested too deep, far too long, or
//! faulty in thousands of places: each is read, within a small stack, with a
//! finding that says what is wrong and in time that grows with the text.
//!
//! Small ones with what the commands say about them are in `fixtures/hostile`.

mod cut;
mod encoded;
mod forms;
mod linear;
mod places;
mod read;

use end_to_end::on_a_small_stack;
use ladder::Reading;

/// Reads `bytes`, and looks whether each finding lies in the text and says
/// something.
fn read(bytes: &[u8]) -> Reading {
    let reading = ladder::read(bytes);
    assert_eq!(places::outside(bytes, &reading), None);
    assert!(reading.diagnostics.iter().all(|it| !it.message.is_empty()));
    reading
}

/// Whether a finding has this code.
fn gives(reading: &Reading, code: &str) -> bool {
    let mut codes = reading.diagnostics.iter().map(|it| it.code.to_string());
    codes.any(|found| found == code)
}
