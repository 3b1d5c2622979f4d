//! ABC (Berkeley Logic Synthesis and Verification Group) as judge: it reads the
//! files that are written here and comes to its own verdict.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use proof::{Netlist, aiger, blif};

/// How to run ABC, or `None` after saying that it cannot be had. Where
/// `CI=true`, somebody counts on it.
pub fn abc() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abc");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../proof/tests/judge/bring-abc");
    let brought = Command::new("bash").arg(script).arg(&folder).output();
    if brought.is_ok_and(|output| output.status.success()) {
        return Some(folder.join("abc"));
    }
    let is_ci = std::env::var("CI").is_ok_and(|value| value == "true");
    assert!(!is_ci, "berkeley-abc cannot be had, and CI=true demands it");
    eprintln!("skipped: berkeley-abc cannot be had");
    None
}

fn answer(abc: &Path, folder: &Path, commands: &str) -> String {
    let output = Command::new(abc)
        .current_dir(folder)
        .args(["-q", commands])
        .output()
        .expect("abc runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Whether ABC's sequential equivalence check finds the two equal.
pub fn dsec(abc: &Path, folder: &Path, sides: [&Netlist; 2]) -> bool {
    for (side, name) in sides.into_iter().zip(["left", "right"]) {
        fs::write(
            folder.join(name).with_extension("blif"),
            blif::text(side, name),
        )
        .expect("written");
    }
    let answer = answer(abc, folder, "dsec left.blif right.blif");
    match answer {
        it if it.contains("are NOT EQUIVALENT") => false,
        it if it.contains("are equivalent") => true,
        it => panic!("dsec came to no verdict: {it}"),
    }
}

/// After how many scans ABC says that a property is violated at the earliest,
/// if `bound` scans are enough; or that none ever is.
pub fn model_checked(
    abc: &Path,
    folder: &Path,
    both: &Netlist,
    bound: Option<usize>,
) -> Option<usize> {
    fs::write(folder.join("both.aig"), aiger::binary(&both.plain())).expect("written");
    let engine = match bound {
        Some(scans) => format!("bmc3 -F {scans}"),
        None => "pdr".to_owned(),
    };
    let commands = format!("read both.aig; orpos; {engine}; print_status");
    let answer = answer(abc, folder, &commands);
    let status = answer.split("Status = ").nth(1).unwrap_or(&answer);
    if status.starts_with('0') {
        let frame = status
            .split("Frame =")
            .nth(1)
            .and_then(|it| it.split_whitespace().next());
        let frame: usize = frame.and_then(|it| it.parse().ok()).expect(&answer);
        return Some(frame + 1);
    }
    assert!(
        status.starts_with('1') || bound.is_some(),
        "no verdict: {answer}"
    );
    None
}
