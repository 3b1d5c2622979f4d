//! A converted spec against its ladder, on random inputs.

use logic::Cancel;
use proptest::collection::vec;
use proptest::prelude::*;
use recovery::conversion::Accept;
use recovery::simulation::{Subject, simulate};
use scenario::{Change, Passing, Scenario, Step};
use source::Span;

use crate::tables::{converted, program};

const INPUTS: [&str; 6] = ["s", "ls1", "ls2", "ls3", "tl", "as"];

fn step(bits: u8) -> Step {
    let change = |(at, name): (usize, &&str)| Change {
        name: (*name).into(),
        value: (bits >> at & 1 == 1).into(),
        span: Span::default(),
    };
    Step {
        changes: INPUTS.iter().enumerate().map(change).collect(),
        passing: Passing::Scans(1),
        ..Step::default()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The product form is right from the first second: on any inputs, in
    /// every scan.
    #[test]
    fn the_product_form_agrees_with_its_ladder_on_any_inputs(inputs in vec(0..64u8, 1..60)) {
        let program = program("neutralization.ladder");
        let grafcet = converted(&program, &Accept::None);
        let scenario = Scenario {
            steps: inputs.into_iter().map(step).collect(),
            ..Scenario::default()
        };
        let subject = Subject { ladder: Some(&program), grafcet: Some(&grafcet) };
        let simulation = simulate(&scenario, subject, &Cancel::default());
        let differing = simulation.rows.iter().find(|row| !row.differences.is_empty());
        prop_assert_eq!(differing, None);
        prop_assert_eq!(simulation.stopped, None);
    }
}
