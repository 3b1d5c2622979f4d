//! The reader of PLCopen XML.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::reads(bytes, ladder::Format::Plcopen));
