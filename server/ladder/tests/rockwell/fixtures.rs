//! Every file under `fixtures/rockwell` is read and compared with the text of
//! the same name that ends in `.expected`. `GRADUS_UPDATE=1` writes it anew.

use std::fs;
use std::path::{Path, PathBuf};

use crate::shown;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures")
        .join(name)
}

#[test]
fn every_fixture_reads_as_expected() {
    let mut files: Vec<PathBuf> = fs::read_dir(folder("rockwell"))
        .expect("the fixtures are part of the project")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|end| end != "expected"))
        .collect();
    files.sort();
    assert!(files.len() >= 4, "{files:?}");
    for file in files {
        let bytes = fs::read(&file).expect("a fixture can be read");
        let shown = shown::reading(&ladder::read(&bytes), &bytes);
        let expected = PathBuf::from(format!("{}.expected", file.display()));
        if std::env::var_os("GRADUS_UPDATE").is_some() {
            fs::write(&expected, &shown).expect("the expected text can be written");
        }
        let expected = fs::read_to_string(&expected).unwrap_or_default();
        assert_eq!(shown, expected, "{}", file.display());
    }
}

#[test]
fn the_case_study_reads_as_its_table_says() {
    let bytes = fs::read(folder("neutralization/neutralization.L5X")).expect("the case study");
    let reading = ladder::read(&bytes);
    assert_eq!(reading.diagnostics, []);
    let outputs: Vec<String> = reading
        .program
        .rungs()
        .flat_map(|(_, rung)| shown::rung(rung))
        .collect();
    assert_eq!(
        outputs,
        [
            "(s + v1)*/ls2 -> OTE v1",
            "(v2 + ls2*/as)*/ls3*/tl + (v2 + ls2*/as)*/ls3*/as -> OTE v2",
            "ls1*v3 + ls1*tl*as -> OTE v3",
            "(/v3*ls2*v4 + /v3*ls2*ls3)*/tl + (/v3*ls2*v4 + /v3*ls2*ls3)*/as -> OTE v4",
            "ls1*/tl*h + ls1*/tl*ls2 -> OTE h",
            "ls1*m + ls1*ls2 -> OTE m",
            "tl -> OTE light_tl",
            "as -> OTE light_as",
        ]
    );
    let start = reading.program.declarations.find("s").expect("s");
    assert_eq!(start.address.as_deref(), Some("Local:1:I.Data.0"));
    assert_eq!(start.class, ladder::Class::Input);
    let valve = reading.program.declarations.find("v1").expect("v1");
    assert_eq!(valve.class, ladder::Class::Output);
}
