//! Translations against the interpreters, scan by scan.

#[path = "../../../ladder/tests/against_c/program.rs"]
#[allow(dead_code)]
mod program;
#[path = "../../../ladder/tests/against_c/random.rs"]
mod random;
#[path = "../../../ladder/tests/against_c/text.rs"]
mod text;

mod beside;
mod corpus;
mod ladders;
