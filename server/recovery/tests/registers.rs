//! The step registers of the corpus, as `docs/registers.md` lists them.
//!
//! The judgement in that page was made by reading the rungs. This test keeps
//! its table true, and checks what can be said in numbers.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::LazyLock;

use logic::Budget;
use recovery::registers::Register;

const MARK: &str = "<!-- generated: UPDATE=1 cargo test -p gradus-recovery --test registers -->\n";

/// Registers by file.
type Files = Vec<(String, Vec<Register>)>;

/// The registers of every `*_AutoLogic_Program.L5X`, recovered once.
static REGISTERS: LazyLock<Option<Files>> = LazyLock::new(registers);

fn registers() -> Option<Files> {
    let folder = end_to_end::corpus()?.join("l5x");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the folder of L5X files")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.to_string_lossy().ends_with("_AutoLogic_Program.L5X"))
        .collect();
    paths.sort();
    let found = paths.into_iter().map(|path| {
        let bytes = std::fs::read(&path).expect("a readable file");
        let reading = ladder::read(&bytes);
        let analysis = recovery::analyse(&reading.program, &Budget::default());
        let name = path.file_name().expect("a name").to_string_lossy();
        let name = name.rsplit("__").next().expect("the last part").to_owned();
        (name, analysis.registers)
    });
    Some(found.collect())
}

/// `2, 3, 4, 7` as `2 to 4, 7`.
fn ranges(values: impl IntoIterator<Item = i64>) -> String {
    let mut ranges: Vec<(i64, i64)> = Vec::new();
    for value in values {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == value => *last = value,
            _ => ranges.push((value, value)),
        }
    }
    let text = ranges.into_iter().map(|(first, last)| match last - first {
        0 => first.to_string(),
        1 => format!("{first}, {last}"),
        _ => format!("{first} to {last}"),
    });
    text.collect::<Vec<_>>().join(", ")
}

fn from_values(register: &Register, keep: impl Fn(i64, i64) -> bool) -> BTreeSet<i64> {
    let arcs = register.arcs.iter();
    arcs.filter(|arc| keep(arc.from, arc.to))
        .map(|arc| arc.from)
        .collect()
}

fn table(files: &[(String, Vec<Register>)]) -> String {
    let mut text = String::from(
        "| file | register | values | arcs | forward from | to 0 from | to 1 from | other arcs | left out |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (file, registers) in files {
        if registers.is_empty() {
            writeln!(text, "| {file} | none | | | | | | | |").expect("writes to a string");
        }
        for register in registers {
            let forward = from_values(register, |from, to| to == from + 1);
            let to_zero = from_values(register, |_, to| to == 0);
            let to_one = from_values(register, |from, to| to == 1 && from != 0);
            let targets: BTreeSet<i64> = register.arcs.iter().map(|arc| arc.to).collect();
            let others: Vec<String> = targets
                .into_iter()
                .filter(|target| *target > 1)
                .map(|target| {
                    (
                        target,
                        from_values(register, |f, t| t == target && t != f + 1),
                    )
                })
                .filter(|(_, from)| !from.is_empty())
                .map(|(target, from)| format!("{} -> {target}", ranges(from)))
                .collect();
            let left_out: Vec<String> = register
                .left_out
                .iter()
                .map(|(from, to)| format!("{from} -> {to}"))
                .collect();
            writeln!(
                text,
                "| {file} | `{}` | {} | {} | {} | {} | {} | {} | {} |",
                register.name,
                ranges(register.states.iter().map(|state| state.value)),
                register.arcs.len(),
                ranges(forward),
                ranges(to_zero),
                ranges(to_one),
                others.join("; "),
                left_out.join(", "),
            )
            .expect("writes to a string");
        }
    }
    text
}

#[test]
fn the_page_lists_the_registers_of_the_corpus() {
    let Some(files) = &*REGISTERS else { return };
    let path = end_to_end::path("docs/registers.md");
    let page = std::fs::read_to_string(&path).expect("the page");
    let (judged, _) = page.split_once(MARK).expect("the mark in the page");
    let expected = format!("{judged}{MARK}\n{}", table(files));
    if end_to_end::update_is_asked_for() {
        std::fs::write(&path, expected).expect("a writable page");
    } else {
        assert_eq!(page, expected, "run again with UPDATE=1");
    }
}

#[test]
fn the_index_of_the_mill_has_28_states_and_the_arcs_that_its_rungs_write() {
    let Some(files) = &*REGISTERS else { return };
    let index = files
        .iter()
        .flat_map(|(_, registers)| registers)
        .find(|register| &*register.name == "Milling_1.Index")
        .expect("the register");
    let arcs: BTreeSet<(i64, i64)> = index.arcs.iter().map(|arc| (arc.from, arc.to)).collect();

    let forward = (0..27).map(|value| (value, value + 1));
    let to_zero = (1..=27).map(|value| (value, 0));
    let to_one = (2..=13).chain([26]).map(|value| (value, 1));
    let run_out = (0..=27)
        .filter(|value| *value != 17)
        .map(|value| (value, 17));
    let expected: BTreeSet<(i64, i64)> = forward
        .chain(to_zero)
        .chain(to_one)
        .chain(run_out)
        .chain([(26, 2)])
        .collect();
    assert_eq!(arcs, expected);
    assert!(index.arcs.iter().all(|arc| !arc.condition.is_false()));

    let values: Vec<i64> = index.states.iter().map(|state| state.value).collect();
    assert_eq!(values, (0..=27).collect::<Vec<_>>());
    let title = index.states[5].title.as_deref();
    assert_eq!(
        title,
        Some("Start Milling Step 5: Start Dust Collector Fan 095")
    );
}
