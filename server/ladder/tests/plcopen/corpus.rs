//! Real files: all are read, with no error but the true ones.

use std::collections::{BTreeMap, BTreeSet};

use ladder::{CoilKind, ContactKind, ElementKind, Role};
use source::Severity;

use crate::places::corpus;

#[test]
fn real_files_are_read_in_full() {
    let Some(files) = corpus() else { return };
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for file in &files {
        let text = std::fs::read(file).expect("a file");
        let program = ladder::read(&text).program;
        let mut count = |what, by| *counts.entry(what).or_default() += by;
        count("files", 1);
        count("routines", program.routines.len());
        count("charts", program.charts.len());
        let steps = program.charts.iter().map(|chart| chart.steps.len());
        count("steps", steps.sum());
        let transitions = program.charts.iter().map(|chart| chart.transitions.len());
        count("transitions", transitions.sum());
        for (routine, rung) in program.rungs() {
            count("rungs", 1);
            if routine.role == Role::Definition {
                count("rungs of definitions", 1);
            }
            for (_, element) in rung.network.elements() {
                count(kind(&element.kind), 1);
            }
        }
    }
    let found: Vec<_> = counts.into_iter().collect();
    assert_eq!(found, EXPECTED);
}

/// Counted apart from this reader too, by the tags of the files: 357 contacts
/// (90 closed, 7 edge; 16 variables besides are contacts here), 190 coils (26 set or
/// reset, 6 negated; 4 bistables besides are a pair each), 289 blocks.
const EXPECTED: [(&str, usize); 22] = [
    ("assignments", 70),
    ("blocks", 109),
    ("charts", 9),
    ("coils, negated", 6),
    ("coils, plain", 168),
    ("coils, set or reset", 34),
    ("comparisons", 11),
    ("contacts, closed", 90),
    ("contacts, edge", 7),
    ("contacts, open", 276),
    ("counters", 5),
    ("edges of power", 14),
    ("files", 33),
    ("gates", 6),
    ("inverters", 5),
    ("rails", 286),
    ("routines", 81),
    ("rungs", 286),
    ("rungs of definitions", 98),
    ("steps", 59),
    ("timers", 71),
    ("transitions", 82),
];

fn kind(kind: &ElementKind) -> &'static str {
    match kind {
        ElementKind::Contact(contact) => match contact.kind {
            ContactKind::Open => "contacts, open",
            ContactKind::Closed => "contacts, closed",
            ContactKind::Rising | ContactKind::Falling => "contacts, edge",
        },
        ElementKind::Coil(coil) => match coil.kind {
            CoilKind::Plain => "coils, plain",
            CoilKind::Negated => "coils, negated",
            CoilKind::Set | CoilKind::Reset => "coils, set or reset",
            CoilKind::Rising | CoilKind::Falling => "coils, edge",
        },
        ElementKind::Rail => "rails",
        ElementKind::Comparison(_) => "comparisons",
        ElementKind::Timer(_) => "timers",
        ElementKind::Counter(_) => "counters",
        ElementKind::OneShot(_) => "edges of power",
        ElementKind::Gate(_) => "gates",
        ElementKind::Invert => "inverters",
        ElementKind::Assign(_) => "assignments",
        ElementKind::Block(_) => "blocks",
        _ => "others",
    }
}

#[test]
fn real_files_have_no_errors_but_their_own() {
    let Some(files) = corpus() else { return };
    let mut found = Vec::new();
    for file in &files {
        let text = std::fs::read(file).expect("a file");
        let lines = source::LineIndex::new(&text);
        for diagnostic in ladder::read(&text).diagnostics {
            if diagnostic.severity == Severity::Error {
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                let line = lines.locate(&text, diagnostic.span.start as usize).line;
                found.push(format!("{name}:{line} {}", diagnostic.code));
            }
        }
    }
    // A block reads two constants that somebody deleted.
    assert_eq!(
        found,
        [
            "Fortiphyd__GRFICSv2__attack.xml:2043 G1301",
            "Fortiphyd__GRFICSv2__attack.xml:2054 G1301",
            "Fortiphyd__GRFICSv2__simplified_te.xml:2414 G1301",
            "Fortiphyd__GRFICSv2__simplified_te.xml:2425 G1301",
        ]
    );
}

#[test]
fn no_contact_or_coil_of_a_real_file_is_lost() {
    let Some(files) = corpus() else { return };
    for file in &files {
        let text = std::fs::read_to_string(file).expect("a file in UTF-8");
        let program = ladder::read(text.as_bytes()).program;
        let elements = program.rungs().flat_map(|(_, rung)| {
            let elements = rung.network.elements();
            elements.map(|(_, element)| rung.place(element.within).start as usize)
        });
        let starts: BTreeSet<_> = elements.collect();
        for tag in ["<contact ", "<coil "] {
            for (at, _) in text.match_indices(tag) {
                assert!(starts.contains(&at), "{tag} at {at} of {}", file.display());
            }
        }
    }
}
