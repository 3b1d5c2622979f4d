//! Functions against truth tables, and the notation against itself.

use logic::{Atoms, Budget, Expr, Function, notation};
use proptest::prelude::*;

const NAMES: [&str; 5] = ["a", "b", "c", "d", "e"];

fn expressions() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        1 => any::<bool>().prop_map(Expr::Constant),
        8 => prop::sample::select(&NAMES[..]).prop_map(Expr::variable),
    ];
    leaf.prop_recursive(5, 40, 4, |inner| {
        prop_oneof![
            inner.clone().prop_map(Expr::complement),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::And),
            prop::collection::vec(inner, 2..4).prop_map(Expr::Or),
        ]
    })
}

/// The value of an expression where bit k of `row` is the value of name k.
fn value(expr: &Expr, row: u32) -> bool {
    match expr {
        Expr::Constant(value) => *value,
        Expr::Atom(atom) => {
            let name = atom.to_string();
            let at = NAMES.iter().position(|n| *n == name).expect("a name");
            row >> at & 1 == 1
        }
        Expr::Not(inner) => !value(inner, row),
        Expr::And(parts) => parts.iter().all(|part| value(part, row)),
        Expr::Or(parts) => parts.iter().any(|part| value(part, row)),
    }
}

fn table(expr: &Expr) -> Vec<bool> {
    (0..32).map(|row| value(expr, row)).collect()
}

fn atoms() -> Atoms {
    let mut atoms = Atoms::new();
    for name in NAMES {
        atoms.add_variable(&name.into());
    }
    atoms
}

proptest! {
    #[test]
    fn a_function_is_its_truth_table(expr in expressions(), other in expressions()) {
        let (mut atoms, budget) = (atoms(), Budget::default());
        let function = Function::of(&expr, &mut atoms, &budget).unwrap();
        let second = Function::of(&other, &mut atoms, &budget).unwrap();
        for row in 0..32 {
            prop_assert_eq!(function.evaluate(|atom| row >> atoms.place(atom) & 1 == 1), value(&expr, row));
        }
        // Equal tables, equal values: the diagrams are canonical.
        prop_assert_eq!(function == second, table(&expr) == table(&other));
        // The support holds what matters and nothing else.
        for (at, _) in NAMES.iter().enumerate() {
            let matters = (0..32u32).any(|row| value(&expr, row) != value(&expr, row ^ (1 << at)));
            prop_assert_eq!(function.depends_on(atoms.at(at).unwrap()), matters);
        }
    }

    #[test]
    fn a_constant_in_place_of_an_atom_gives_the_same_value_however_it_is_reached(
        expr in expressions(),
        at in 0..NAMES.len(),
        value in any::<bool>(),
    ) {
        let (mut atoms, budget) = (atoms(), Budget::default());
        let function = Function::of(&expr, &mut atoms, &budget).unwrap();
        let mut leaf = |atom: &logic::Atom| match atoms.find(atom) {
            Some(id) if atoms.place(id) == at => Function::constant(value),
            Some(id) => Function::atom(id),
            None => Function::constant(false),
        };
        let written = Function::build(&expr, &mut leaf, &budget).unwrap();
        let restricted = function.restrict(atoms.at(at).unwrap(), value);
        prop_assert_eq!(&restricted, &written);
        // And what lies between a function and itself is that function.
        let between = written.simplified_within(&restricted, &budget).unwrap();
        prop_assert_eq!(between, written);
    }

    #[test]
    fn products_are_irredundant_and_prime(expr in expressions()) {
        let (mut atoms, budget) = (atoms(), Budget::default());
        let function = Function::of(&expr, &mut atoms, &budget).unwrap();
        let products = function.products(&budget).unwrap();
        let holds = |product: &logic::Product, row: u32| {
            product.iter().all(|l| (row >> atoms.place(l.atom) & 1 == 1) == l.positive)
        };
        let covers = |products: &[&logic::Product], row| products.iter().any(|p| holds(p, row));
        let all: Vec<_> = products.iter().collect();
        for row in 0..32 {
            prop_assert_eq!(covers(&all, row), value(&expr, row));
        }
        for (at, product) in products.iter().enumerate() {
            let others: Vec<_> = products.iter().enumerate().filter(|(k, _)| *k != at).map(|(_, p)| p).collect();
            prop_assert!((0..32).any(|row| value(&expr, row) && !covers(&others, row)), "product {at} of {products:?}");
            for left_out in 0..product.len() {
                let mut shorter = product.clone();
                shorter.remove(left_out);
                prop_assert!((0..32).any(|row| holds(&shorter, row) && !value(&expr, row)), "literal {left_out} of {product:?}");
            }
        }
    }

    #[test]
    fn printing_and_reading_give_the_expression_back(expr in expressions()) {
        let text = notation::write(&expr);
        let read = notation::parse(&text).unwrap();
        prop_assert_eq!(notation::write(&read), text);
        prop_assert_eq!(table(&read), table(&expr));
    }

    #[test]
    fn reading_never_panics(text in "[a-c*+/()01 \"=<>^@|.:\\-]{0,30}") {
        let _ = notation::parse(&text);
    }

    #[test]
    fn restriction_substitution_and_quantification_follow_their_definitions(
        expr in expressions(), by in expressions(), at in 0..5u32,
    ) {
        let (mut atoms, budget) = (atoms(), Budget::default());
        let function = Function::of(&expr, &mut atoms, &budget).unwrap();
        let other = Function::of(&by, &mut atoms, &budget).unwrap();
        let atom = atoms.at(at as usize).unwrap();
        let bit = |row: u32, value: bool| if value { row | 1 << at } else { row & !(1 << at) };
        let restricted = function.restrict(atom, true);
        let substituted = function.substitute(atom, &other, &budget).unwrap();
        let quantified = function.exists(atom, &budget).unwrap();
        for row in 0..32 {
            let values = |atom: logic::AtomId| row >> atoms.place(atom) & 1 == 1;
            prop_assert_eq!(restricted.evaluate(values), value(&expr, bit(row, true)));
            prop_assert_eq!(substituted.evaluate(values), value(&expr, bit(row, value(&by, row))));
            prop_assert_eq!(quantified.evaluate(values), value(&expr, bit(row, true)) || value(&expr, bit(row, false)));
        }
    }
}

#[test]
fn the_paper_prints_the_deactivation_of_v2_as_two_products() {
    let (mut atoms, budget) = (Atoms::new(), Budget::default());
    for name in ["v2", "ls2", "ls3", "tl", "as"] {
        atoms.add_variable(&name.into());
    }
    let rung = notation::parse("(v2 + ls2*/as) * /ls3 * (/tl + /as)").unwrap();
    let guard = Function::of(&rung, &mut atoms, &budget).unwrap();
    let v2 = atoms.find_variable(&"v2".into()).unwrap();
    let print = |f: &Function| notation::write(&f.to_expr(&atoms, &budget).unwrap());
    assert_eq!(print(&guard.restrict(v2, true).not()), "ls3 + tl*as");
    assert_eq!(print(&guard.restrict(v2, false)), "ls2*/ls3*/as");
    assert_eq!(guard.paths().count(), 3);
}

#[test]
fn comparisons_and_edges_print_as_they_are_read() {
    for text in [
        "Level > 50",
        "a*(Level <= 50)*/b",
        "/rise(a) + fall(b*c)",
        "5s/X3*m",
        "\"Local:1:I.Data.0\"*/X.3",
        "/(/(a*b))",
        "(Index = 10) + \"R[2]\" <> -3",
        "t1.ET >= 1m30s",
        "\"3rd floor\" = 3",
    ] {
        let read = notation::parse(text).unwrap();
        let once = notation::write(&read);
        assert_eq!(notation::parse(&once).unwrap(), read, "{text} -> {once}");
    }
}

#[test]
fn every_part_knows_the_bytes_it_was_written_in() {
    let text = "  /(a*(b)) + (c > 5)";
    let node = notation::expression(&mut notation::Lexer::new(text)).unwrap();
    assert_eq!(&text[node.span.range()], "/(a*(b)) + (c > 5)");
    let notation::NodeKind::Or(parts) = &node.kind else {
        panic!("a sum: {node:?}");
    };
    let written: Vec<_> = parts.iter().map(|part| &text[part.span.range()]).collect();
    assert_eq!(written, ["/(a*(b))", "c > 5"]);
    let mut names = Vec::new();
    node.each_name(&mut |name, span| names.push((name.to_string(), &text[span.range()])));
    let expected = ["a", "b", "c"].map(|name| (name.to_owned(), name));
    assert_eq!(names, expected);
}

#[test]
fn a_problem_says_what_was_expected_and_what_stands_there() {
    let problem = |text| notation::parse(text).unwrap_err().message;
    assert_eq!(
        problem("a*"),
        "expected a name, `/` or `(`, found the end of the text"
    );
    assert_eq!(problem("(a b)"), "expected `)` or an operator, found `b`");
    assert_eq!(
        problem("a*\"b"),
        "expected a name, `/` or `(`, found a quote that does not end on its line"
    );
}

/// `a0*b0 + a1*b1 + ...` with all of the `a` before all of the `b`: the worst
/// order, in which the diagram doubles with every pair.
fn pairs(count: u32, budget: &Budget) -> Function {
    let atom = |at| Function::atom(logic::AtomId(u64::from(at)));
    (0..count).fold(Function::constant(false), |sum, at| {
        let pair = atom(at).and(&atom(count + at), budget).unwrap();
        sum.or(&pair, budget).unwrap()
    })
}

#[test]
fn a_large_diagram_with_a_short_sum_is_written() {
    let budget = Budget::default();
    let function = pairs(11, &budget);
    assert!(function.nodes() > 4_000);
    assert_eq!(function.products(&budget).map(|sum| sum.len()), Ok(11));
}

#[test]
fn what_needs_more_products_than_allowed_is_too_large() {
    let budget = Budget {
        products: 10,
        ..Budget::default()
    };
    let sum = pairs(11, &budget).products(&budget);
    assert_eq!(sum, Err(logic::Stop::TooLarge));
}

#[test]
fn no_sum_is_written_after_a_cancel() {
    let budget = Budget::default();
    let function = pairs(3, &budget);
    budget.cancel.cancel();
    assert_eq!(function.products(&budget), Err(logic::Stop::Cancelled));
}
