//! Every function of three atoms, against the definitions.

use std::collections::BTreeSet;

use logic::{AtomId, Budget, Function, Literal};

const ATOMS: [AtomId; 3] = [AtomId(1), AtomId(4), AtomId(9)];

/// The value of an atom in a row of a truth table.
fn value(atom: AtomId, row: usize) -> bool {
    let place = ATOMS.iter().position(|it| *it == atom).expect("an atom");
    row >> place & 1 == 1
}

/// The row with one atom set to a value.
fn with(row: usize, atom: AtomId, to: bool) -> usize {
    let place = ATOMS.iter().position(|it| *it == atom).expect("an atom");
    row & !(1 << place) | usize::from(to) << place
}

/// All truth tables of three atoms, each with its function.
fn all() -> impl Iterator<Item = ([bool; 8], Function)> {
    let budget = Budget::default();
    (0..256_usize).map(move |bits| {
        let table = std::array::from_fn(|row| bits >> row & 1 == 1);
        let mut function = Function::constant(false);
        for row in (0..8).filter(|&row| table[row]) {
            let product = ATOMS.iter().fold(Function::constant(true), |all, &atom| {
                let literal = Function::literal(atom, value(atom, row));
                all.and(&literal, &budget).expect("small")
            });
            function = function.or(&product, &budget).expect("small");
        }
        (table, function)
    })
}

#[test]
fn a_literal_is_one_that_can_raise_the_function() {
    for (table, function) in all() {
        let raises = |literal: &Literal| {
            (0..8).any(|row| {
                let [off, on] = [false, true].map(|on| {
                    let value = literal.positive == on;
                    table[with(row, literal.atom, value)]
                });
                on && !off
            })
        };
        let literals = ATOMS
            .iter()
            .flat_map(|&atom| [false, true].map(|positive| Literal { atom, positive }));
        let wanted: Vec<Literal> = literals.filter(raises).collect();
        assert_eq!(function.literals(), wanted, "{table:?}");
    }
}

#[test]
fn a_projection_holds_where_the_other_atoms_can_make_the_function_hold() {
    let budget = Budget::default();
    for (table, function) in all() {
        for kept in 0..8_usize {
            let kept = ATOMS
                .iter()
                .enumerate()
                .filter(|(at, _)| kept >> at & 1 == 1);
            let kept: BTreeSet<AtomId> = kept.map(|(_, atom)| *atom).collect();
            let projection = function.project(&kept, &budget).expect("small");
            assert!(projection.support().iter().all(|atom| kept.contains(atom)));
            for row in 0..8 {
                let agrees = |other: &usize| {
                    kept.iter()
                        .all(|&atom| value(atom, *other) == value(atom, row))
                };
                let wanted = (0..8).filter(agrees).any(|other| table[other]);
                let is = projection.evaluate(|atom| value(atom, row));
                assert_eq!(is, wanted, "{table:?} keeping {kept:?}, row {row}");
            }
        }
    }
}

#[test]
fn what_replaces_an_atom_by_itself_changes_nothing() {
    let budget = Budget::default();
    for (table, function) in all() {
        for atom in ATOMS {
            let same = function.substitute(atom, &Function::atom(atom), &budget);
            assert_eq!(same.as_ref(), Ok(&function), "{table:?}");
        }
    }
}

#[test]
fn one_without_the_other_is_a_conjunction_with_the_complement() {
    let budget = Budget::default();
    let some: Vec<Function> = all().map(|(_, function)| function).step_by(5).collect();
    for a in &some {
        for b in &some {
            let wanted = a.and(&b.not(), &budget);
            assert_eq!(a.and_not(b, &budget), wanted, "{a:?} without {b:?}");
        }
    }
}
