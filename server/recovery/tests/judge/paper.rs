//! The paper's case study: a tank in which the pH of what flows through is
//! neutralized. Its Table 5 and its count of suggestions must come out, of
//! the same ladder in three formats.

use std::collections::BTreeSet;
use std::sync::Arc;

use ladder::{Format, Program};
use logic::{Budget, Function, notation};
use recovery::analyse;
use recovery::conditions::{Conditions, Variable, conditions};
use recovery::successions::{Evidence, Succession, cubes, possible};

/// Suggestions of one state: what may follow it.
type Row = (&'static str, &'static str);

const HANDOVERS: [Row; 4] = [
    ("v1", "v2 v4 h m"),
    ("v2", "v3 v4"),
    ("v4", "v1 v3"),
    ("h", "v3"),
];

/// Figure 10: 22 of the 64 pairs of rungs.
const CUBES: [Row; 6] = [
    ("v1", "v2 v4 h m"),
    ("v2", "v3 light_tl light_as"),
    ("v4", "v1 v3 m light_tl light_as"),
    ("h", "v2 v3 v4 m light_tl"),
    ("light_tl", "v2 v4 h"),
    ("light_as", "v2 v4"),
];

/// The pairs that Figure 10 misses because of the order of variables.
const HIDDEN_BY_ORDER: [Row; 4] = [
    ("v2", "v4 h"),
    ("v4", "v2 h"),
    ("light_tl", "v3"),
    ("light_as", "v3"),
];

/// What is left of the 28 pairs between states where handovers are set aside.
const MERELY_POSSIBLE: [Row; 3] = [("v2", "h"), ("v4", "v2 h m"), ("h", "v2 v4 m")];

/// The case study in every format that the fixtures have it in.
fn programs() -> Vec<Arc<Program>> {
    let formats = [
        ("ladder", Format::Ladder),
        ("L5X", Format::L5x),
        ("xml", Format::Plcopen),
    ];
    formats
        .into_iter()
        .map(|(ending, format)| {
            let path = format!("fixtures/neutralization/neutralization.{ending}");
            let bytes = std::fs::read(end_to_end::path(&path)).expect("a fixture");
            let program = ladder::read(&bytes).program;
            assert_eq!(program.format, format);
            program
        })
        .collect()
}

fn pairs(rows: &[Row]) -> BTreeSet<(String, String)> {
    rows.iter()
        .flat_map(|(from, to)| {
            to.split_whitespace()
                .map(|to| (from.to_string(), to.to_owned()))
        })
        .collect()
}

fn pairs_of<'s>(
    successions: impl IntoIterator<Item = &'s Succession>,
) -> BTreeSet<(String, String)> {
    let pair = |it: &Succession| (it.from.to_string(), it.to.to_string());
    successions.into_iter().map(pair).collect()
}

fn variable<'c>(conditions: &'c Conditions, name: &str) -> &'c Variable {
    let variable = conditions.find(name);
    variable.unwrap_or_else(|| panic!("{name} is written by a coil"))
}

/// Checks that a condition means what the paper's table says.
#[track_caller]
fn check(conditions: &Conditions, condition: &Function, table: &str) {
    let expr = notation::parse(table).expect("an expression");
    let mut atoms = conditions.atoms.clone();
    let known = atoms.len();
    let expected = Function::of(&expr, &mut atoms, &Budget::default()).expect("small");
    assert_eq!(atoms.len(), known, "all variables of {table} are known");
    assert_eq!(*condition, expected, "{table}");
}

#[test]
fn table_5_comes_out_of_every_format() {
    let table = [
        ("v1", "v1*/ls2 + /v1*s*/ls2"),
        ("v2", "v2*/ls3*tl*/as + v2*/ls3*/tl + /v2*ls2*/ls3*/as"),
        ("v3", "v3*ls1 + /v3*ls1*tl*as"),
        (
            "v4",
            "/v3*v4*ls2*tl*/as + /v3*v4*ls2*/tl + /v3*/v4*ls2*ls3*tl*/as + /v3*/v4*ls2*ls3*/tl",
        ),
        ("h", "h*ls1*/tl + /h*ls1*ls2*/tl"),
        ("m", "m*ls1 + /m*ls1*ls2"),
    ];
    for program in programs() {
        let conditions = conditions(&program, &Budget::default());
        for (coil, activation) in table {
            let next = variable(&conditions, coil).next.clone().expect("small");
            check(&conditions, &next, activation);
        }
        let deactivation = variable(&conditions, "v2").deactivation().expect("small");
        check(&conditions, &deactivation, "ls3 + /ls3*tl*as");
    }
}

#[test]
fn conditions_are_printed_as_the_shortest_sum_in_the_order_of_the_table() {
    let budget = Budget::default();
    for program in programs() {
        let conditions = conditions(&program, &budget);
        let v2 = variable(&conditions, "v2");
        let printed = |condition: Result<Function, _>| {
            let condition = condition.expect("small");
            conditions
                .expr(&condition, &budget)
                .expect("short")
                .to_string()
        };
        let said = [
            printed(v2.next.clone()),
            printed(v2.turns_on()),
            printed(v2.stays_on()),
            printed(v2.deactivation()),
        ];
        assert_eq!(
            said,
            [
                "v2*/ls3*/tl + v2*/ls3*/as + ls2*/ls3*/as",
                "ls2*/ls3*/as",
                "/ls3*/tl + /ls3*/as",
                "ls3 + tl*as",
            ]
        );
    }
}

#[test]
fn figure_10_comes_out_of_the_algorithms_read_literally() {
    for program in programs() {
        let conditions = conditions(&program, &Budget::default());
        let found = cubes(&conditions, &Budget::default());
        assert_eq!(found.len(), 22);
        assert_eq!(pairs_of(&found), pairs(&CUBES));
    }
}

#[test]
fn without_an_order_of_variables_six_more_pairs_come_out() {
    let mut expected = pairs(&CUBES);
    expected.extend(pairs(&HIDDEN_BY_ORDER));
    for program in programs() {
        let conditions = conditions(&program, &Budget::default());
        let found = possible(&conditions, &Budget::default());
        assert_eq!(found.len(), 28);
        assert_eq!(pairs_of(&found), expected);
    }
}

#[test]
fn nine_pairs_are_handovers_and_every_other_is_merely_possible() {
    for program in programs() {
        let analysis = analyse(&program, &Budget::default());
        let (handovers, others): (Vec<_>, Vec<_>) = analysis
            .successions()
            .iter()
            .partition(|it| it.evidence == Evidence::Handover);
        assert_eq!(handovers.len(), 9);
        assert_eq!(pairs_of(handovers), pairs(&HANDOVERS));
        assert!(others.iter().all(|it| it.evidence == Evidence::Possible));
        assert_eq!(pairs_of(others), pairs(&MERELY_POSSIBLE));
    }
}
