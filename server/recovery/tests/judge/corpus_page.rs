//! What is recovered from real programs, as the page `docs/corpus.md`.

use std::collections::HashSet;
use std::fmt::Write;

use ladder::{ElementKind, Rung};
use logic::{Atoms, Budget};
use recovery::conditions::{Walk, powers};
use recovery::groups::Group;
use recovery::{Analysis, analyse};
use source::Severity;

use crate::real_files::{RealFile, plcopen, rockwell};

/// Files that cannot be read without an error, and what is wrong with them.
const BROKEN: [(&str, &str); 2] = [
    (
        "Fortiphyd__GRFICSv2__attack.xml",
        "wires to the elements `13` and `14`, which are not in the file",
    ),
    (
        "Fortiphyd__GRFICSv2__simplified_te.xml",
        "wires to the elements `13` and `14`, which are not in the file",
    ),
];

/// How exactly the guards of a rung are known.
#[derive(Clone, Copy, PartialEq)]
enum Guards {
    /// Over contacts, comparisons, timers and boxes that are known.
    Exact,
    /// Some depend on what an unknown box does.
    Opaque,
    /// Some are past the budget.
    TooLarge,
}

#[derive(Clone, Copy, Default)]
struct Counts {
    files: usize,
    rungs: usize,
    exact: usize,
    opaque: usize,
    coils: usize,
    states: usize,
    registers: usize,
    sequences: usize,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.files += other.files;
        self.rungs += other.rungs;
        self.exact += other.exact;
        self.opaque += other.opaque;
        self.coils += other.coils;
        self.states += other.states;
        self.registers += other.registers;
        self.sequences += other.sequences;
    }
}

/// The guards of all elements of a rung that write or steer.
fn guards(rung: &Rung) -> Guards {
    let budget = Budget::default();
    let mut opaque = HashSet::new();
    let powers = powers(
        &rung.network,
        &mut Walk {
            atoms: &mut Atoms::new(),
            opaque: &mut opaque,
            budget: &budget,
        },
    );
    let mut found = Guards::Exact;
    for (at, element) in rung.network.elements() {
        if !acts(&element.kind) {
            continue;
        }
        match powers.at(at) {
            Err(_) => return Guards::TooLarge,
            Ok(guard) if guard.support().iter().any(|atom| opaque.contains(atom)) => {
                found = Guards::Opaque;
            }
            Ok(_) => {}
        }
    }
    found
}

/// Whether an element does something with the power that it gets.
fn acts(kind: &ElementKind) -> bool {
    let steers = matches!(
        kind,
        ElementKind::Call(_)
            | ElementKind::Jump(_)
            | ElementKind::Return { .. }
            | ElementKind::Zone
    );
    steers || !kind.writes().is_empty()
}

fn sequences(analysis: &Analysis) -> impl Iterator<Item = &Group> {
    analysis.groups().iter().filter(|group| group.sequence)
}

fn counts(file: &RealFile, analysis: &Analysis) -> Counts {
    let program = &file.reading.program;
    let of_rungs: Vec<Guards> = program.rungs().map(|(_, rung)| guards(rung)).collect();
    let number = |wanted: Guards| of_rungs.iter().filter(|it| **it == wanted).count();
    let elements = program
        .rungs()
        .flat_map(|(_, rung)| rung.network.elements());
    Counts {
        files: 1,
        rungs: of_rungs.len(),
        exact: number(Guards::Exact),
        opaque: number(Guards::Opaque),
        coils: elements
            .filter(|(_, element)| matches!(element.kind, ElementKind::Coil(_)))
            .count(),
        states: analysis.states().states.len(),
        registers: analysis.registers.len(),
        sequences: sequences(analysis).count(),
    }
}

fn share(part: usize, whole: usize) -> String {
    match whole {
        0 => "–".to_owned(),
        _ => format!("{:.1} %", 100.0 * part as f64 / whole as f64),
    }
}

fn row(name: &str, counts: &Counts, sequences: &str) -> String {
    let Counts {
        rungs,
        coils,
        states,
        registers,
        ..
    } = counts;
    let exact = share(counts.exact, *rungs);
    let opaque = share(counts.opaque, *rungs);
    format!(
        "| {name} | {rungs} | {coils} | {exact} | {opaque} | {states} | {registers} | {sequences} |\n"
    )
}

/// Names of states, the first few of many.
fn listed(names: &[logic::Name]) -> String {
    const SHOWN: usize = 6;
    let shown: Vec<String> = names
        .iter()
        .take(SHOWN)
        .map(|name| format!("`{name}`"))
        .collect();
    match names.len().saturating_sub(SHOWN) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// A part of the page: its table, and its sequences one by one.
#[derive(Default)]
struct Part {
    table: String,
    sequences: String,
    total: Counts,
}

fn part(files: &[RealFile]) -> Part {
    let mut part = Part::default();
    for file in files {
        let analysis = analyse(&file.reading.program, &Budget::default());
        let counts = counts(file, &analysis);
        let sizes: Vec<String> = sequences(&analysis)
            .map(|group| group.states.len().to_string())
            .collect();
        let name = format!("`{}`", file.name);
        part.table += &row(&name, &counts, &sizes.join(", "));
        for group in sequences(&analysis) {
            let (states, reason) = (listed(&group.states), &group.reason);
            // Writing into a string cannot fail.
            let _ = writeln!(part.sequences, "- {name}: {reason}. States: {states}.");
        }
        part.total += counts;
    }
    part
}

const HEAD: &str = "| file | rungs | coils | exact | opaque | states | registers | sequences |\n\
                    |---|---|---|---|---|---|---|---|\n";

fn page(parts: &[(&str, Part)]) -> String {
    let mut total = Counts::default();
    let mut page = String::from(
        "# Real programs\n\n\
         What Gradus recovers from programs that other people wrote for real machines. They are no part of this repository (see\n\
         [testing](testing.md)); this page is made from them by `UPDATE=1 cargo test -p gradus-recovery --test judge corpus`.\n\n\
         | column | counts |\n|---|---|\n\
         | rungs | rungs, those of called routines and of blocks that the file defines among them |\n\
         | coils | coils on them |\n\
         | exact | rungs whose every guard is an exact Boolean function of contacts, comparisons, timers \
         and known boxes |\n\
         | opaque | rungs with a guard that depends on what an unknown box does |\n\
         | states | states held in one bit: sealed-in coils, and variables both set and reset |\n\
         | registers | whole numbers that count steps; see [registers](registers.md) |\n\
         | sequences | groups of rungs that hold a sequence, each by the number of states in the group |\n",
    );
    for (title, part) in parts {
        total += part.total;
        let Counts { files, .. } = part.total;
        let sum = row(
            &format!("**{files} files**"),
            &part.total,
            &part.total.sequences.to_string(),
        );
        let _ = write!(page, "\n## {title}\n\n{HEAD}{}{sum}", part.table);
        if !part.sequences.is_empty() {
            let _ = write!(page, "\n{}", part.sequences);
        }
    }
    let sum = row(
        &format!("{} files", total.files),
        &total,
        &total.sequences.to_string(),
    );
    let _ = write!(page, "\n## All\n\n{HEAD}{sum}");
    let _ = write!(page, "\nRead with errors, because they are broken:\n\n");
    for (file, reason) in BROKEN {
        let _ = writeln!(page, "- `{file}`: {reason}.");
    }
    page
}

#[test]
fn the_page_about_the_corpus_is_what_is_recovered_from_it() {
    if rockwell().is_empty() {
        return;
    }
    let parts = [
        ("Rockwell L5X", part(rockwell())),
        ("PLCopen XML", part(plcopen())),
    ];
    let page = page(&parts);
    let path = end_to_end::path("docs/corpus.md");
    if end_to_end::update_is_asked_for() {
        std::fs::write(&path, &page).expect("a document");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == page,
        "docs/corpus.md is out of date; `UPDATE=1 cargo test -p gradus-recovery --test judge \
         corpus` rewrites it"
    );
    let mut total = Counts::default();
    for (_, part) in &parts {
        total += part.total;
    }
    assert!(
        total.exact * 100 >= total.rungs * 97,
        "{} of {} rungs are exact",
        total.exact,
        total.rungs
    );
}

#[test]
fn every_file_of_the_corpus_is_read_without_errors_but_broken_ones() {
    let files = || rockwell().iter().chain(plcopen());
    let has_errors = |file: &&RealFile| {
        let mut found = file.reading.diagnostics.iter();
        found.any(|it| it.severity == Severity::Error)
    };
    let broken: Vec<&str> = files().filter(has_errors).map(|file| &*file.name).collect();
    if files().next().is_some() {
        assert_eq!(broken, BROKEN.map(|(name, _)| name));
    }
}
