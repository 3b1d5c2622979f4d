//! The notation of expressions.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::reads_expressions(bytes));
