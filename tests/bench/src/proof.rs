//! What proofs cost, against ABC in the same run.
//!
//! `cargo run --release -p gradus-bench --bin gradus-bench-proof` prints the
//! table that `docs/proof.md` explains. Arguments are numbers of latches to try
//! instead of those of the table.
//!
//! All times are what the processor worked. ABC's are less the time to start it
//! and to read the files; ours begin with the two netlists as they are built.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use bench::abc::{Abc, Run};
use bench::measure::{ratio, time};
use bench::sequencer::{Encoding, Fault, STEPS, rows};
use proof::{Limits, Netlist, Report, Verdict, blif, check, compare};

const LATCHES: [usize; 5] = [24, 64, 120, 240, 1000];

const HEAD: &str = "\
| latches | compared with | ours | `dsec` | `pdr` | ours : `dsec` | ours : `pdr` | fault found in | after scans |
|---|---|---|---|---|---|---|---|---|";

fn main() -> ExitCode {
    let given: Vec<usize> = std::env::args()
        .skip(1)
        .filter_map(|it| it.parse().ok())
        .collect();
    let sizes = if given.is_empty() {
        LATCHES.to_vec()
    } else {
        given
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/bench-proof");
    if let Err(error) = std::fs::create_dir_all(&folder) {
        eprintln!("{}: {error}", folder.display());
        return ExitCode::FAILURE;
    }
    let abc = Abc::bring(&folder);
    if abc.is_none() {
        eprintln!("berkeley-abc cannot be had: its columns stay empty");
    }
    println!("{HEAD}");
    for latches in sizes {
        for encoding in [Encoding::Cleared, Encoding::Register] {
            println!("{}", row(latches, encoding, abc.as_ref()));
        }
    }
    ExitCode::SUCCESS
}

/// One line of the table.
fn row(latches: usize, encoding: Encoding, abc: Option<&Abc>) -> String {
    let count = latches / STEPS;
    let left = rows(count, Encoding::OneHot, None);
    let right = rows(count, encoding, None);
    let (equal, ours) = proved(&left, &right);
    assert!(equal.verdict == Verdict::Equivalent, "{equal:?}");
    let peers = abc.map_or([None, None], |abc| judged(abc, &left, &right));
    let fault = Fault {
        row: count / 2,
        step: STEPS - 2,
    };
    let (different, found) = proved(&left, &rows(count, encoding, Some(fault)));
    let Verdict::Different(difference) = different.verdict else {
        panic!("the fault shows: {different:?}");
    };
    assert!(difference.is_shortest());
    let peer = |peer: Option<Duration>| peer.map_or("more than 120 s".to_owned(), shown);
    let times = |peer: Option<Duration>| {
        // The shell tells milliseconds.
        let peer = peer.map(|peer| peer.max(Duration::from_millis(1)));
        peer.map_or(String::new(), |peer| format!("{:.2}", ratio(ours, peer)))
    };
    let name = match encoding {
        Encoding::OneHot => "itself",
        Encoding::Cleared => "steps that are cleared",
        Encoding::Register => "a register",
    };
    let [dsec, pdr] = peers;
    format!(
        "| {latches} | {name} | {} | {} | {} | {} | {} | {} | {} |",
        shown(ours),
        peer(dsec),
        peer(pdr),
        times(dsec),
        times(pdr),
        shown(found),
        difference.trace.scans(),
    )
}

fn proved(left: &Netlist, right: &Netlist) -> (Report, Duration) {
    let mut report = None;
    let mut once =
        || time(|| report = Some(check(&compare(left, right).netlist, &Limits::default())));
    let mut times: Vec<Duration> = (0..3).map(|_| once()).collect();
    times.sort();
    let report = report.expect("it was asked three times");
    (report, times[1])
}

/// What `dsec` and `pdr` cost, if they come to the same verdict in time.
fn judged(abc: &Abc, left: &Netlist, right: &Netlist) -> [Option<Duration>; 2] {
    for (name, side) in [("left.blif", left), ("right.blif", right)] {
        abc.file(name, &blif::text(side, "rows"))
            .expect("a file in target");
    }
    let says = |run: Run, verdict: &str| {
        let (text, worked) = run?;
        assert!(text.contains(verdict), "{text}");
        Some(worked)
    };
    let miter = "miter left.blif right.blif; strash; orpos";
    let pdr = format!("{miter}; pdr; print_status");
    [
        says(
            abc.run_after(
                "read left.blif; read right.blif",
                "dsec left.blif right.blif",
            ),
            "are equivalent",
        ),
        says(abc.run_after(miter, &pdr), "Status = 1"),
    ]
}

/// A time with three digits.
fn shown(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    match seconds {
        s if s >= 1.0 => format!("{s:.2} s"),
        s => format!("{:.1} ms", 1e3 * s),
    }
}
