//! Expressions that nest too deep or go on for ever.

use end_to_end::on_a_small_stack;
use logic::notation::{self, Lexer};
use logic::{Atoms, Budget, Function, Stop};

#[test]
fn nesting_is_refused_at_its_place() {
    for (open, inner, close) in [
        ("(", "a", ")"),
        ("(", "", ""),
        ("/(", "a", ")"),
        ("/ ", "a", ""),
        ("^", "a", ""),
        ("rise(", "a", ")"),
        ("fall(", "", ""),
        ("(a + ", "a", ")"),
        ("a*(", "a", ")"),
    ] {
        let text = open.repeat(100_000) + inner + &close.repeat(100_000);
        let problem = on_a_small_stack(|| notation::parse(&text)).expect_err("a problem");
        assert_eq!(
            problem.message, "expression nests deeper than 200",
            "{open}"
        );
        // The first that is too deep, not the end of the text.
        assert!(
            problem.span.range().end <= 210 * open.len(),
            "{open}: {problem:?}"
        );
    }
}

#[test]
fn what_nests_less_is_read_printed_and_computed() {
    for (open, close) in [("(a + b*", ")"), ("/(a*", ")"), ("rise(", ")"), ("^", "")] {
        let text = open.repeat(95) + "a" + &close.repeat(95);
        on_a_small_stack(|| {
            let expr = notation::parse(&text).expect("an expression");
            let printed = expr.to_string();
            assert_eq!(
                notation::parse(&printed).expect("its print").to_string(),
                printed
            );
            let mut atoms = Atoms::new();
            let function = Function::of(&expr.clone(), &mut atoms, &Budget::default());
            assert!(function.is_ok(), "{open}");
        });
    }
}

#[test]
fn a_long_sum_is_read_and_found_too_large() {
    let names: Vec<String> = (0..30_000).map(|at| format!("a{at}")).collect();
    for sign in ["*", " + "] {
        let text = names.join(sign);
        let answer = on_a_small_stack(|| {
            let expr = notation::parse(&text).expect("an expression");
            assert_eq!(expr.to_string(), text);
            let budget = Budget {
                nodes: 500,
                ..Budget::default()
            };
            Function::of(&expr, &mut Atoms::new(), &budget)
        });
        assert_eq!(answer, Err(Stop::TooLarge));
    }
}

/// Twice the text asks memory for twice the bytes, whatever is wrong with it.
#[test]
fn twice_the_text_takes_twice_the_work() {
    for piece in [
        "(", ")", "/", "a*", "a + ", "\"", "$", "\u{feff}", "9", "5s/", "a<b ", "\r", "// x\n",
        "[", "é",
    ] {
        let bytes = |count: usize| {
            let text = piece.repeat(count);
            let counted = allocation_counter::measure(|| {
                let mut lexer = Lexer::new(&text);
                while let Some(token) = lexer.take() {
                    assert!(text.get(token.span.range()).is_some(), "{token:?}");
                }
                let _ = notation::parse(&text);
            });
            counted.bytes_total
        };
        let (once, twice) = (bytes(20_000), bytes(40_000));
        assert!(
            twice <= once * 22 / 10 + 1_000,
            "{piece:?}: {once}, {twice}"
        );
    }
}
