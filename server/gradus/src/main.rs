//! The `gradus` executable: command line and language server.
fn main() {}
