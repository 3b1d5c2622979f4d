//! Reading the rung notation: every form once, every mistake once.

mod text;

use ladder::{Class, ElementKind, Role, Value};
use text::{drawn, fixture, network_said, program, without_marks};

/// The elements of the only rung of a text, one a line: number, what it is,
/// what feeds it.
#[track_caller]
fn check(rung: &str, expected: &[&str]) {
    let program = program(rung);
    let rungs: Vec<_> = program.rungs().collect();
    let [(_, rung)] = rungs.as_slice() else {
        panic!("one rung: {rung}");
    };
    let network = &rung.network;
    let line = |(at, element): (_, &ladder::Element)| {
        let feeds: Vec<_> = network
            .arriving(at)
            .iter()
            .map(|(from, _)| from.index().to_string())
            .collect();
        format!(
            "{} {} < {}",
            at.index(),
            short(&element.kind),
            feeds.join(" ")
        )
    };
    let drawn: Vec<_> = network.elements().skip(1).map(line).collect();
    assert_eq!(drawn, expected);
}

/// An element in a word or two.
fn short(kind: &ElementKind) -> String {
    match kind {
        ElementKind::Contact(contact) => format!("{:?} {}", contact.kind, contact.operand.name),
        ElementKind::Coil(coil) => format!("coil {:?} {}", coil.kind, coil.operand.name),
        ElementKind::Comparison(c) => {
            format!("{} {} {}", c.left.name, c.relation.sign(), c.right.name)
        }
        ElementKind::OneShot(shot) => format!("one-shot {:?}", shot.edge),
        ElementKind::Gate(gate) => format!("gate {gate:?}"),
        ElementKind::Timer(timer) => {
            let from = timer.preset_from.as_ref();
            let preset = from.map(|variable| variable.name.to_string());
            let preset = preset.unwrap_or_else(|| format!("{:?}", timer.preset_ms));
            format!("{:?} {} {preset}", timer.kind, timer.output)
        }
        ElementKind::Assign(assignment) => {
            let value = match &assignment.value {
                Value::Constant(number) => format!("{number}"),
                Value::Copy(operand) => operand.name.to_string(),
                Value::Increment(step) => format!("itself {step:+}"),
                Value::Term { text, reads } => {
                    let reads: Vec<_> = reads.iter().map(|operand| &*operand.name).collect();
                    format!("{text} of {}", reads.join(" "))
                }
            };
            format!("{} := {value}", assignment.target.name)
        }
        ElementKind::Block(block) => format!("box {}", block.name),
        other => format!("{other:?}"),
    }
}

#[test]
fn a_product_is_in_series_and_a_sum_in_parallel() {
    check(
        "rung: (s + v1) * /ls2 -> v1",
        &[
            "1 Open s < 0",
            "2 Open v1 < 0",
            "3 Closed ls2 < 1 2",
            "4 coil Plain v1 < 3",
        ],
    );
}

#[test]
fn a_complement_goes_down_to_the_contacts() {
    check(
        "rung: a * /(b*/c + x > 5) -> v",
        &[
            "1 Open a < 0",
            "2 Closed b < 1",
            "3 Open c < 1",
            "4 x <= 5 < 2 3",
            "5 coil Plain v < 4",
        ],
    );
}

#[test]
fn a_leg_without_contacts_is_a_bypass() {
    check(
        "rung: a * (b + 1) * (c + 0) -> v",
        &[
            "1 Open a < 0",
            "2 Open b < 1",
            "3 Open c < 2 1",
            "4 Open < 2 1",
            "5 coil Plain v < 3 4",
        ],
    );
}

#[test]
fn an_edge_of_a_variable_is_a_contact_where_it_stands() {
    check(
        "rung: a * rise(b) * fall(c) -> v",
        &[
            "1 Open a < 0",
            "2 Rising b < 1",
            "3 Falling c < 2",
            "4 coil Plain v < 3",
        ],
    );
}

#[test]
fn an_edge_of_an_expression_looks_at_the_expression_alone() {
    check(
        "rung: a * rise(b*c) * /fall(d) -> v",
        &[
            "1 Open a < 0",
            "2 Open b < 0",
            "3 Open c < 2",
            "4 one-shot Rising < 3",
            "5 gate And < 1 4",
            "6 Falling d < 0",
            "7 Invert < 6",
            "8 gate And < 5 7",
            "9 coil Plain v < 8",
        ],
    );
}

#[test]
fn several_outputs_and_legs_get_the_power_of_their_condition() {
    check(
        "rung: a -> v, set w, (b -> /x, y := 3), reset z",
        &[
            "1 Open a < 0",
            "2 coil Plain v < 1",
            "3 coil Set w < 1",
            "4 Open b < 1",
            "5 coil Negated x < 4",
            "6 y := 3 < 4",
            "7 coil Reset z < 1",
        ],
    );
}

#[test]
fn words_are_names_where_no_name_follows() {
    check(
        "rung: set * rise -> set, reset, rising rising, jump",
        &[
            "1 Open set < 0",
            "2 Open rise < 1",
            "3 coil Plain set < 2",
            "4 coil Plain reset < 2",
            "5 coil Rising rising < 2",
            "6 coil Plain jump < 2",
        ],
    );
}

#[test]
fn moves_are_constants_copies_steps_or_terms() {
    check(
        "rung: 1 -> R := -16#0F, R := S, R := 2 + R, R := R - 1, R := (S + 1) * ABS(T)",
        &[
            "1 R := -15 < 0",
            "2 R := S < 0",
            "3 R := itself +2 < 0",
            "4 R := itself -1 < 0",
            "5 R := (S + 1) * ABS(T) of S T < 0",
        ],
    );
}

#[test]
fn the_output_of_a_timer_is_the_one_that_is_read() {
    check(
        "rung: T1.DN * t3.Q -> TON(T1, 1m30s), TOF(t2, 250ms), RTO(t3, delay)",
        &[
            "1 Open T1.DN < 0",
            "2 Open t3.Q < 1",
            "3 OnDelay T1.DN Some(90000) < 2",
            "4 OffDelay t2.Q Some(250) < 2",
            "5 Retentive t3.Q delay < 2",
        ],
    );
}

#[test]
fn what_could_not_be_read_stays_as_an_unknown_box() {
    check(
        "rung: a b -> v, set 5, w",
        &[
            "1 box a b < 0",
            "2 coil Plain v < 1",
            "3 coil Plain set < 1",
            "4 box 5 < 1",
            "5 coil Plain w < 1",
        ],
    );
}

#[test]
fn an_address_and_a_name_are_one_variable() {
    let text = "rung: %IX0.1 * Speed.3 -> %Q9\ninput stop %I0.1\ninternal Speed %MW4\noutput %Q9";
    check(
        text,
        &[
            "1 Open stop < 0",
            "2 Open Speed.3 < 1",
            "3 coil Plain %Q9 < 2",
        ],
    );
    let program = program(text);
    let lamp = program.declarations.find("%Q9").expect("the lamp");
    assert_eq!(
        (lamp.address.as_deref(), lamp.class),
        (Some("%Q9"), Class::Output)
    );
}

#[test]
fn rungs_stand_in_the_routine_that_began_last() {
    let program = program(
        "program A\nrung: a -> b\nroutine Doors\nrung: c -> d\nrung: d -> e\n\
         program B\nroutine Start main\nroutine Valve block\nrung: a -> b",
    );
    let routines: Vec<_> = program
        .routines
        .iter()
        .map(|r| (&*r.scope, &*r.unit, r.role, r.rungs.len()))
        .collect();
    assert_eq!(
        routines,
        [
            ("A", "A", Role::Main, 1),
            ("A/Doors", "A", Role::Called, 2),
            ("B/Start", "B", Role::Main, 0),
            ("B/Valve", "B", Role::Definition, 1),
        ]
    );
    let last = program.rungs().last().expect("a rung").1;
    assert_eq!(last.number, 0);
}

#[test]
fn a_rung_is_described_by_its_title_and_the_comments_around_it() {
    let comment = |text: &str| {
        let program = program(text);
        let (_, rung) = program.rungs().last().expect("a rung");
        rung.comment.as_deref().unwrap_or("none").to_owned()
    };
    assert_eq!(comment("rung: a -> b"), "none");
    assert_eq!(comment("// Far\n\nrung \"Fill\": a -> b"), "Fill");
    assert_eq!(
        comment("rung: z -> z\n//Above\n// it\nrung \"Fill\": a // inside\n -> b // Behind "),
        "Fill\nAbove\nit\nBehind"
    );
}

#[test]
fn a_variable_is_described_by_the_comment_behind_it() {
    let program = program("// Valves\ninput a\ninput b %I0 : INT = 5 // The level");
    let description = |name| {
        let declaration = program.declarations.find(name).expect("declared");
        declaration
            .description
            .as_deref()
            .unwrap_or("none")
            .to_owned()
    };
    assert_eq!(description("a"), "none");
    assert_eq!(description("b"), "The level");
    let level = program.declarations.find("b").expect("declared");
    assert_eq!(
        (level.data_type.as_deref(), level.initial.as_deref()),
        (Some("INT"), Some("5"))
    );
}

#[test]
fn every_form_is_read_without_a_complaint() {
    let text = fixture("ladder/everything.ladder");
    assert_eq!(drawn(&without_marks(&text)), text);
}

#[test]
fn every_example_of_the_documentation_is_read() {
    let page = include_str!("../../../docs/notation.md");
    let mut examples = 0;
    for block in page.split("```ladder\n").skip(1) {
        let example = block.split("```").next().unwrap_or_default();
        let reading = ladder::read(example.as_bytes());
        let mistakes: Vec<_> = reading.diagnostics.iter().map(|d| &d.message).collect();
        assert!(mistakes.is_empty(), "{mistakes:?} in {example}");
        examples += 1;
    }
    assert!(examples >= 4);
}

#[test]
fn every_mistake_is_named_in_its_place() {
    let text = fixture("ladder/errors.ladder");
    assert_eq!(drawn(&without_marks(&text)), text);
}

#[test]
fn the_neutralization_ladder_is_that_of_the_case_study() {
    let text = fixture("neutralization/neutralization.ladder");
    let reading = ladder::read(text.as_bytes());
    assert_eq!(reading.diagnostics, []);
    assert_eq!(&*reading.program.name, "Neutralization");
    let declared: Vec<_> = reading
        .program
        .declarations
        .iter()
        .map(|d| format!("{} {}", d.address.as_deref().unwrap_or("-"), d.name))
        .collect();
    let expected = "%I0 s, %I1 ls1, %I2 ls2, %I3 ls3, %I4 tl, %I5 as, %Q0 v1, %Q1 v2, %Q2 v3, \
                    %Q3 v4, %Q4 h, %Q5 m, %Q6 light_tl, %Q7 light_as";
    assert_eq!(declared.join(", "), expected);
    // Pressing start in an empty tank opens the first valve and nothing else.
    let coils = |on: &[&str]| -> Vec<String> {
        let is_on = |name: &str| on.contains(&name);
        let rungs = reading.program.rungs();
        rungs
            .filter_map(|(_, rung)| text::drives_coil(&rung.network, &is_on))
            .collect()
    };
    assert_eq!(coils(&["s"]), ["v1"]);
    assert_eq!(coils(&["v1", "ls1", "ls2"]), ["v2", "h", "m"]);
    assert_eq!(coils(&["ls1", "tl", "as"]), ["v3", "light_tl", "light_as"]);
    assert_eq!(coils(&["ls1", "ls2", "ls3", "h", "m"]), ["v4", "h", "m"]);
}

#[test]
fn places_count_the_byte_order_mark() {
    let text = "\u{feff}rung: größe -> v1";
    let program = program(text);
    let (_, rung) = program.rungs().next().expect("a rung");
    let places: Vec<_> = rung
        .network
        .elements()
        .map(|(_, element)| &text[rung.place(element.within).range()])
        .collect();
    assert_eq!(places, ["", "größe", "v1"]);
    assert!(network_said(&rung.network).contains("größe"));
}

#[test]
fn only_ladders_are_taken_for_ladders() {
    let is_ladder =
        |text: &str| ladder::read(text.as_bytes()).program.format == ladder::Format::Ladder;
    assert!(is_ladder("// Nothing yet\n"));
    assert!(is_ladder("\n// A plant\nPROGRAM Plant"));
    assert!(is_ladder("garbage\nrung \"Fill\": a -> b"));
    assert!(!is_ladder("Output of the line is measured in tons.\n"));
    assert!(!is_ladder("program flow control\nis hard"));
    assert!(!is_ladder(
        "PROGRAM main\n  VAR\n    a : BOOL;\n  END_VAR\n"
    ));
    assert!(!is_ladder("Step p1, p2\nInput m, b\n"));
}
