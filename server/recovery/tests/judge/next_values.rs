//! Next values against a simulated controller: what a variable holds after a
//! scan.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use ladder::Program;
use ladder::scan::Machine;
use logic::{Atom, Budget};
use proptest::prelude::*;
use recovery::analyse;
use recovery::conditions::{Conditions, Variable, conditions};

use crate::programs::{COILS, INPUTS, Sight, plain, steering};

type Situation = BTreeMap<&'static str, bool>;

/// Every situation of inputs and coils.
fn situations() -> impl Iterator<Item = Situation> {
    let names = || INPUTS.into_iter().chain(COILS);
    let count = names().count();
    (0..1_u32 << count).map(move |number| {
        let bits = (0..count).map(|bit| number >> bit & 1 == 1);
        names().zip(bits).collect()
    })
}

/// The situation after one scan from `before`.
fn scanned(program: &Program, before: &Situation) -> Situation {
    let mut machine = Machine::new(program);
    for (name, value) in before {
        machine.set_input(name, *value);
    }
    machine.scan(10);
    assert!(!machine.overran());
    let names = before.keys();
    names.map(|name| (*name, machine.is_on(name))).collect()
}

/// The next value of a variable where its contacts see `situation`.
fn next_value(variable: &Variable, conditions: &Conditions, situation: &Situation) -> bool {
    let next = variable.next.as_ref().expect("small programs have answers");
    next.evaluate(|atom| match conditions.atoms.atom(atom) {
        Atom::Variable(name) => situation[&**name],
        other => panic!("nothing in the program makes {other}"),
    })
}

/// What the contacts see that lead to the coils of `variable`, if none of them
/// stands on a rung that writes it: what is there before the first rung that
/// looks at it.
fn seen(
    variable: &Variable,
    conditions: &Conditions,
    program: &Program,
    before: &Situation,
) -> Option<Situation> {
    let name = |atom| match conditions.atoms.atom(atom) {
        Atom::Variable(name) => &**name,
        other => panic!("nothing in the program makes {other}"),
    };
    let mut seen = before.clone();
    let mut known = BTreeSet::from([&*variable.name]);
    for write in &variable.writes {
        let at = write.place.rung;
        let here = scanned(&up_to(program, at), before);
        let network = &program.routines[0].rungs[at].network;
        // A contact that no power can reach sees nothing.
        let guard = write.guard.as_ref().expect("small programs have answers");
        let reads: BTreeSet<&str> = guard.support().iter().map(|it| name(*it)).collect();
        let writes = network.elements().flat_map(|(_, it)| it.kind.writes());
        if writes
            .into_iter()
            .any(|it| it.name != variable.name && reads.contains(&*it.name))
        {
            return None;
        }
        for (name, value) in &mut seen {
            if reads.contains(name) && known.insert(name) {
                *value = here[name];
            }
        }
    }
    Some(seen)
}

/// The place in the main routine of the only rung that writes `variable`.
fn only_writer(variable: &Variable) -> Option<usize> {
    match &variable.writes[..] {
        [write] => Some(write.place.rung),
        _ => None,
    }
}

fn shown(variable: &Variable, program: &Program, before: &Situation) -> String {
    let rungs = ladder::text::write(program).text;
    format!("{} from {before:?} in\n{rungs}", variable.name)
}

/// The program without the rungs of its main routine from `at` on.
fn up_to(program: &Program, at: usize) -> Program {
    let mut program = program.clone();
    program.routines[0].rungs.truncate(at);
    program
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn where_contacts_see_what_was_before_the_scan_it_holds_for_the_whole_program(
        sketch in steering(),
    ) {
        let program = sketch.build(Sight::Before);
        let conditions = conditions(&program, &Budget::default());
        for before in situations() {
            let after = scanned(&program, &before);
            for variable in &conditions.variables {
                let next = next_value(variable, &conditions, &before);
                prop_assert_eq!(next, after[&*variable.name], "{}", shown(variable, &program, &before));
            }
        }
    }

    #[test]
    fn whatever_contacts_look_at_it_holds_over_what_they_see(
        sketch in plain(),
        number in 0..256_usize,
    ) {
        let program = sketch.build(Sight::Anything);
        let conditions = conditions(&program, &Budget::default());
        let before = situations().nth(number).expect("one of 256");
        let after = scanned(&program, &before);
        for variable in &conditions.variables {
            let Some(rung) = only_writer(variable) else { continue };
            let seen = scanned(&up_to(&program, rung), &before);
            let next = next_value(variable, &conditions, &seen);
            prop_assert_eq!(next, after[&*variable.name], "{}", shown(variable, &program, &before));
        }
    }

    #[test]
    fn where_several_rungs_write_it_holds_if_nothing_is_supposed_to_rest(
        sketch in plain(),
        number in 0..256_usize,
    ) {
        let program = Arc::new(sketch.build(Sight::Anything));
        let analysis = analyse(&program, &Budget::default());
        let before = situations().nth(number).expect("one of 256");
        let after = scanned(&program, &before);
        for variable in &analysis.conditions.variables {
            if !analysis.at_rest(variable).is_empty() {
                continue;
            }
            let seen = seen(variable, &analysis.conditions, &program, &before);
            let Some(seen) = seen else { continue };
            let next = next_value(variable, &analysis.conditions, &seen);
            prop_assert_eq!(next, after[&*variable.name], "{}", shown(variable, &program, &before));
        }
    }
}
