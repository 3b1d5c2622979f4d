//! Guards against brute force: for every element of a network the condition
//! under which power arrives is what an interpreter without diagrams finds.

use logic::Budget;
use proptest::prelude::*;

use crate::networks::{drawn, wired};
use crate::valuations::judge;

const SAMPLES: usize = 300;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn power_through_drawn_networks_is_what_an_interpreter_finds(network in drawn()) {
        let tally = judge(&network, SAMPLES, &Budget::default());
        prop_assert_eq!(tally.too_large, 0);
    }

    #[test]
    fn power_through_wired_networks_is_what_an_interpreter_finds(network in wired()) {
        let tally = judge(&network, SAMPLES, &Budget::default());
        prop_assert_eq!(tally.too_large, 0);
    }
}
