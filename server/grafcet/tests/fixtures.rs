//! The texts under `fixtures/grafcet`, each with what must come out beside it:
//! `NAME.canonical.grafcet` as written from what was read, and
//! `NAME.formatted.grafcet` as laid out.

use std::fs;
use std::path::{Path, PathBuf};

use grafcet::{format, read, rewrite, write};

fn fixtures() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/grafcet");
    let files = fs::read_dir(folder).expect("the folder of fixtures");
    let mut texts: Vec<PathBuf> = files
        .map(|file| file.expect("a file").path())
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.ends_with(".grafcet") && name.matches('.').count() == 1
        })
        .collect();
    texts.sort();
    assert!(texts.len() >= 2, "fixtures are missing");
    texts
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn every_fixture_reads_without_findings_and_writes_as_expected() {
    for path in fixtures() {
        let source = text(&path);
        let reading = read(&source);
        assert_eq!(reading.diagnostics, [], "{}", path.display());
        let written = write(&reading.spec);
        assert_eq!(written, text(&path.with_extension("canonical.grafcet")));
        assert_eq!(write(&read(&written).spec), written);
    }
}

#[test]
fn every_fixture_stays_as_it_is_when_it_says_what_is_wanted() {
    for path in fixtures() {
        let source = text(&path);
        assert_eq!(rewrite(&source, &read(&source).spec), source);
        let marked = format!("\u{feff}{}", source.replace('\n', "\r\n"));
        assert_eq!(rewrite(&marked, &read(&source).spec), marked);
    }
}

#[test]
fn every_fixture_is_laid_out_as_expected() {
    for path in fixtures() {
        let formatted = format(&text(&path));
        assert_eq!(
            formatted.text,
            text(&path.with_extension("formatted.grafcet"))
        );
        assert_eq!(formatted.diagnostics, []);
    }
}

#[test]
fn figure_3_says_what_its_paper_says() {
    let source = fixtures()
        .into_iter()
        .find(|path| path.ends_with("figure3.grafcet"))
        .map(|path| text(&path));
    let spec = read(&source.expect("figure 3")).spec;
    let chart = &spec.grafcet.chart;
    let initial: Vec<&str> = spec
        .grafcet
        .initial_steps()
        .map(|step| &*step.name)
        .collect();
    assert_eq!(initial, ["p1"]);
    let t1 = chart.transition("t1").expect("t1");
    assert_eq!((&*t1.from[0], &*t1.to[0]), ("p1", "p2"));
    assert_eq!(t1.receptivity, logic::Expr::variable("m"));
    let of_p2: Vec<&str> = chart
        .actions_of("p2")
        .map(|action| &*action.output)
        .collect();
    assert_eq!(of_p2, ["R", "L"]);
}
