//! Translations against the interpreters, scan by scan.

#[path = "../../../ladder/tests/against_c/program.rs"]
#[allow(dead_code)]
mod program;
#[path = "../../../ladder/tests/against_c/random.rs"]
mod random;
#[path = "../../../ladder/tests/against_c/text.rs"]
mod text;

#[path = "../../../grafcet/tests/evolution/charts.rs"]
#[allow(dead_code)]
mod plain;
#[path = "../../../grafcet/tests/random/mod.rs"]
#[allow(dead_code)]
mod specs;

mod beside;
mod boxes;
mod charts;
mod corpus;
mod ladders;
mod words;
