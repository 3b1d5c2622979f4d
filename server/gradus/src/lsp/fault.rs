//! Faults that a test asks for.
//!
//! A server must outlive its own faults, and a test can show it only if there
//! is one. So in a build with debug assertions, and in no other, the variable
//! `GRADUS_TEST_PANIC` names a place that panics whenever it is reached: a
//! method of the protocol, [`WORK`] or [`DIAGNOSTICS`].

/// The work for a request, on the thread that does it.
pub const WORK: &str = "work";

/// Finding what there is to say about a document.
pub const DIAGNOSTICS: &str = "diagnostics";

/// Panics if a test asked for it at this place.
pub fn forced(place: &str) {
    if cfg!(debug_assertions) && std::env::var("GRADUS_TEST_PANIC").is_ok_and(|it| it == place) {
        panic!("GRADUS_TEST_PANIC asked for it");
    }
}
