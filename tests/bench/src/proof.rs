//! What proofs cost, against ABC in the same run.
//!
//! `cargo run --release -p gradus-bench --bin gradus-bench-proof` prints the
//! tables that `docs/proof.md` explains. Arguments are numbers of latches to try
//! instead of those of the tables.
//!
//! All times are what the processor worked. ABC's are less the time to start it
//! and to read the files; ours begin with the question as a netlist.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use bench::abc::{Abc, Run};
use bench::measure::{ratio, time};
use bench::questions::{Question, rows, tank};
use bench::sequencer::{Coupling, Encoding};
use proof::{Limits, Netlist, Report, Verdict, blif, check};

const LATCHES: [usize; 5] = [24, 64, 120, 240, 1000];

const HEAD: &str = "
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
    println!("{HEAD}\n{}", row(&tank(), abc.as_ref()));
    for coupling in [Coupling::Alone, Coupling::Waiting] {
        println!("{HEAD}");
        for &latches in &sizes {
            for encoding in [Encoding::Cleared, Encoding::Register] {
                println!("{}", row(&rows(latches, encoding, coupling), abc.as_ref()));
            }
        }
    }
    ExitCode::SUCCESS
}

/// One line of a table.
fn row(question: &Question, abc: Option<&Abc>) -> String {
    let (equal, ours) = answered(&question.equal);
    let is_equal = equal.verdict == Verdict::Equivalent;
    assert!(
        is_equal || matches!(equal.verdict, Verdict::Unknown { .. }),
        "{equal:?}"
    );
    let [dsec, pdr] = abc.map_or([None, None], |abc| judged(abc, question));
    let (different, found) = answered(&question.different);
    let (fault, scans) = match different.verdict {
        Verdict::Different(it) if it.is_shortest() => (shown(found), it.trace.scans().to_string()),
        Verdict::Different(it) => (shown(found), format!("at most {}", it.trace.scans())),
        Verdict::Unknown { clean, .. } => ("not".to_owned(), format!("more than {clean}")),
        Verdict::Equivalent => panic!("the fault shows: {different:?}"),
    };
    let peer = |peer: Option<Duration>| peer.map_or("more than 120 s".to_owned(), shown);
    let times = |peer: Option<Duration>| {
        // The shell tells milliseconds.
        let peer = peer.map(|peer| peer.max(Duration::from_millis(1)));
        let peer = peer.filter(|_| is_equal);
        peer.map_or(String::new(), |peer| format!("{:.2}", ratio(ours, peer)))
    };
    let own = match is_equal {
        true => shown(ours),
        false => format!("undecided in {}", shown(ours)),
    };
    format!(
        "| {} | {} | {own} | {} | {} | {} | {} | {fault} | {scans} |",
        question.latches,
        question.name,
        peer(dsec),
        peer(pdr),
        times(dsec),
        times(pdr),
    )
}

/// The answer, and what it cost: the middle one of three times, if it does not
/// take long.
fn answered(netlist: &Netlist) -> (Report, Duration) {
    let mut report = None;
    let mut once = || time(|| report = Some(check(netlist, &Limits::default())));
    let mut times = vec![once()];
    if times[0] < Duration::from_secs(10) {
        times.extend([once(), once()]);
    }
    times.sort();
    let report = report.expect("it was asked");
    (report, times[times.len() / 2])
}

/// What `dsec` and `pdr` cost, if they come to the same verdict in time.
fn judged(abc: &Abc, question: &Question) -> [Option<Duration>; 2] {
    let [left, right] = &question.sides;
    let files = [
        ("left.blif", left),
        ("right.blif", right),
        ("question.blif", &question.equal),
    ];
    for (name, netlist) in files {
        abc.file(name, &blif::text(netlist, "question"))
            .expect("a file in target");
    }
    let says = |run: Run, verdict: &str| {
        let (text, worked) = run?;
        assert!(text.contains(verdict), "{text}");
        Some(worked)
    };
    let read = "read question.blif; strash; orpos";
    let pdr = format!("{read}; pdr; print_status");
    [
        says(
            abc.run_after(
                "read left.blif; read right.blif",
                "dsec left.blif right.blif",
            ),
            "are equivalent",
        ),
        says(abc.run_after(read, &pdr), "Status = 1"),
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
