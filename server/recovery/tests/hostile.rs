//! Ladders out of all proportion: conditions, successions and the spec come
//! back, within a small stack and the budget.

use end_to_end::on_a_small_stack;
use logic::{Budget, Stop};
use recovery::{analyse, conversion};

/// Contacts of one rung, as many as an unoptimised build computes in a few
/// seconds; `cargo test --release` takes all.
const LONG: usize = if cfg!(debug_assertions) {
    4_000
} else {
    200_000
};

/// Goes from `text` to the text of its spec and gives whether each coil has a
/// condition within `nodes`.
fn recover(text: &str, nodes: usize) -> Vec<bool> {
    let budget = Budget {
        nodes,
        ..Budget::default()
    };
    on_a_small_stack(|| {
        let reading = ladder::read(text.as_bytes());
        let analysis = analyse(&reading.program, &budget);
        let findings =
            recovery::findings::findings(&reading.program, &analysis.conditions, &budget);
        let inside = |span: source::Span| text.get(span.range()).is_some();
        assert!(findings.iter().all(|it| inside(it.span)));
        let spec = conversion::spec(&analysis, &[], &budget);
        let written = grafcet::write(&spec);
        assert_eq!(grafcet::write(&grafcet::read(&written).spec), written);
        let variables = &analysis.conditions.variables;
        let outcome = variables.iter().map(|variable| match &variable.next {
            Ok(next) => next.nodes() <= nodes,
            Err(stop) => {
                assert_eq!(*stop, Stop::TooLarge);
                false
            }
        });
        outcome.collect()
    })
}

fn names(count: usize) -> Vec<String> {
    (0..count).map(|at| format!("a{at}")).collect()
}

#[test]
fn a_rung_of_very_many_contacts_is_too_large_and_its_neighbours_are_not() {
    for sign in ["*", " + "] {
        let text = format!("rung: {} -> v\nrung: b -> w\n", names(LONG).join(sign));
        assert_eq!(recover(&text, 500), [false, true], "{sign}");
    }
}

#[test]
fn the_same_few_contacts_over_and_over_are_small() {
    for sign in ["*", " + "] {
        let text = format!("rung: {} -> v\n", vec!["a*/b"; LONG].join(sign));
        assert_eq!(recover(&text, 500), [true], "{sign}");
    }
}

#[test]
fn a_coil_of_many_rungs_is_folded() {
    let rungs: String = names(LONG / 10)
        .iter()
        .map(|name| format!("rung: {name} -> v\n"))
        .collect();
    assert_eq!(recover(&rungs, 500), [true]);
    let rungs: String = names(LONG / 10)
        .iter()
        .map(|name| format!("rung: {name} -> set v\n"))
        .collect();
    assert_eq!(recover(&rungs, 100), [false]);
}

#[test]
fn nesting_up_to_the_limit_is_computed() {
    let text = format!("rung: {}a{} -> v\n", "(b*/".repeat(190), ")".repeat(190));
    assert_eq!(recover(&text, 500), [true]);
}

/// The condition of an edge of edges names each of them twice: five are
/// written, 190 are too large.
#[test]
fn edges_of_edges_are_computed_or_too_large() {
    for (depth, is_small) in [(5, true), (190, false)] {
        let text = format!(
            "rung: {}a{} -> v\n",
            "rise(".repeat(depth),
            ")".repeat(depth)
        );
        assert_eq!(recover(&text, 500), [is_small], "{depth}");
    }
}

#[test]
fn calls_in_a_circle_and_in_a_long_chain_end() {
    let circle = "routine A\nrung: a -> call B\nroutine B\nrung: b -> call A, v\n";
    assert_eq!(recover(circle, 500).len(), 1);
    let chain: String = (0..LONG / 40)
        .map(|at| format!("routine R{at}\nrung: a{at} -> call R{}\n", at + 1))
        .collect();
    recover(&format!("program P\n{chain}"), 500);
}

#[test]
fn a_name_that_no_spec_can_hold_is_written_so_that_it_reads_back() {
    let text = "XIC(a)OTE(a \"name\n of 'two' lines);XIC(b)OTE(c);";
    recover(text, 500);
}
