//! The verdicts that real programs get against what `convert --accept none` makes
//! of them, as the page `docs/verdicts.md`.

use std::fmt::Write;
use std::path::Path;

use ladder::Format;
use logic::Name;
use proof::Limits;
use verification::{Difference, Reason, Refusal, Verdict, Verification, What};

use crate::product::product;

/// The folders of real files, and what they hold.
const KINDS: [(&str, &str); 4] = [
    ("l5x", "Rockwell L5X"),
    ("plcopen", "PLCopen XML"),
    ("openplc-ld", "OpenPLC ladder"),
    ("ascii", "ASCII drawings"),
];

/// How many files got which verdict.
#[derive(Clone, Copy, Default)]
struct Counts {
    equivalent: usize,
    different: usize,
    unknown: usize,
    refused: usize,
    nothing: usize,
}

const HEAD: &str = "\
# What verdicts real programs get

Every real program (see [testing](testing.md)) against the spec that `gradus convert --accept none` makes of it, in `scan` timing, with
the effort of a second or two: `gradus verify --effort 100`. This page is made of them by
`UPDATE=1 cargo test -p gradus-verification --test verdicts corpus`; [verification](verify.md) tells what the verdicts mean. The spec holds
every coil's conditions and no sequence yet, so it should do what the ladder does; where it does not, a run of both has shown it.

| verdict | because |
|---|---|
| equivalent | proved for every sequence of inputs |
| different | after so many scans, in these outputs |
| unknown: numbers | these outputs hold numbers that are not followed |
| unknown: what is free | the proof needs what is left free, when timers run out and numbers that are not followed, and no run of both shows a difference |
| refused | what cannot be translated as it is meant |

Programs without anything to compare, as those that hold types alone, are counted and not listed.
";

#[test]
fn the_page_about_verdicts_is_what_real_programs_get() {
    let Some(folder) = end_to_end::corpus() else {
        return;
    };
    let mut page = HEAD.to_owned();
    let mut total = Counts::default();
    for (kind, title) in KINDS {
        let _ = write!(
            page,
            "\n## {title}\n\n| file | verdict | |\n|---|---|---|\n"
        );
        for path in files(&folder.join(kind)) {
            let bytes = std::fs::read(&path).expect("a real file can be read");
            let program = ladder::read(&bytes).program;
            if program.format == Format::Unknown {
                continue;
            }
            let limits = Limits {
                steps: 100_000_000,
                ..Limits::default()
            };
            let found = product(&program, &limits);
            if let Some((verdict, because)) = told(&found, &mut total) {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let _ = writeln!(page, "| `{name}` | {verdict} | {because} |");
            }
        }
    }
    let Counts {
        equivalent,
        different,
        unknown,
        refused,
        nothing,
    } = total;
    let _ = write!(
        page,
        "\n## All\n\n| equivalent | different | unknown | refused | nothing to compare |\n|---|---|---|---|---|\n\
         | {equivalent} | {different} | {unknown} | {refused} | {nothing} |\n"
    );
    let path = end_to_end::path("docs/verdicts.md");
    if end_to_end::update_is_asked_for() {
        std::fs::write(&path, &page).expect("a document");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == page,
        "docs/verdicts.md is out of date; `UPDATE=1 cargo test -p gradus-verification --test verdicts corpus` \
         rewrites it"
    );
    assert!(
        equivalent > different + unknown + refused,
        "{equivalent} proved"
    );
}

/// The files of a folder, by name.
fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<_> = entries.filter_map(|it| Some(it.ok()?.path())).collect();
    paths.sort();
    paths
}

/// A verdict and its reason, counted; `None` where nothing is compared.
fn told(
    found: &Result<Verification, Refusal>,
    total: &mut Counts,
) -> Option<(&'static str, String)> {
    let verdict = match found {
        Err(refusal) => {
            total.refused += 1;
            return Some(("refused", refusal.to_string().replace('|', "\\|")));
        }
        Ok(found) if found.outputs.is_empty() && found.verdict == Verdict::Equivalent => {
            total.nothing += 1;
            return None;
        }
        Ok(found) => &found.verdict,
    };
    match verdict {
        Verdict::Equivalent => {
            total.equivalent += 1;
            Some(("equivalent", String::new()))
        }
        Verdict::Different(difference) => {
            total.different += 1;
            Some(("different", shown(difference)))
        }
        Verdict::Unknown {
            why: Reason::Nothing,
            ..
        } => {
            total.nothing += 1;
            None
        }
        Verdict::Unknown { why, .. } => {
            total.unknown += 1;
            Some(("unknown", reason(why)))
        }
    }
}

fn shown(difference: &Difference) -> String {
    let what = match &difference.what {
        What::Outputs(names) => few(names),
        What::Unstable(_) => "the spec is never stable".to_owned(),
        What::Restless => "never rests".to_owned(),
        What::Property => "a property".to_owned(),
    };
    let scans = match difference.trace.steps.len() {
        1 => "1 scan".to_owned(),
        scans => format!("{scans} scans"),
    };
    let brief = match difference.is_brief {
        true => ", over after another",
        false => "",
    };
    format!("{what} after {scans}{brief}")
}

fn reason(why: &Reason) -> String {
    match why {
        Reason::Numbers(names) => format!("numbers: {}", few(names)),
        Reason::Unconfirmed => "what is free".to_owned(),
        Reason::Rounds => "more scans or evolutions than are followed".to_owned(),
        Reason::Limits(why) => format!("limits: {why:?}"),
        Reason::Nothing => "nothing to compare".to_owned(),
    }
}

/// The first of some names, and how many more there are.
fn few(names: &[Name]) -> String {
    let shown = names.iter().take(2).map(|it| format!("`{it}`"));
    let shown: Vec<String> = shown.collect();
    match names.len() {
        0..=2 => shown.join(", "),
        all => format!("{} and {} more", shown.join(", "), all - 2),
    }
}
