//! The reader of bare neutral text.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::reads(bytes, ladder::Format::NeutralText));
