//! The text of scenarios.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::keeps_scenarios(bytes));
