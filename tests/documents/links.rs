//! Links between documents lead somewhere.

use std::fs;
use std::path::{Path, PathBuf};

/// All Markdown files at the top, in `docs` and in `tests`.
fn documents() -> Vec<PathBuf> {
    let mut folders = vec![end_to_end::path("docs"), end_to_end::path("tests")];
    let mut found: Vec<_> = ["README.md", "CHANGELOG.md"].map(end_to_end::path).into();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path);
            }
        }
    }
    found
}

/// What `](...)` encloses, outside fenced blocks.
fn targets(document: &str) -> Vec<&str> {
    let mut is_prose = true;
    let mut found = Vec::new();
    for line in document.lines() {
        if line.starts_with("```") {
            is_prose = !is_prose;
        } else if is_prose {
            let links = line.split("](").skip(1);
            found.extend(links.filter_map(|rest| rest.split(')').next()));
        }
    }
    found
}

fn leads_somewhere(document: &Path, target: &str) -> bool {
    let is_elsewhere = target.contains("://");
    let file = target.split('#').next().unwrap_or_default();
    let folder = document.parent().expect("a folder");
    is_elsewhere || file.is_empty() || folder.join(file).exists()
}

#[test]
fn every_link_to_a_file_leads_to_one() {
    let documents = documents();
    let mut broken = Vec::new();
    let mut followed = 0;
    for document in &documents {
        let text = fs::read_to_string(document).expect("a document");
        for target in targets(&text) {
            followed += 1;
            if !leads_somewhere(document, target) {
                broken.push(format!("{}: {target}", document.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert!(followed > 10, "only {followed} links found");
}
