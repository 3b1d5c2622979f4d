//! Real exports, read in place. The folder is `$GRADUS_CORPUS`, else `shared/corpus`
//! beside the checkout; where it is missing these tests say so and pass, unless
//! the variable names it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use ladder::{ElementKind, Familiarity, Reading, Role};
use source::Severity;

/// The paths of all real L5X files.
fn paths() -> Vec<PathBuf> {
    let named = std::env::var_os("GRADUS_CORPUS").map(PathBuf::from);
    let promised = named.is_some();
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpus");
    let folder = named.unwrap_or(beside).join("l5x");
    let Ok(entries) = fs::read_dir(&folder) else {
        assert!(!promised, "there is no corpus in {}", folder.display());
        eprintln!("skipped: no corpus; set GRADUS_CORPUS");
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    paths
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Fixtures, and real files below 8 KB, as text to be changed.
pub fn small_texts() -> &'static [String] {
    static TEXTS: OnceLock<Vec<String>> = OnceLock::new();
    TEXTS.get_or_init(|| {
        let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/rockwell");
        let entries = fs::read_dir(fixtures).expect("the fixtures are part of the project");
        let mut files: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| path.extension().is_some_and(|end| end != "expected"))
            .collect();
        files.sort();
        let small = |path: &PathBuf| fs::metadata(path).is_ok_and(|file| file.len() < 8_000);
        files.extend(paths().into_iter().filter(small));
        let read = |path| fs::read_to_string(path).expect("a small file can be read");
        files.into_iter().map(read).collect()
    })
}

/// The file whose name contains `part`.
fn reading(part: &str) -> Option<Reading> {
    let path = paths().into_iter().find(|path| name(path).contains(part))?;
    Some(ladder::read(
        &fs::read(path).expect("a real file can be read"),
    ))
}

fn word(kind: &ElementKind) -> &'static str {
    match kind {
        ElementKind::Contact(_) => "contact",
        ElementKind::Coil(_) => "coil",
        ElementKind::Comparison(_) => "comparison",
        ElementKind::OneShot(_) => "one-shot",
        ElementKind::Open => "AFI",
        ElementKind::Timer(_) => "timer",
        ElementKind::Counter(_) => "counter",
        ElementKind::Assign(_) => "assignment",
        ElementKind::ResetBox(_) => "reset",
        ElementKind::Call(_) => "call",
        ElementKind::Block(block) => match block.familiarity {
            Familiarity::Known => "known box",
            Familiarity::Defined => "defined box",
            Familiarity::Unknown => "unknown box",
        },
        _ => "other",
    }
}

#[test]
fn every_real_file_is_read_without_an_error() {
    let files = paths();
    if files.is_empty() {
        return;
    }
    let mut counted: BTreeMap<&str, usize> = BTreeMap::new();
    let mut without_rungs = Vec::new();
    for path in &files {
        let name = name(path);
        let reading = ladder::read(&fs::read(path).expect("a real file can be read"));
        for it in &reading.diagnostics {
            assert_ne!(it.severity, Severity::Error, "{name}: {it:?}");
        }
        if reading.program.rungs().count() == 0 {
            without_rungs.push(name);
        }
        for (_, rung) in reading.program.rungs() {
            *counted.entry("rung").or_default() += 1;
            for (_, element) in rung.network.elements() {
                *counted.entry(word(&element.kind)).or_default() += 1;
            }
        }
    }
    // Two exports of a data type, and a chart.
    assert_eq!(
        without_rungs,
        [
            "tnunnink__L5Sharp__ComplexType.L5X",
            "tnunnink__L5Sharp__NestedType.L5X",
            "tnunnink__L5Sharp__SFC.L5X"
        ]
    );
    eprintln!("{} files: {counted:?}", files.len());
    assert_eq!(files.len(), 44);
    // All 4,645 rungs of the files but 5 of data types' context and 3 that are
    // pending edits.
    assert_eq!(counted["rung"], 4_637);
    for kind in [
        "contact",
        "coil",
        "comparison",
        "one-shot",
        "AFI",
        "timer",
        "counter",
        "assignment",
        "reset",
        "call",
        "known box",
        "defined box",
    ] {
        assert!(counted[kind] > 0, "{kind}");
    }
    assert_eq!(counted.get("unknown box"), None);
}

#[test]
fn the_drawn_chart_beside_the_coded_one_is_read_whole() {
    let Some(reading) = reading("l5x_sfc__MainProgram") else {
        return;
    };
    let chart = &reading.program.charts[0];
    assert_eq!((chart.steps.len(), chart.transitions.len()), (20, 22));
    let named = |places: &[usize]| -> Vec<&str> {
        places
            .iter()
            .map(|&place| &*chart.steps[place].name)
            .collect()
    };
    // The divergence after step 2 and the convergence before step 4.
    for (transition, from, to) in [(2, 2, 3), (10, 2, 9), (3, 3, 4), (20, 9, 4), (21, 19, 0)] {
        let it = &chart.transitions[transition];
        assert_eq!(named(&it.from), [format!("Step_{from:03}")]);
        assert_eq!(named(&it.to), [format!("Step_{to:03}")]);
    }
    let single = |it: &ladder::ChartTransition| it.from.len() == 1 && it.to.len() == 1;
    assert!(chart.transitions.iter().all(single));
    let main: Vec<&str> = reading
        .program
        .routines
        .iter()
        .filter(|routine| routine.role == Role::Main)
        .map(|routine| &*routine.scope)
        .collect();
    assert_eq!(main, ["MainProgram/MainRoutine"]);
    let start = reading.program.declarations.find("a0").expect("a0");
    assert_eq!(start.address.as_deref(), Some("Local:1:I.Data.4"));
}

#[test]
fn presets_come_from_the_data_of_tags() {
    let Some(reading) = reading("belt_conveyor.L5X") else {
        return;
    };
    let presets: Vec<Option<u64>> = reading
        .program
        .rungs()
        .flat_map(|(_, rung)| rung.network.elements())
        .filter_map(|(_, element)| match &element.kind {
            ElementKind::Timer(timer) => Some(timer.preset_ms),
            _ => None,
        })
        .collect();
    assert_eq!(presets, [Some(2000), Some(3000), Some(5000), Some(2000)]);
}

#[test]
fn a_step_register_is_told_from_its_writes() {
    let Some(reading) = reading("Milling_AutoLogic") else {
        return;
    };
    let writes = reading
        .program
        .rungs()
        .flat_map(|(_, rung)| rung.network.elements())
        .filter_map(|(_, element)| match &element.kind {
            ElementKind::Assign(it) if &*it.target.name == "Milling_1.Index" => Some(&it.value),
            _ => None,
        });
    let steps: Vec<String> = writes.map(|value| format!("{value:?}")).collect();
    assert!(steps.contains(&"Increment(1)".to_owned()), "{steps:?}");
    assert!(steps.contains(&"Constant(0)".to_owned()), "{steps:?}");
    assert!(steps.iter().all(|it| !it.starts_with("Term")), "{steps:?}");
}
