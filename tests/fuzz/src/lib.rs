//! What must hold whatever the bytes.
//!
//! Each function takes what the fuzzer made up and panics if a promise is
//! broken: that nothing panics, that every place lies in the text, that laying
//! out twice is laying out once, that what is written reads back as it was.
//! A target in `targets` is one call of one of them.

mod rules;
mod running;
mod scenarios;

#[path = "../../../server/ladder/tests/hostile/places.rs"]
mod places;

use ladder::{Format, Reading};
use logic::notation::{self, Lexer};
use logic::{Atoms, Budget, Expr, Function};

pub use rules::keeps_rules;
pub use running::{evolves, verifies};
pub use scenarios::{keeps_scenarios, runs_scenarios};

/// Reads `bytes` as `format`: as they are if they are recognised as such, else
/// behind the few words that make a reader take them for its own.
pub fn reads(bytes: &[u8], format: Format) {
    let reading = read(bytes);
    if reading.program.format != format {
        read(&[opening(format), bytes].concat());
    }
}

fn opening(format: Format) -> &'static [u8] {
    match format {
        Format::L5x => b"<RSLogix5000Content><Controller><Programs><Program Name=\"P\"><Routines><Routine Name=\"R\" Type=\"RLL\"><RLLContent><Rung Number=\"0\"><Text><![CDATA[",
        Format::L5k => b"IE_VER := 2.7;\nCONTROLLER C ()\nPROGRAM P ()\nROUTINE R\nN: ",
        Format::NeutralText => b"XIC(a)OTE(b);\n",
        Format::Plcopen => b"<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><types><pous><pou name=\"p\" pouType=\"program\"><body><LD>",
        Format::Ascii => b"|--[ a ]--( b )--|\n",
        Format::Ladder | Format::Unknown => b"rung: a -> b\nrung: ",
    }
}

fn read(bytes: &[u8]) -> Reading {
    let reading = ladder::read(bytes);
    if let Some(outside) = places::outside(bytes, &reading) {
        panic!("outside of the text: {outside}");
    }
    reading
}

/// Lays `bytes` out as a ladder text, twice, and compares what both say.
pub fn lays_out_ladders(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let laid_out = ladder::text::format(text);
    for span in &laid_out.left {
        assert!(text.get(span.range()).is_some(), "outside: {span:?}");
    }
    let again = ladder::text::format(&laid_out.text);
    assert_eq!(laid_out.text, again.text, "laid out twice");
    assert_eq!(laid_out.left.len(), again.left.len(), "left as it was");
}

/// Reads `bytes` as an expression; one that can be read must be printed so
/// that it reads back as it was, and must mean the same.
pub fn reads_expressions(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let mut lexer = Lexer::new(text);
    while let Some(token) = lexer.take() {
        assert!(text.get(token.span.range()).is_some(), "outside: {token:?}");
    }
    let expr = match notation::parse(text) {
        Ok(expr) => expr,
        Err(problem) => {
            assert!(text.get(problem.span.range()).is_some(), "outside: {problem:?}");
            return;
        }
    };
    let printed = expr.to_string();
    let read = notation::parse(&printed).unwrap_or_else(|problem| panic!("{printed}: {problem:?}"));
    assert_eq!(read.to_string(), printed, "printed and read");
    mean_the_same(&expr, &read);
}

fn mean_the_same(a: &Expr, b: &Expr) {
    let budget = small();
    let mut atoms = Atoms::new();
    let functions = (
        Function::of(a, &mut atoms, &budget),
        Function::of(b, &mut atoms, &budget),
    );
    if let (Ok(a), Ok(b)) = functions {
        assert_eq!(a, b);
    }
}

/// Goes all the way from the bytes of a ladder to a spec, its text, and what
/// that text says. Texts are compared, not specs: a name with a quote or a line
/// end in it, which no text can hold, is written with `'` in their place.
pub fn recovers(bytes: &[u8]) {
    let reading = ladder::read(bytes);
    let budget = small();
    let analysis = recovery::analyse(&reading.program, &budget);
    let spec = recovery::conversion::spec(&analysis, &[], &budget);
    let text = grafcet::write(&spec);
    let read = grafcet::read(&text);
    assert_eq!(grafcet::write(&read.spec), text, "{:?}", read.diagnostics);
}

/// The two texts before and after a line of `=`.
fn halves(bytes: &[u8]) -> Option<(&str, &str)> {
    std::str::from_utf8(bytes).ok()?.split_once("\n====\n")
}

/// Little enough that no input takes long.
fn small() -> Budget {
    Budget {
        nodes: 200,
        products: 20,
        ..Budget::default()
    }
}
