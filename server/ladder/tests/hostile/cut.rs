//! Files that end too early, at any byte.

use std::fs;
use std::path::{Path, PathBuf};

use ladder::Format;

use crate::{on_a_small_stack, read};

/// Places at which each file is cut, beside those near its end.
const CUTS: usize = 12;

fn fixtures() -> Vec<PathBuf> {
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    ["rockwell", "plcopen", "neutralization", "ladder"]
        .iter()
        .flat_map(|folder| files(&fixtures.join(folder)))
        .collect()
}

/// The real files, where there are some: see `docs/testing.md`.
fn real_files() -> Vec<PathBuf> {
    let named = std::env::var_os("GRADUS_CORPUS").map(PathBuf::from);
    let promised = named.is_some();
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpus");
    let corpus = named.unwrap_or(beside);
    if !corpus.is_dir() {
        assert!(!promised, "there is no corpus in {}", corpus.display());
        eprintln!("skipped: no corpus; set GRADUS_CORPUS");
        return Vec::new();
    }
    ["l5x", "plcopen", "ascii"]
        .iter()
        .flat_map(|folder| files(&corpus.join(folder)))
        .collect()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries =
        fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry of the folder").path())
        .filter(|path| path.is_file() && path.extension().is_none_or(|end| end != "expected"))
        .collect();
    files.sort();
    files
}

/// Reads `bytes` up to `at`. Of XML, which says where it ends, what is left out
/// is missed.
fn check(bytes: &[u8], at: usize, name: &str) {
    let cut = &bytes[..at];
    let reading = on_a_small_stack(|| read(cut));
    let is_xml = matches!(reading.program.format, Format::L5x | Format::Plcopen);
    if is_xml && cut.trim_ascii_end().len() < bytes.trim_ascii_end().len() {
        assert!(!reading.diagnostics.is_empty(), "{name} cut at {at}");
    }
}

#[test]
fn a_fixture_cut_anywhere_is_read_to_the_cut() {
    for path in fixtures() {
        let bytes = fs::read(&path).expect("a fixture");
        let step = (bytes.len() / CUTS).max(1);
        let name = path.display().to_string();
        for at in (0..bytes.len()).step_by(step) {
            check(&bytes, at, &name);
        }
        for at in bytes.len().saturating_sub(12)..bytes.len() {
            check(&bytes, at, &name);
        }
    }
}

#[test]
fn a_real_file_cut_anywhere_is_read_to_the_cut() {
    for path in real_files() {
        let bytes = fs::read(&path).expect("a real file");
        let name = path.display().to_string();
        // Large ones cost seconds for every cut and are of the same make.
        let cuts = if bytes.len() < 60_000 { 4 } else { 1 };
        for part in 1..=cuts {
            check(&bytes, bytes.len() * part / (cuts + 1), &name);
        }
    }
}

/// The rungs before a cut are those of the whole.
#[test]
fn no_rung_before_a_cut_is_lost() {
    let rung = |at: usize| format!("<Rung Number=\"{at}\"><Text>XIC(a{at})OTE(b);</Text></Rung>");
    let rungs: String = (0..20).map(rung).collect();
    let text = crate::forms::l5x(&format!(
        "<Programs><Program Name=\"P\"><Routines><Routine Name=\"R\" Type=\"RLL\"><RLLContent>{rungs}\
         </RLLContent></Routine></Routines></Program></Programs>"
    ));
    for at in 0..text.len() {
        let whole = text[..at].matches("</Rung>").count();
        let read = read(&text.as_bytes()[..at]).program.rungs().count();
        assert!(
            (whole..=whole + 1).contains(&read),
            "cut at {at}: {read} of {whole}"
        );
    }
}
