//! What the tests of the rung notation share: fixtures, diagnostics drawn
//! under the source, and a program without its places.

#![allow(dead_code, reason = "each test uses a part")]

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

use ladder::{ContactKind, Element, ElementKind, Gate, Network, Operand, Program, Rung, Within};
use source::{LineIndex, Span};

/// The text of a file under `fixtures`.
pub fn fixture(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures")
        .join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The program that `text` holds; it must be read as a `.ladder` text.
pub fn program(text: &str) -> Arc<Program> {
    let program = ladder::read(text.as_bytes()).program;
    assert_eq!(program.format, ladder::Format::Ladder, "{text}");
    program
}

/// `text` with each diagnostic in a comment under the line where it begins:
/// `//` and carets under the bytes that it is about.
pub fn drawn(text: &str) -> String {
    let index = LineIndex::new(text.as_bytes());
    let mut marks: Vec<(usize, String)> = Vec::new();
    for finding in ladder::read(text.as_bytes()).diagnostics {
        let start = index.locate(text.as_bytes(), finding.span.range().start);
        let end = index.locate(text.as_bytes(), finding.span.range().end);
        let carets = match end.line == start.line {
            true => (end.column - start.column).max(1),
            false => 1,
        };
        assert!(
            start.column > 2,
            "no room for a mark: indent the line of {finding:?}"
        );
        let mark = format!(
            "//{}{} {} {}",
            " ".repeat(start.column - 3),
            "^".repeat(carets),
            finding.code,
            finding.message
        );
        marks.push((start.line, mark));
    }
    let mut drawn = String::new();
    for (at, line) in text.lines().enumerate() {
        drawn.push_str(line);
        drawn.push('\n');
        for (_, mark) in marks.iter().filter(|(line, _)| *line == at + 1) {
            drawn.push_str(mark);
            drawn.push('\n');
        }
    }
    drawn
}

/// `text` without the lines that [`drawn`] adds.
pub fn without_marks(text: &str) -> String {
    let is_mark = |line: &str| {
        line.strip_prefix("//")
            .is_some_and(|rest| rest.trim_start().starts_with('^'))
    };
    text.lines()
        .filter(|line| !is_mark(line))
        .map(|line| format!("{line}\n"))
        .collect()
}

/// Everything that a program says, place by place left out, as text: equal
/// texts, equal programs.
pub fn said(program: &Program) -> String {
    let mut all = format!("program {:?}\n", program.name);
    for declaration in program.declarations.iter() {
        let mut declaration = declaration.clone();
        declaration.span = Span::default();
        all.push_str(&format!("{declaration:?}\n"));
    }
    for routine in &program.routines {
        all.push_str(&format!(
            "{} {} {} {:?}\n",
            routine.scope, routine.unit, routine.name, routine.role
        ));
        for rung in &routine.rungs {
            all.push_str(&format!("  {} {:?}\n", rung.number, rung.comment));
            all.push_str(&network_said(&rung.network));
        }
    }
    all
}

/// The elements and wires of a network, places left out.
pub fn network_said(network: &Network) -> String {
    let mut all = String::new();
    for (at, element) in network.elements() {
        let mut kind = element.kind.clone();
        without_places(&mut kind);
        all.push_str(&format!("    {} {kind:?}", at.index()));
        for (from, wire) in network.arriving(at) {
            all.push_str(&format!(" <- {} {wire:?}", from.index()));
        }
        all.push('\n');
    }
    all
}

fn without_places(kind: &mut ElementKind) {
    let clear = |operand: &mut Operand| operand.within = Within::default();
    kind.variables_mut().into_iter().for_each(clear);
    kind.destination_mut().into_iter().for_each(clear);
}

/// Every place that a rung mentions.
pub fn places(rung: &Rung) -> Vec<Span> {
    let mut all = Vec::new();
    for (_, element) in rung.network.elements() {
        all.push(element.within);
        let kind = &element.kind;
        all.extend(kind.reads().iter().map(|operand| operand.within));
        all.extend(kind.writes().iter().map(|operand| operand.within));
    }
    all.into_iter().map(|within| rung.place(within)).collect()
}

/// The one coil of a network of contacts, if power reaches it.
pub fn drives_coil(network: &Network, is_on: &dyn Fn(&str) -> bool) -> Option<String> {
    let power = power(network, is_on);
    network
        .elements()
        .find_map(|(at, element)| match &element.kind {
            ElementKind::Coil(coil) if power[at.index()] => Some(coil.operand.name.to_string()),
            _ => None,
        })
}

/// Whether power leaves each element of a network without edges.
pub fn power(network: &Network, is_on: &dyn Fn(&str) -> bool) -> Vec<bool> {
    let mut power: Vec<bool> = Vec::new();
    for (at, element) in network.elements() {
        let fed = network
            .arriving(at)
            .iter()
            .any(|(from, _)| power[from.index()]);
        power.push(match &element.kind {
            ElementKind::Rail => true,
            ElementKind::Contact(contact) => {
                let on = is_on(&contact.operand.name);
                fed && match contact.kind {
                    ContactKind::Open => on,
                    ContactKind::Closed => !on,
                    other => panic!("an edge: {other:?}"),
                }
            }
            ElementKind::Open => false,
            ElementKind::Coil(_) | ElementKind::Gate(Gate::Or) => fed,
            other => panic!("not of contacts alone: {other:?}"),
        });
    }
    power
}

/// All files under `fixtures`.
pub fn fixtures() -> Vec<PathBuf> {
    let mut folders = vec![PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable folder").path();
            // What a file must give is no program, though it may look like one.
            let is_answer = path.extension().is_some_and(|it| it == "expected");
            match path.is_dir() {
                true => folders.push(path),
                false if is_answer => {}
                false => files.push(path),
            }
        }
    }
    files.sort();
    files
}

/// What each coil, move, timer and counter of a network writes and whether it
/// gets power, in alphabetical order, with every atom on or off by chance.
pub fn powered(network: &Network, seed: u32) -> Vec<(String, bool)> {
    let power = ladder::scan::power(network, |atom| {
        let mut hasher = DefaultHasher::new();
        (seed, atom.to_string()).hash(&mut hasher);
        // More often on than off, so that long series get power too.
        !hasher.finish().is_multiple_of(4)
    });
    let outputs = network.elements().filter(|(_, element)| {
        matches!(
            element.kind,
            ElementKind::Coil(_)
                | ElementKind::Assign(_)
                | ElementKind::Timer(_)
                | ElementKind::Counter(_)
        )
    });
    let written = |element: &Element| match element.kind.writes().first() {
        Some(operand) => operand.name.to_string(),
        None => String::new(),
    };
    let mut all: Vec<_> = outputs
        .map(|(at, element)| (written(element), power.at(at)))
        .collect();
    all.sort();
    all
}
