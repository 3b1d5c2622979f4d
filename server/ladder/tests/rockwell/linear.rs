//! The size of what is read grows with the text and no faster, counted in
//! elements and wires.

/// Elements and wires of all rungs of `text`.
fn size(text: &str) -> usize {
    let reading = ladder::read(text.as_bytes());
    let networks = reading.program.rungs().map(|(_, rung)| &rung.network);
    networks
        .map(|network| network.len() + network.graph().edge_count())
        .sum()
}

fn check(text_of: impl Fn(usize) -> String) {
    let small = text_of(1_000);
    let large = text_of(4_000);
    let growth = size(&large) as f64 / size(&small) as f64;
    let length = large.len() as f64 / small.len() as f64;
    assert!(
        growth < 1.1 * length,
        "text grew {length:.2} times, network {growth:.2} times"
    );
}

#[test]
fn many_rungs() {
    check(|count| "XIC(a)[XIC(b) ,XIO(c) ]OTE(d);\n".repeat(count));
}

#[test]
fn a_long_series_of_branches() {
    check(|count| format!("{}OTE(d);", "[XIC(a) ,XIC(b) ]".repeat(count)));
}

#[test]
fn wide_branches_after_each_other() {
    check(|count| {
        let legs = vec!["XIC(a)"; count].join(",");
        format!("[{legs}][{legs}]OTE(d);")
    });
}

#[test]
fn branches_that_let_power_by() {
    check(|count| format!("{}OTE(d);", "[XIC(a) ,]".repeat(count)));
    check(|count| format!("[{}][XIC(a),XIC(b)]OTE(d);", ",".repeat(count)));
}
