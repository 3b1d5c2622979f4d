//! Words whose bits are looked at one by one and which are looked at whole.

use verification::Timing;

use crate::{assert_told, verified};

/// A spec of one step that does `always`.
fn spec(inputs: &str, outputs: &str, always: &str) -> String {
    format!(
        "Step X0\nTransition t\nInput {inputs}\nOutput {outputs}\nMarking X0\nTransitions:\nt: X0*0 |- @X0\nSteps:\n{always}"
    )
}

#[test]
fn a_word_of_alarms_is_cleared_as_a_whole_and_set_by_bits() {
    let ladder = "\
program P
input high
input hot
input reset
output horn
internal Alarms : DINT
rung: high -> set Alarms.0
rung: hot -> set Alarms.31
rung: reset -> Alarms := 0
rung: Alarms <> 0 -> horn
";
    let chart = |on: &str, off: &str| {
        format!(
            "Step X0, X1\nTransition t, u\nInput high, hot, reset\nOutput horn\nMarking X0\nTransitions:\n\
             t: X0*({on})*/reset |- @X1\nu: X1*{off} |- @X0\nSteps:\nX1: |- horn\n"
        )
    };
    let found = verified(ladder, &chart("high + hot", "reset"), Timing::Scan);
    assert_told(&found.verdict, "equivalent");
    assert!(found.free.is_empty());
    let found = verified(ladder, &chart("high", "reset"), Timing::Scan);
    assert_told(&found.verdict, "hot | horn | -\ndiffer: horn");
}

#[test]
fn ten_bits_with_a_thousand_values_are_compared_and_copied_exactly() {
    let bits = (0..10).map(|at| format!("rung: i{at} -> W.{at}\n"));
    let inputs = (0..10).map(|at| format!("input i{at}\n"));
    let ladder = format!(
        "program P\n{}output big\noutput same\ninternal W : INT\ninternal Copy : INT\n{}\
         rung: 1 -> Copy := W\nrung: Copy > 512 -> big\nrung: Copy = W -> same\n",
        inputs.collect::<String>(),
        bits.collect::<String>()
    );
    let names: Vec<String> = (0..10).map(|at| format!("i{at}")).collect();
    let low = names[..9].join(" + ");
    let always = format!("X0: i9*({low}) |- big\nX0: |- same\n");
    let found = verified(
        &ladder,
        &spec(&names.join(", "), "big, same", &always),
        Timing::Scan,
    );
    assert_told(&found.verdict, "equivalent");
    let always = "X0: i9 |- big\nX0: |- same\n";
    let found = verified(
        &ladder,
        &spec(&names.join(", "), "big, same", always),
        Timing::Scan,
    );
    assert_told(&found.verdict, "i9 | same | big same\ndiffer: big");
}

/// The bits of a number that is compared with 0 are more than those of -1, 0
/// and 1.
#[test]
fn a_word_from_the_plant_has_every_value_that_its_bits_can_tell_apart() {
    let ladder = "program P\ninput In : DINT\noutput a\noutput b\nrung: In = 0 -> a\nrung: In.3 * /In.0 -> b\n";
    let always = "X0: In = 0 |- a\nX0: In.3*/In.0 |- b\n";
    let found = verified(
        ladder,
        &spec("In, In.0, In.3", "a, b", always),
        Timing::Scan,
    );
    assert_told(&found.verdict, "equivalent");
    let always = "X0: In = 0 |- a\nX0: 0 |- b\n";
    let found = verified(
        ladder,
        &spec("In, In.0, In.3", "a, b", always),
        Timing::Scan,
    );
    assert_told(&found.verdict, "In=8 | b | -\ndiffer: b");
}

/// Of a ladder and what a spec does always.
#[track_caller]
fn assert_found(ladder: &str, inputs: &str, always: &str, expected: &str) {
    let found = verified(ladder, &spec(inputs, "a", always), Timing::Scan);
    assert_told(&found.verdict, expected);
}

#[test]
fn the_highest_bit_of_a_signed_word_is_its_sign() {
    let ladder = "program P\ninput In : SINT\noutput a\nrung: In.7 * In.0 -> a\n";
    let always = "X0: In < 0 |- a\n";
    assert_found(ladder, "In", always, "In=-128 | - | a\ndiffer: a");
    let ladder = ladder.replace("SINT", "BYTE");
    assert_found(&ladder, "In", always, "In=129 | a | -\ndiffer: a");
}

#[test]
fn the_one_side_looks_at_bits_and_the_other_at_the_word() {
    let ladder = "program P\ninput In : BYTE\noutput a\nrung: In.0 + In.1 + In.2 + In.3 + In.4 + In.5 + In.6 -> a\n";
    assert_found(
        ladder,
        "In",
        "X0: In > 0 |- a\n",
        "In=128 | - | a\ndiffer: a",
    );
    let ladder = "program P\ninput In : BYTE\noutput a\nrung: In >= 128 -> a\n";
    assert_found(ladder, "In.7", "X0: In.7 |- a\n", "equivalent");
}

#[test]
fn outputs_that_are_words_are_compared_bit_by_bit() {
    let ladder =
        "program P\ninput go\ninput In : INT\noutput Out : INT\nrung: rise(go) -> Out := In\n";
    let chart = |receptivity: &str| {
        format!(
            "Step X0, X1\nTransition t, u\nInput go, In\nOutput Out\nMarking X0\nTransitions:\n\
             t: X0*{receptivity} |- @X1\nu: X1*/go |- @X0\nSteps:\nX1: |- Out := In\n"
        )
    };
    let found = verified(ladder, &chart("go"), Timing::Scan);
    assert_told(&found.verdict, "equivalent");
    let found = verified(ladder, &chart("go*(In <> 5)"), Timing::Scan);
    assert_told(&found.verdict, "go In=5 | Out=5 | -\ndiffer: Out");
}

#[test]
fn a_word_behind_an_index_is_followed_by_its_bits() {
    let ladder = "\
program P
input go
input fault
output lamp
internal n : INT
rung: go -> n := 1
rung: /go -> n := 0
rung: fault -> \"Rows[n].3\"
rung: \"Rows[1]\" = 8 -> lamp
";
    let always = "X0: go*fault |- lamp\n";
    let found = verified(ladder, &spec("go, fault", "lamp", always), Timing::Scan);
    // What was written last stays.
    assert_told(
        &found.verdict,
        "go fault | lamp | lamp\nfault | lamp | -\ndiffer: lamp",
    );
}

#[test]
fn an_element_of_an_array_from_the_plant_takes_the_values_that_can_be_told_apart() {
    let ladder = |index: &str| {
        format!(
            "program P\ninput go\noutput a\ninternal n : INT\nrung: go -> n := 1\nrung: \"Level[{index}]\" > 50 -> a\n"
        )
    };
    let found = verified(&ladder("0"), &spec("go", "a", "X0: 0 |- a\n"), Timing::Scan);
    assert_told(&found.verdict, "Level[0]=51 | a | -\ndiffer: a");
    let found = verified(&ladder("n"), &spec("go", "a", "X0: 0 |- a\n"), Timing::Scan);
    assert_told(&found.verdict, "go Level[1]=51 | a | -\ndiffer: a");
}

#[test]
fn a_number_that_is_computed_with_is_in_the_range_that_comparisons_tell() {
    let ladder = "\
program P
input T : REAL
output a
output b
internal Seen : REAL
internal Twice : REAL
rung: 1 -> Seen := T
rung: 1 -> Twice := T * 2
rung: T > 133 -> a
rung: Seen > 140 -> b
";
    // What is above 140 is above 133, though nothing is known of its double.
    let found = verified(
        ladder,
        &spec(
            "T",
            "a, b",
            "X0: T > 133 |- a\nX0: (T > 140)*(T > 133) |- b\n",
        ),
        Timing::Scan,
    );
    assert_told(&found.verdict, "equivalent");
    assert!(found.free.is_empty());
    let found = verified(
        ladder,
        &spec("T", "a, b", "X0: T > 133 |- a\nX0: T > 150 |- b\n"),
        Timing::Scan,
    );
    assert_told(&found.verdict, "T=150 | a b | a\ndiffer: b");
}
