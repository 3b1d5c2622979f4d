//! Specs that evolve.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::evolves(bytes));
