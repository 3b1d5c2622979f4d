//! The ladder of the case study: eight rungs, whose functions are known.

use ladder::{Class, Role};

use crate::evaluation::coils;
use crate::places::repository;

const VARIABLES: [&str; 14] = [
    "s", "ls1", "ls2", "ls3", "tl", "as", "v1", "v2", "v3", "v4", "h", "m", "light_tl", "light_as",
];

/// Coil by coil, what the rungs say.
fn expected(rung: usize, on: &dyn Fn(&str) -> bool) -> (&'static str, bool) {
    let off = |name: &str| !on(name);
    match rung {
        0 => ("v1", (on("s") || on("v1")) && off("ls2")),
        1 => (
            "v2",
            (on("v2") || on("ls2") && off("as")) && off("ls3") && (off("tl") || off("as")),
        ),
        2 => ("v3", on("ls1") && (on("v3") || on("tl") && on("as"))),
        3 => (
            "v4",
            off("v3") && on("ls2") && (on("v4") || on("ls3")) && (off("tl") || off("as")),
        ),
        4 => ("h", on("ls1") && off("tl") && (on("h") || on("ls2"))),
        5 => ("m", on("ls1") && (on("m") || on("ls2"))),
        6 => ("light_tl", on("tl")),
        7 => ("light_as", on("as")),
        _ => panic!("there are eight rungs"),
    }
}

#[test]
fn the_neutralization_ladder_means_what_its_table_says() {
    let text = std::fs::read(repository("fixtures/neutralization/neutralization.xml")).unwrap();
    let reading = ladder::read(&text);
    assert_eq!(reading.diagnostics, []);
    let program = reading.program;
    assert_eq!(program.routines.len(), 1);
    assert_eq!(program.routines[0].role, Role::Main);
    let rungs = &program.routines[0].rungs;
    assert_eq!(rungs.len(), 8);
    for (number, rung) in rungs.iter().enumerate() {
        for bits in 0..1u32 << VARIABLES.len() {
            let on = |name: &str| {
                let place = VARIABLES.iter().position(|known| *known == name);
                bits >> place.expect("a variable of the table") & 1 == 1
            };
            let (coil, power) = expected(number, &on);
            let found = coils(&rung.network, &on);
            assert_eq!(found.len(), 1);
            assert_eq!(found.get(coil), Some(&power), "rung {number} at {bits:b}");
        }
    }
}

#[test]
fn its_variables_are_the_plants_by_their_addresses() {
    let text = std::fs::read(repository("fixtures/neutralization/neutralization.xml")).unwrap();
    let program = ladder::read(&text).program;
    let declarations = &program.declarations;
    let names: Vec<_> = declarations.iter().map(|d| &*d.name).collect();
    assert_eq!(names, VARIABLES);
    for declaration in declarations.iter() {
        let address = declaration.address.as_deref().unwrap();
        let class = if address.starts_with("%IX0.") {
            Class::Input
        } else {
            Class::Output
        };
        assert_eq!(declaration.class, class, "{address}");
        assert!(declaration.description.is_some());
    }
}
