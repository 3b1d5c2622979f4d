//! Verdicts about a ladder and a spec.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::verifies(bytes));
