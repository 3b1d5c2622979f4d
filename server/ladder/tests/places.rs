//! Places within a rung: what stands above a rung moves it, and nothing in it.

use ladder::{Program, Rung};

/// The elements of a rung as the text writes them.
fn written<'t>(text: &'t str, rung: &Rung) -> Vec<&'t str> {
    let elements = rung.network.elements().skip(1);
    let places = elements.map(|(_, element)| rung.place(element.within));
    places.map(|place| &text[place.range()]).collect()
}

fn last(program: &Program) -> &Rung {
    let (_, rung) = program.rungs().last().expect("a rung");
    rung
}

/// Reads `text` by itself and below `above`. Both times the last rung is
/// written as `wanted`. Whether its network is the same.
#[track_caller]
fn is_same_below(above: &str, text: &str, wanted: &[&str]) -> bool {
    let below = format!("{above}{text}");
    let [one, other] = [text, &*below].map(|text| ladder::read(text.as_bytes()).program);
    assert_eq!(written(text, last(&one)), wanted);
    assert_eq!(written(&below, last(&other)), wanted);
    last(&one).network == last(&other).network
}

#[test]
fn text_above_leaves_the_network_of_a_rung_as_it_is() {
    assert!(is_same_below(
        "// Doors\nrung: x -> y\n",
        "rung: a * /b -> set c, TON(t, wait), jump again",
        &["a", "/b", "set c", "TON(t, wait)", "jump again"],
    ));
    assert!(is_same_below(
        "XIC(x)OTE(y);\n",
        "XIC(a)[XIO(b),GEQ(c,9)]MOV(d,e);\n",
        &["XIC(a)", "XIO(b)", "GEQ(c,9)", "MOV(d,e)"],
    ));
}

#[test]
fn other_surroundings_make_another_network() {
    let text = "rung: a -> %Q0";
    assert!(is_same_below("input b\n", text, &["a", "%Q0"]));
    assert!(!is_same_below("output c %Q0\n", text, &["a", "%Q0"]));
}

#[test]
fn what_is_called_after_its_place_is_another_thing_elsewhere() {
    let text = "rung: a b -> c";
    assert!(!is_same_below("rung: x -> y\n", text, &["a b", "c"]));
}
