//! A judge that knows no gates: it runs the program on every sequence of inputs,
//! shortest first.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::Arc;

use ladder::Program;
use ladder::scan::Machine;
use logic::{Budget, Name};
use proof::Limits;
use proptest::prelude::*;
use recovery::successions::Sights;
use recovery::{Analysis, analyse};
use verification::witness::sights;

/// What is seen of each pair, by all sequences of inputs: the fewest scans.
#[derive(Debug, Default, PartialEq, Eq)]
struct Seen {
    at_once: BTreeMap<(Name, Name), usize>,
    delayed: BTreeMap<(Name, Name), usize>,
    together: BTreeSet<(Name, Name, Name)>,
}

const INPUTS: [&str; 3] = ["a", "b", "c"];

/// Runs everything, in a plant in which no more than one input changes if that is
/// asked.
fn run_all(program: &Program, states: &[Name], is_calm: bool) -> Seen {
    let mut seen = Seen::default();
    // The inputs of the last scan, and the state that ended last with none on
    // since, are part of where a run is.
    type Place = (Vec<bool>, u8, BTreeSet<Name>);
    let on = |machine: &Machine<'_>| -> Vec<bool> {
        states.iter().map(|name| machine.is_on(name)).collect()
    };
    let mut known: HashSet<Place> = HashSet::new();
    let first = Machine::new(program);
    let mut border = vec![(first, 0_u8, BTreeSet::<Name>::new())];
    let mut scans = 0;
    while !border.is_empty() {
        scans += 1;
        let mut next = Vec::new();
        for (machine, inputs, idle) in &border {
            for row in 0..1_u8 << INPUTS.len() {
                if is_calm && (row ^ inputs).count_ones() > 1 {
                    continue;
                }
                let mut after = machine.clone();
                for (at, name) in INPUTS.iter().enumerate() {
                    after.set_input(name, row >> at & 1 == 1);
                }
                after.scan(10);
                let (before, now) = (on(machine), on(&after));
                let of = |was: bool, is: bool| -> Vec<&Name> {
                    let places = states.iter().enumerate();
                    let those = places.filter(|(at, _)| before[*at] == was && now[*at] == is);
                    those.map(|(_, name)| name).collect()
                };
                let (ends, begins) = (of(true, false), of(false, true));
                for from in &ends {
                    for (at, to) in begins.iter().enumerate() {
                        let pair = ((*from).clone(), (*to).clone());
                        seen.at_once.entry(pair).or_insert(scans);
                        for other in &begins[at + 1..] {
                            let mut two = [(*to).clone(), (*other).clone()];
                            two.sort();
                            let [one, other] = two;
                            seen.together.insert(((*from).clone(), one, other));
                        }
                    }
                }
                for from in idle {
                    for to in &begins {
                        let pair = (from.clone(), (*to).clone());
                        seen.delayed.entry(pair).or_insert(scans);
                    }
                }
                let waits = match now.contains(&true) {
                    true => BTreeSet::new(),
                    false => idle.iter().chain(ends).cloned().collect(),
                };
                let inputs = if is_calm { row } else { 0 };
                let stored: Vec<bool> = after.stored().map(|(_, value)| value.is_on()).collect();
                if known.insert(([stored, now].concat(), inputs, waits.clone())) {
                    next.push((after, inputs, waits));
                }
            }
        }
        border = next;
    }
    seen
}

/// A term of inputs and coils: `(x + y) * /z`.
fn term() -> impl Strategy<Value = String> {
    let literal = || (0..6_usize, any::<bool>());
    (literal(), literal(), literal(), any::<bool>()).prop_map(|(x, y, z, is_product)| {
        let names = ["a", "b", "c", "p", "q", "r"];
        let word = |(at, on): (usize, bool)| format!("{}{}", if on { "" } else { "/" }, names[at]);
        let sign = if is_product { "*" } else { "+" };
        format!("({} {sign} {}) * {}", word(x), word(y), word(z))
    })
}

/// Three coils that seal in, on terms of everything.
fn ladders() -> impl Strategy<Value = String> {
    proptest::collection::vec((term(), term()), 3).prop_map(|rungs| {
        let coils = ["p", "q", "r"];
        let mut text = String::from("input a\ninput b\ninput c\noutput p\noutput q\noutput r\n");
        for (coil, (start, keep)) in coils.iter().zip(rungs) {
            text += &format!("rung: {start} + {coil} * ({keep}) -> {coil}\n");
        }
        text
    })
}

fn judged(analysis: &Analysis, found: &Sights) {
    for group in analysis.groups().iter().map(|it| &it.states) {
        let free = run_all(&analysis.program, group, false);
        let calm = run_all(&analysis.program, group, true);
        for from in group {
            for to in group.iter().filter(|to| *to != from) {
                let pair = (from.clone(), to.clone());
                let sight = found.pairs.get(&pair).cloned().unwrap_or_default();
                let scans = |it: &Option<Arc<recovery::successions::Witness>>| {
                    it.as_ref().map(|it| it.scans())
                };
                let expected = |calm: Option<&usize>, free: Option<&usize>| calm.or(free).copied();
                assert_eq!(
                    scans(&sight.at_once),
                    expected(calm.at_once.get(&pair), free.at_once.get(&pair)),
                    "{pair:?} at once"
                );
                assert_eq!(
                    scans(&sight.delayed),
                    expected(calm.delayed.get(&pair), free.delayed.get(&pair)),
                    "{pair:?} delayed"
                );
            }
        }
        let own = found
            .together
            .iter()
            .filter(|(from, ..)| group.contains(from));
        assert_eq!(own.cloned().collect::<BTreeSet<_>>(), calm.together);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]
    #[test]
    fn a_run_through_all_sequences_sees_the_same(text in ladders()) {
        let program = ladder::read(text.as_bytes()).program;
        let analysis = analyse(&program, &Budget::default());
        let found = sights(&analysis, &[], &Limits::default()).expect("a translation");
        prop_assert!(found.is_whole);
        judged(&analysis, &found);
    }
}
