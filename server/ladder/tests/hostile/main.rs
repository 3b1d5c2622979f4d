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

use ladder::Reading;

/// Stack of the thread that reads: a quarter of what threads of Rust have, or
/// all of that where nothing is optimised and frames are several times larger.
const STACK: usize = if cfg!(debug_assertions) {
    2 << 20
} else {
    512 << 10
};

/// Runs `work` on a thread with a small stack: a walk that goes deeper the
/// larger its text is does not come back from there.
fn on_a_small_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        std::thread::Builder::new()
            .stack_size(STACK)
            .spawn_scoped(scope, work)
            .expect("a thread")
            .join()
            .expect("work that comes back")
    })
}

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
