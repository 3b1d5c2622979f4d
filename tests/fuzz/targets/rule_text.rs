//! The rule text: read, lay out, write, rewrite.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::keeps_rules(bytes));
