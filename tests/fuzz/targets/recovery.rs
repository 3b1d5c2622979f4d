//! From the bytes of a ladder to a spec.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::recovers(bytes));
