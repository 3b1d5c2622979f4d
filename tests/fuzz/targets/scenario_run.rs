//! Scenarios that are run on a spec.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::runs_scenarios(bytes));
