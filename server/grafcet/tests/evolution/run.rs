//! A run as text: what goes in and what comes out, scan by scan.

use grafcet::evolution::Machine;

/// A machine that runs `text`, which must have no errors.
#[track_caller]
pub fn machine(text: &str) -> Machine {
    let reading = grafcet::read(text);
    let mut errors = reading.diagnostics.iter();
    assert!(
        errors.all(|found| found.severity > source::Severity::Error),
        "{:?}",
        reading.diagnostics
    );
    Machine::new(&reading.spec.grafcet)
}

/// Runs `text` on `scans` and compares what comes out.
///
/// A scan is a line `changes -> active steps | outputs that are not 0`. A
/// change is `a` or `/a`, `n=5`, or a time that passes; without one 10 ms do.
#[track_caller]
pub fn check(text: &str, scans: &str) {
    let mut machine = machine(text);
    let mut happened = String::new();
    let lines = scans.lines().map(str::trim);
    for line in lines.clone().filter(|line| !line.is_empty()) {
        let (changes, _) = line.split_once("->").expect("a scan `changes -> result`");
        let result = scan(&mut machine, changes);
        happened += &format!("{} -> {result}\n", changes.trim());
    }
    let expected: Vec<_> = lines.filter(|line| !line.is_empty()).collect();
    let happened: Vec<_> = happened.lines().map(str::trim).collect();
    assert_eq!(happened, expected);
}

/// One scan after some changes: the active steps and the outputs.
pub fn scan(machine: &mut Machine, changes: &str) -> String {
    let mut elapsed = 10;
    for change in changes.split_whitespace() {
        if let Some(time) = logic::notation::milliseconds(change) {
            elapsed = time;
        } else if let Some((name, value)) = change.split_once('=') {
            machine.set_input(name, value.parse::<i64>().expect("a number"));
        } else if let Some(name) = change.strip_prefix('/') {
            machine.set_input(name, false);
        } else {
            machine.set_input(change, true);
        }
    }
    if let Err(unstable) = machine.scan(elapsed) {
        return unstable.to_string();
    }
    let active: Vec<&str> = machine.active().map(|name| &**name).collect();
    let outputs = machine.outputs().filter(|(_, value)| value.is_on());
    let outputs: Vec<String> = outputs
        .map(|(name, value)| match value {
            logic::Datum::Bool(_) => name.to_string(),
            number => format!("{name}={number}"),
        })
        .collect();
    let all = [&*active.join(" "), "|", &*outputs.join(" ")];
    all.into_iter()
        .filter(|it| !it.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}
