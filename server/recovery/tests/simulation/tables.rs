//! The published sequences of the neutralization plant.

use std::collections::BTreeSet;
use std::sync::Arc;

use grafcet::Grafcet;
use ladder::Program;
use logic::{Budget, Cancel};
use recovery::conversion::{Accept, decide, spec};
use recovery::simulation::{Simulation, Subject, findings, simulate, unknown_names};

fn fixture(name: &str) -> String {
    let path = end_to_end::path(&format!("fixtures/neutralization/{name}"));
    std::fs::read_to_string(path).expect("a fixture")
}

pub fn program(file: &str) -> Arc<Program> {
    ladder::read(fixture(file).as_bytes()).program
}

/// What `gradus convert --accept ...` writes, read back.
pub fn converted(program: &Arc<Program>, accept: &Accept) -> Grafcet {
    let budget = Budget::default();
    let analysis = recovery::analyse(program, &budget);
    let decisions = decide(&analysis, &[], accept);
    let text = grafcet::write(&spec(&analysis, &decisions, &budget));
    let reading = grafcet::read(&text);
    assert_eq!(reading.diagnostics, []);
    reading.spec.grafcet
}

fn run(table: &str, subject: Subject<'_>) -> Simulation {
    let text = fixture(table);
    assert_eq!(scenario::format(&text).text, text, "{table} is laid out");
    let reading = scenario::read(&text);
    assert_eq!(reading.diagnostics, []);
    assert_eq!(unknown_names(&reading.scenario, subject), []);
    let simulation = simulate(&reading.scenario, subject, &Cancel::default());
    assert_eq!(findings(&reading.scenario, &simulation), []);
    simulation
}

const TABLES: [&str; 3] = ["table-2.scenario", "table-3.scenario", "table-4.scenario"];

#[test]
fn the_ladder_does_what_the_tables_say_in_every_format() {
    for file in [
        "neutralization.ladder",
        "neutralization.L5X",
        "neutralization.xml",
    ] {
        let program = program(file);
        for table in TABLES {
            let subject = Subject {
                ladder: Some(&program),
                grafcet: None,
            };
            run(table, subject);
        }
    }
}

#[test]
fn the_product_form_does_the_same_side_by_side() {
    let program = program("neutralization.ladder");
    let grafcet = converted(&program, &Accept::None);
    for table in TABLES {
        let subject = Subject {
            ladder: Some(&program),
            grafcet: Some(&grafcet),
        };
        assert!(run(table, subject).agrees(), "{table}");
    }
}

/// With all handovers accepted the spec says that v4 follows v2. The ladder
/// lets v2 open again beside v4, whenever the level has fallen below ls3: what
/// the acceptance costs shows in the two tables in which that happens.
#[test]
fn what_handovers_give_runs_and_differs_where_it_must() {
    let program = program("neutralization.ladder");
    let grafcet = converted(&program, &Accept::Handovers);
    for (table, expected) in TABLES.into_iter().zip([&["v2"][..], &[], &["v2"]]) {
        let subject = Subject {
            ladder: Some(&program),
            grafcet: Some(&grafcet),
        };
        let scenario = scenario::read(&fixture(table)).scenario;
        let simulation = simulate(&scenario, subject, &Cancel::default());
        assert_eq!(simulation.stopped, None, "{table}");
        let rows = simulation.rows.iter();
        let differing: BTreeSet<&str> = rows
            .flat_map(|row| &row.differences)
            .map(|name| &**name)
            .collect();
        assert_eq!(Vec::from_iter(differing), expected, "{table}");
    }
}
