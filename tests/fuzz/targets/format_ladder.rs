//! The layout of the rung notation.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::lays_out_ladders(bytes));
