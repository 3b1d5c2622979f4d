//! Scenarios as text: what is read, what is reported, how it is laid out.

use scenario::{Passing, Test, Timing, format, is_scenario, read, write};

/// The canonical text of what `text` says, which must have no errors.
#[track_caller]
fn canonical(text: &str) -> String {
    let reading = read(text);
    assert_eq!(reading.diagnostics, []);
    write(&reading.scenario)
}

#[test]
fn every_form() {
    let text = "\
scenario \"Every form\"
for tank.ladder, \"line 3/tank.grafcet\"
timing settled
cycle 100ms

on s, off ls1, Level = -50 => on v1, off \"Local:1:O.Data.0\"
wait 1m30s                 => Count >= 3, Speed = 2.5  // after a while
on ls2, wait 5s            => only on m
scan                       => only
scan 3
on \"wait\"                  => \"on\" <> 7
\"wait\" = 5, \"for\" = 16
";
    let canonical = canonical(text);
    assert_eq!(canonical, text);
    let scenario = read(text).scenario;
    assert_eq!(scenario.timing, Timing::Settled);
    assert_eq!(scenario.cycle_ms, 100);
    assert_eq!(&*scenario.files[1].path, "line 3/tank.grafcet");
    assert_eq!(scenario.steps[1].passing, Passing::Wait(90_000));
    assert!(scenario.steps[2].only);
    assert_eq!(scenario.steps[3].passing, Passing::Scans(1));
    assert_eq!(scenario.steps[0].expected[1].test, Test::Off);
    assert_eq!(&*scenario.steps[5].changes[0].name, "wait");
}

#[test]
fn what_is_the_default_is_not_said() {
    assert_eq!(canonical("timing scan\ncycle 10ms\non s =>\n"), "on s\n");
    assert_eq!(canonical(""), "");
    // A relation behind a word shows that it is a name.
    assert_eq!(canonical("wait = 5"), "\"wait\" = 5\n");
    assert_eq!(canonical("scan 1 => on x, "), "scan => on x\n");
}

/// Each line with what is said of it.
#[track_caller]
fn check_errors(lines: &[(&str, &str)]) {
    let text: String = lines.iter().map(|(line, _)| format!("{line}\n")).collect();
    let reading = read(&text);
    let mut start = 0;
    let mut found = Vec::new();
    for (line, _) in lines {
        let end = start + line.len();
        let here = reading.diagnostics.iter();
        let here = here.filter(|it| (start..end).contains(&it.span.range().start));
        let messages: Vec<_> = here.map(|it| it.message.clone()).collect();
        found.push((*line, messages.join("; ")));
        start = end + 1;
    }
    let expected: Vec<_> = lines
        .iter()
        .map(|(line, message)| (*line, (*message).to_owned()))
        .collect();
    assert_eq!(found, expected);
}

#[test]
fn a_mistake_costs_its_line_and_no_other() {
    check_errors(&[
        (
            "scenario Untitled tank",
            "line not understood: expected the end of the line, found `tank`",
        ),
        ("on s => on v1", ""),
        (
            "on => on v1",
            "line not understood: expected the name of an input, found `=>`",
        ),
        (
            "on s on t",
            "line not understood: expected `,`, `=>` or the end of the line, found `on`",
        ),
        (
            "s => on v1",
            "line not understood: expected `=` and a value, found `=>`",
        ),
        (
            "Level = high",
            "line not understood: expected a number, found `high`",
        ),
        (
            "wait 5",
            "line not understood: expected a time such as `5s`, found `5`",
        ),
        (
            "scan 0",
            "line not understood: expected a number of scans, at least 1",
        ),
        (
            "scan, wait 5s",
            "line not understood: a step has one `wait` or `scan`; begin another line",
        ),
        (
            "on s => v1",
            "line not understood: expected `=` or another relation, and a value, found the end of the statement",
        ),
        (
            "timing settled",
            "`timing` after the first step does not count; it belongs to the head",
        ),
        (
            "on \"s => on v1",
            "line not understood: expected the name of an input, found a quote that does not end on its line",
        ),
        ("off s => off v1", ""),
    ]);
}

#[test]
fn the_head_says_a_thing_once() {
    check_errors(&[
        (
            "cycle 0ms",
            "line not understood: a cycle takes some time, at least 1ms",
        ),
        ("cycle 20ms", ""),
        ("cycle 30ms", "a second `cycle`; this one does not count"),
        (
            "timing now",
            "line not understood: expected `scan` or `settled`, found `now`",
        ),
    ]);
    assert_eq!(read("cycle 20ms\ncycle 30ms").scenario.cycle_ms, 20);
}

#[test]
fn layout_moves_blanks_only() {
    let text = "\u{feff}// Filling\r\nscenario   \"A\"  // of a tank\r\n\r\n\r\n\r\non s=>on v1 // go\r\noff   s , Level=- 5 =>   on v1,off m\r\non , => x\r\nscan\r\n  // end\r\n\r\n";
    let laid = "\u{feff}// Filling\r\nscenario \"A\"  // of a tank\r\n\r\non s              => on v1  // go\r\noff s, Level = -5 => on v1, off m\r\non , => x\r\nscan\r\n// end\r\n";
    let formatted = format(text);
    assert_eq!(formatted.text, laid);
    assert_eq!(formatted.left, 1);
    assert_eq!(format(laid).text, laid);
}

#[test]
fn a_scenario_is_known_by_what_it_says() {
    for text in [
        "on s => on v1",
        "// A tank\nscenario \"Filling\"\n",
        "off s",
        "wait 5s",
        "for tank.ladder\non s => on v1\n",
        "this is broken\non s => on v1\n",
        "timing settled",
        "Level = 5 => only",
        "for tank.ladder\n\nscan\nLevel = 5\noff s\n",
    ] {
        assert!(is_scenario(text), "{text}");
    }
    for text in [
        "",
        "on the left rail",
        "scenario planning",
        "program Tank\nrung: 1 -> PID(loop1, OUT => valve)\n",
        "Step p1\nTransitions:\nt1: p1*m |- @p1\n",
        "x = 5",
        "scan",
        "for all of it",
        "XIC(a)OTE(b);",
        "|--[ a ]---( b )--|",
    ] {
        assert!(!is_scenario(text), "{text}");
    }
}

/// Reading and laying out cost as much as there is to read: counted, not
/// timed.
#[test]
fn work_grows_with_the_text_and_no_faster() {
    let allocations = |lines: usize| {
        let text = "on s, Level = 5 => only on v1, off \"a b\" // go\n".repeat(lines);
        let count = allocation_counter::measure(|| {
            std::hint::black_box((read(&text), format(&text), is_scenario(&text)));
        });
        count.bytes_total
    };
    let (short, long) = (allocations(500), allocations(5_000));
    assert!(long < 15 * short, "{short} and {long} bytes");
}
