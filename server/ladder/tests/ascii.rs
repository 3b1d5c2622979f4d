//! Ladders drawn with characters: what is read, where it stands, and what
//! programs of others that hold test vectors do when they are run.

mod ascii_vectors;

use ascii_vectors::vectors;
use ladder::scan::{Datum, Machine};
use ladder::{ElementKind, Format, Network, Port, Rung};

fn read(drawing: &str) -> ladder::Reading {
    let reading = ladder::read(drawing.as_bytes());
    assert_eq!(reading.program.format, Format::Ascii, "{drawing}");
    reading
}

/// A rung in a line: each element with its sources.
fn shown(drawing: &str, rung: &Rung) -> String {
    let network = &rung.network;
    let name = |at: petgraph::graph::NodeIndex| match at == Network::rail() {
        true => "rail".to_owned(),
        false => element(drawing, rung, at),
    };
    let elements = network.elements().skip(1).map(|(at, _)| {
        let sources: Vec<String> = network
            .arriving(at)
            .iter()
            .map(|(from, wire)| match &wire.from {
                Port::Power => name(*from),
                Port::Pin(pin) => format!("{}:{pin}", name(*from)),
            })
            .collect();
        format!("{} <- {}", name(at), sources.join(" + "))
    });
    elements.collect::<Vec<_>>().join("; ")
}

fn element(drawing: &str, rung: &Rung, at: petgraph::graph::NodeIndex) -> String {
    let element = rung.network.element(at);
    let text = |within| &drawing[rung.place(within).range()];
    match &element.kind {
        ElementKind::Contact(contact) => {
            format!("{}{}", text(element.within), text(contact.operand.within))
        }
        ElementKind::Coil(coil) => format!("{}{}", text(element.within), text(coil.operand.within)),
        ElementKind::Comparison(comparison) => format!(
            "{}{}{}",
            text(comparison.left.within),
            text(element.within),
            text(comparison.right.within)
        ),
        ElementKind::Jump(label) => format!(">>{}", text(label.within)),
        ElementKind::Label(label) => format!("{}:", text(label.within)),
        ElementKind::Timer(timer) => format!("{:?} {}", timer.kind, text(timer.instance.within)),
        ElementKind::Block(block) => format!("block {}", block.name),
        ElementKind::Gate(gate) => format!("{gate:?}"),
        ElementKind::Return { .. } => "return".to_owned(),
        other => format!("{other:?}"),
    }
}

#[track_caller]
fn check(drawing: &str, expected: &[&str], codes: &[&str]) {
    let reading = read(drawing);
    let rungs = &reading.program.routines[0].rungs;
    let lines: Vec<String> = rungs.iter().map(|rung| shown(drawing, rung)).collect();
    assert_eq!(lines, expected);
    let found: Vec<String> = reading
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code.to_string())
        .collect();
    assert_eq!(found, codes, "{:#?}", reading.diagnostics);
}

#[test]
fn contacts_in_series_and_parallel_feed_a_coil() {
    check(
        "\
|  Start    Stop  Run
+--[ ]--+---[/]---( )--
|  Run  |
+--[ ]--+
",
        &["[ ]Start <- rail; [ ]Run <- rail; [/]Stop <- [ ]Start + [ ]Run; ( )Run <- [/]Stop"],
        &[],
    );
}

#[test]
fn wires_cross_where_no_plus_is_drawn() {
    check(
        "\
|  a
+--[ ]--+
|  b    |
+--[ ]--|---------+
|       |  c      |  d
|       +--(S)--  +--(R)--
",
        &["[ ]a <- rail; [ ]b <- rail; (S)c <- [ ]a; (R)d <- [ ]b"],
        &[],
    );
}

#[test]
fn what_shares_rows_is_one_rung_solved_row_by_row() {
    check(
        "\
|  a
+--[ ]---+
|  b     |  b    c
+--( )-  +--[/]--( )--
|  d
+--( )--
",
        &[
            "[ ]a <- rail; ( )b <- rail; [/]b <- [ ]a; ( )c <- [/]b",
            "( )d <- rail",
        ],
        &[],
    );
}

#[test]
fn a_bridge_of_wires_before_the_first_contact_is_the_rail() {
    check(
        "\
+------+
|      |  a      x
| b    +--[ ]-+--( )-
+-[ ]---------+
|             |  y
|             +--(/)-
",
        &["[ ]a <- rail; [ ]b <- rail; ( )x <- [ ]a + [ ]b; (/)y <- [ ]a + [ ]b"],
        &[],
    );
}

#[test]
fn comparisons_have_their_second_side_below() {
    check(
        "\
|  temp cool
+--[>]--(S)-
|  -59
|  temp  temp heat
+--[<>]--[<=]-(P)-
|  x.[3] 16#F0
",
        &[
            "temp[>]-59 <- rail; (S)cool <- temp[>]-59",
            "temp[<>]x.[3] <- rail; temp[<=]16#F0 <- temp[<>]x.[3]; (P)heat <- temp[<=]16#F0",
        ],
        &[],
    );
}

#[test]
fn a_timer_is_a_box_whose_output_feeds_the_rung() {
    let drawing = "\
|          T1
|         +-----+
|  Fill   | TON |  Full
+---[ ]---|IN  Q|---( )-
|    500ms|PT ET|
|         +-----+
";
    check(
        drawing,
        &["[ ]Fill <- rail; OnDelay T1 <- [ ]Fill; ( )Full <- OnDelay T1:Q"],
        &[],
    );
    let reading = read(drawing);
    let rung = &reading.program.routines[0].rungs[0];
    let timer = rung
        .network
        .elements()
        .find_map(|(_, element)| match &element.kind {
            ElementKind::Timer(timer) => Some((timer, rung.place(element.within))),
            _ => None,
        });
    let (timer, span) = timer.unwrap();
    assert_eq!(timer.preset_ms, Some(500));
    assert_eq!(&*timer.output, "T1.Q");
    let place = &drawing[span.range()];
    assert!(place.starts_with("+-----+") && place.ends_with("+-----+"));
}

#[test]
fn jumps_labels_and_returns_are_read() {
    check(
        "\
| a
+-[ ]-->>END1
| b   c
+-[ ]-( )-
END1:
| d
+-[ ]--<RETURN>
Last:
",
        &[
            "[ ]a <- rail; >>END1 <- [ ]a",
            "[ ]b <- rail; ( )c <- [ ]b",
            "END1: <- rail; [ ]d <- rail; return <- [ ]d",
            "Last: <- rail",
        ],
        &[],
    );
}

#[test]
fn contacts_typed_as_relays_are_read() {
    check(
        "\
|  a    b     c
|--| |--|/|---( )---|
",
        &["[ ]"
            .replace("[ ]", "| |a <- rail; |/|b <- | |a; ( )c <- |/|b")
            .as_str()],
        &[],
    );
}

#[test]
fn what_is_not_known_is_kept_and_reported() {
    check(
        "\
|  a    b
+--[?]--(Q)--
|   i1
|  +-----+
|  | PID |  y
+--|X   Y|--( )-
|  +-----+
",
        &[
            "block [?] <- rail; block (Q) <- block [?]",
            "block PID <- rail; ( )y <- block PID:Y",
        ],
        &["G2001", "G2001", "G2001"],
    );
}

#[test]
fn faults_of_a_drawing_are_reported_and_reading_goes_on() {
    check(
        "\
|  a
+--[ ]--
|        b
|     +--( )--
| lost
+--[ ]--(  )--
+--[
+--( )--
",
        &[
            "[ ]a <- rail",
            "( )b <- ",
            "[ ]lost <- rail; (  )(  ) <- [ ]lost",
            "( )( ) <- rail",
        ],
        &["G1302", "G1301", "G1304", "G1101", "G1304"],
    );
}

#[test]
fn power_in_a_circle_is_cut() {
    let drawing = "\
|   a
+-+-[ ]-+-
| |     |
|    b  |
| +-[ ]-+
|  +-------------+
|  |  c    d     |
|  +--[ ]--( )---+
";
    let reading = read(drawing);
    let codes: Vec<_> = reading
        .diagnostics
        .iter()
        .map(|diagnostic| diagnostic.code.to_string())
        .collect();
    assert!(codes.contains(&"G1303".to_owned()), "{codes:?}");
}

#[test]
fn a_wide_junction_does_not_multiply_wires() {
    let mut drawing = String::new();
    for number in 0..200 {
        drawing += &format!("|  i{number:03} |  o{number:03}\n+--[ ]--+--( )--\n|       |\n");
    }
    let reading = read(&drawing);
    let network = &reading.program.routines[0].rungs[0].network;
    assert_eq!(network.len(), 1 + 200 + 200 + 1);
    assert!(network.graph().edge_count() < 1_000);
    let mut machine = Machine::new(&reading.program);
    machine.set_input("i150", true);
    machine.scan(0);
    assert!(machine.is_on("o007"));
}

#[test]
fn places_count_bytes_also_after_a_byte_order_mark_and_wide_characters() {
    let drawing = "\u{feff}(* é *)\r\n|  été   ö\r\n+--[/]---( )--\r\n";
    let reading = ladder::read(drawing.as_bytes());
    let rung = &reading.program.routines[0].rungs[0];
    assert_eq!(shown(drawing, rung), "[/]été <- rail; ( )ö <- [/]été");
    assert_eq!(rung.comment.as_deref(), Some("é"));
    let place = &drawing[rung.span.range()];
    assert_eq!(place, "|  été   ö\r\n+--[/]---( )--");
}

/// A program of the project's own that holds test vectors.
const FILLING: &str = r#"
{ T01
  \{ testVect = [ (2, [("Fill", X False), ("Level", I 0)]), (1, [("Fill", X True)])
                , (1, [("Fill", X False), ("Level", I 60)]), (1, [("Level", I 90)]) ]
  , watch    = ["Valve", "Half"]
  , expected = [ [X False, X False], [X False, X False], [X True, X False]
               , [X True, X True], [X False, X True] ]
  \}
}
|  Fill     Level   Valve
+--[ ]---+--[<]-----( )--
|  Valve |  80
+--[ ]---+
|  Level            Half
+--[>]--------------( )--
|  50
"#;

/// Drawings of others that hold test vectors need not be at hand: the
/// variable `GRADUS_CORPUS` names the folder above them.
fn corpus() -> Vec<(String, String)> {
    let folder = std::env::var("GRADUS_CORPUS").unwrap_or_default();
    let Ok(files) = std::fs::read_dir(format!("{folder}/ascii")) else {
        return Vec::new();
    };
    let mut drawings: Vec<_> = files
        .filter_map(|file| {
            let path = file.ok()?.path();
            let name = path.file_stem()?.to_str()?.to_owned();
            Some((name, std::fs::read_to_string(path).ok()?))
        })
        .collect();
    drawings.sort();
    drawings
}

/// What is to be said about real drawings: the rest is read without a word.
const REMARKS: [(&str, &[&str]); 2] = [
    ("testN02", &["G2001"]), // a contact `[?]`
    ("testN03", &["G1301"]), // a jump to a label that is not drawn
];

#[test]
fn every_real_drawing_is_read() {
    for (name, text) in corpus() {
        let reading = read(&text);
        let execution = ladder::flow::execution(&reading.program);
        let codes: Vec<String> = reading
            .diagnostics
            .iter()
            .chain(&execution.diagnostics)
            .map(|diagnostic| diagnostic.code.to_string())
            .collect();
        let remarks = REMARKS.iter().find(|(file, _)| name.ends_with(file));
        let expected = remarks.map_or(&[][..], |(_, codes)| *codes);
        assert_eq!(codes, expected, "{name}");
        let drawn = text.matches(['[', '(']).count();
        assert!(
            drawn < 2 || !reading.program.routines[0].rungs.is_empty(),
            "{name}"
        );
    }
}

/// Runs a program by its own test vectors, if it has any.
fn agrees_with_its_vectors(name: &str, text: &str) -> bool {
    let Some(vectors) = vectors(text) else {
        return false;
    };
    let reading = read(text);
    let mut machine = Machine::new(&reading.program);
    let mut rows = Vec::new();
    for (scans, inputs) in &vectors.steps {
        for (input, value) in inputs {
            machine.set_input(input, *value);
        }
        for _ in 0..*scans {
            machine.scan(10);
            let values = vectors.watch.iter().map(|name| machine.value(name));
            rows.push(values.collect::<Vec<Datum>>());
        }
    }
    assert_eq!(rows, vectors.expected, "{name}");
    true
}

#[test]
fn programs_do_what_their_test_vectors_say() {
    assert!(agrees_with_its_vectors("filling", FILLING));
    let real = corpus();
    let run = real
        .iter()
        .filter(|(name, text)| agrees_with_its_vectors(name, text))
        .count();
    // None contradicts its drawing, so none is left out.
    let with_vectors = real.iter().filter(|(_, text)| text.contains("testVect"));
    assert_eq!(run, with_vectors.count());
}

mod any_text {
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn reading_never_panics_and_places_lie_in_the_text(
            rows in prop::collection::vec("[-|+\\[\\]()/<>SRab1 é:{}*]{0,24}", 0..12)
        ) {
            let text = format!("+--[ ]--\n{}", rows.join("\n"));
            let reading = ladder::read(text.as_bytes());
            for diagnostic in &reading.diagnostics {
                prop_assert!(text.get(diagnostic.span.range()).is_some());
            }
            for (_, rung) in reading.program.rungs() {
                prop_assert!(text.get(rung.span.range()).is_some());
                for (_, element) in rung.network.elements() {
                    prop_assert!(text.get(rung.place(element.within).range()).is_some());
                    prop_assert!(rung.network.len() <= 4 * text.len());
                }
            }
            let mut machine = ladder::scan::Machine::new(&reading.program);
            machine.scan(10);
        }
    }
}
