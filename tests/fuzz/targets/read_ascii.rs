//! The reader of drawn ladders.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::reads(bytes, ladder::Format::Ascii));
