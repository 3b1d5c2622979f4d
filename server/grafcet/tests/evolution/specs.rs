//! Whole specs of the project's fixtures.

use crate::run::check;

fn fixture(name: &str) -> String {
    let path = end_to_end::path(&format!("fixtures/grafcet/{name}"));
    std::fs::read_to_string(path).expect("a fixture")
}

#[test]
fn the_truck_of_the_published_example_is_loaded() {
    // `m` asks for a load, the truck drives until `b`, is loaded until `p`,
    // and the text leaves it there: its t4 leads from p1 to p1.
    check(
        &fixture("figure3.grafcet"),
        " -> p1 |
         a -> p1 |
         /a m -> p2 | R L
         /m -> p2 | R L
         b -> p3 | Z
         /b p -> p4 |
         a m -> p4 |",
    );
}

#[test]
fn a_spec_with_every_form_runs() {
    // Nothing encloses at the start, so the initial step of Guard 2 waits. With
    // s, t1 starts two steps, one of them a macro-step; t6, a source that reads
    // the step of an instance, starts E1, which encloses Guard and forces it;
    // and the instance goes on itself.
    check(
        &fixture("everything.formatted.grafcet"),
        " -> X0 d1.E0 |
         s -> Xv1 M1 E1 X20 X21 L1 d1.E2 | v1 R
         ls2 5s -> X1 E1 X20 X21 d1.E2 | R",
    );
}
