//! Prints the table of ratios that `docs/benchmarks.md` explains.
//!
//! `cargo run --release -p gradus-bench` measures everything. A word after
//! `--` measures one part: `reading`, `successions`, `programs`, `memory`,
//! `diagrams`.

use std::io::Write as _;
use std::process::ExitCode;

mod table;

use table::{Row, diagrams, memory, programs, reading, successions};

/// What the program prints when it runs as its own child to be measured.
const CHILD: &str = "peak-of";

type Part = (&'static str, fn() -> Vec<Row>);

const PARTS: [Part; 5] = [
    ("reading", reading::rows),
    ("successions", successions::rows),
    ("programs", programs::rows),
    ("memory", memory::rows),
    ("diagrams", diagrams::rows),
];

fn main() -> std::io::Result<ExitCode> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut out = std::io::stdout();
    if let [child, rungs] = &words[..]
        && child == CHILD
    {
        let peak = memory::of_this_process(rungs.parse().unwrap_or_default());
        writeln!(out, "{}", peak.unwrap_or_default())?;
        return Ok(ExitCode::SUCCESS);
    }
    let is_part = |word: &String| PARTS.iter().any(|(name, _)| name == word);
    if let Some(word) = words.iter().find(|word| !is_part(word)) {
        let names = PARTS.map(|(name, _)| name).join(", ");
        eprintln!("there is no part `{word}` to measure; the parts are {names}");
        return Ok(ExitCode::from(2));
    }
    writeln!(out, "{}", table::HEAD)?;
    for (name, rows) in PARTS {
        if words.is_empty() || words.iter().any(|word| word == name) {
            for row in rows() {
                writeln!(out, "{row}")?;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
