//! Random grafcets, run by the machine and by brute force.

use std::collections::BTreeSet;

use grafcet::evolution::Machine;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

use crate::charts::{INPUTS, OUTPUTS, STEPS, grafcets};
use crate::reference::Reference;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_500))]

    #[test]
    fn the_machine_does_what_brute_force_does(
        grafcet in grafcets(),
        scans in vec((0..8u32, select(vec![0u64, 10, 20])), 1..12),
    ) {
        let mut machine = Machine::new(&grafcet);
        let mut reference = Reference::new(&grafcet.chart);
        for (bits, elapsed) in scans {
            for (at, input) in INPUTS.iter().enumerate() {
                let is_on = bits >> at & 1 == 1;
                machine.set_input(input, is_on);
                reference.set_input(input, is_on.into());
            }
            let is_stable = machine.scan(elapsed).is_ok();
            prop_assert_eq!(is_stable, reference.scan(elapsed).is_some());
            let active: BTreeSet<&str> = machine.active().map(|name| &**name).collect();
            let expected = STEPS.into_iter().filter(|step| reference.is_active(step));
            prop_assert_eq!(active, expected.collect());
            for output in OUTPUTS {
                prop_assert_eq!(machine.value(output).integer(), reference.value(output));
            }
        }
    }
}
