//! Properties of the rung notation over programs and texts made at random.

mod text;

use ladder::text::format;
use logic::notation::{Lexer, TokenKind};
use logic::{Expr, notation};
use proptest::prelude::*;
use text::{drives_coil, places, program, said};

const NAMES: [&str; 4] = ["a", "b", "c", "the door"];

fn expressions() -> impl Strategy<Value = Expr> {
    let leaf = prop_oneof![
        1 => any::<bool>().prop_map(Expr::Constant),
        8 => prop::sample::select(&NAMES[..]).prop_map(Expr::variable),
    ];
    leaf.prop_recursive(4, 24, 4, |inner| {
        prop_oneof![
            inner.clone().prop_map(Expr::complement),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::And),
            prop::collection::vec(inner, 2..4).prop_map(Expr::Or),
        ]
    })
}

/// Whether the expression holds where bit k of `row` is the value of name k.
fn holds(expr: &Expr, row: u32) -> bool {
    match expr {
        Expr::Constant(value) => *value,
        Expr::Atom(atom) => {
            let at = NAMES
                .iter()
                .position(|name| notation::quoted(name) == atom.to_string());
            row >> at.expect("a name") & 1 == 1
        }
        Expr::Not(inner) => !holds(inner, row),
        Expr::And(parts) => parts.iter().all(|part| holds(part, row)),
        Expr::Or(parts) => parts.iter().any(|part| holds(part, row)),
    }
}

/// Blanks, comments and line breaks of any kind, as they may stand inside a
/// rung.
fn blank() -> impl Strategy<Value = &'static str> {
    prop::sample::select(&["", " ", "  ", "\t", "\n ", "\r\n", " // x\n", "\n//y\n "][..])
}

/// A statement in pieces that blanks may stand between.
fn statement() -> impl Strategy<Value = Vec<String>> {
    let conditions = prop_oneof![
        6 => expressions().prop_map(|expr| expr.to_string()),
        1 => Just("rise(a*b)*/fall(c)".to_owned()),
        1 => Just("(level >= -3)*t1.DN".to_owned()),
    ];
    let outputs = prop::sample::select(
        &[
            "v1",
            "/v2",
            "set v3",
            "reset v3",
            "rising v4",
            "TON(t1, 5s)",
            "CTU(c1, -10)",
            "R := R + 1",
            "R := (a - 3) * 2",
            "jump again",
            "call Doors(a, 3)",
            "return",
            "PID(x, IN := a, OUT => b)",
            "(a*b -> v5, (c -> /v6))",
            "\"input\"",
            "MCR()",
        ][..],
    );
    let rung = (
        prop::sample::select(&["rung", "rung \"A title\"", "Rung label again"][..]),
        conditions,
        prop::collection::vec(outputs, 1..4),
    )
        .prop_map(|(head, condition, outputs)| {
            let mut pieces = vec![format!("{head}:")];
            pieces.extend(tokens(&condition));
            pieces.push("->".to_owned());
            pieces.extend(tokens(&outputs.join(", ")));
            pieces
        });
    let line = prop::sample::select(
        &[
            "input  start   %I0 // Start button",
            "output \"the door\" at \"Local:1\" : BOOL := 0",
            "internal t1:TIMER",
            "constant most = - 3",
            "variable %MW4",
            "program Plant",
            "routine Doors",
            "routine Main main // The first",
            "// A comment",
            "",
            "",
            "rung: a b -> c // broken",
            "no statement",
            "input",
            "rung",
            "rung: \"open",
        ][..],
    )
    .prop_map(|line| vec![line.to_owned()]);
    prop_oneof![2 => rung, 1 => line]
}

fn tokens(text: &str) -> Vec<String> {
    let mut lexer = Lexer::new(text);
    std::iter::from_fn(|| lexer.take())
        .map(|token| token.text(text).to_owned())
        .collect()
}

/// A text of statements with blanks, comments and line breaks inside.
fn texts() -> impl Strategy<Value = String> {
    let ends = prop::sample::select(&["\n", "\r\n", "\n\n", " // behind\n", "  \n"][..]);
    let laid = (statement(), prop::collection::vec(blank(), 40), ends);
    prop::collection::vec(laid, 1..8).prop_map(|statements| {
        let mut text = "rung: a -> b\n".to_owned();
        for (pieces, blanks, end) in statements {
            for (piece, blank) in pieces.iter().zip(blanks.iter().cycle()) {
                // Words that would run together keep a blank between them, and
                // slashes that would begin a comment.
                text.push_str(piece);
                text.push(' ');
                text.push_str(blank);
            }
            text.push_str(end);
        }
        text
    })
}

fn comments(text: &str) -> Vec<&str> {
    let mut lexer = Lexer::new(text);
    let mut all: Vec<_> = std::iter::from_fn(|| lexer.take())
        .filter(|token| token.kind == TokenKind::Comment)
        .map(|token| token.text(text).trim_end())
        .collect();
    all.sort_unstable();
    all
}

proptest! {
    #[test]
    fn a_rung_drives_its_coil_exactly_when_its_expression_holds(expr in expressions()) {
        let text = format!("rung: {expr} -> v");
        let program = program(&text);
        let (_, rung) = program.rungs().next().expect("a rung");
        for row in 0..16 {
            let is_on = |name: &str| NAMES.iter().position(|n| *n == name).is_some_and(|at| row >> at & 1 == 1);
            prop_assert_eq!(drives_coil(&rung.network, &is_on).is_some(), holds(&expr, row), "{} in row {}", text, row);
        }
    }

    #[test]
    fn a_rung_grows_with_its_expression_and_not_faster(expr in expressions()) {
        let text = format!("rung: {expr} -> v");
        let program = program(&text);
        let (_, rung) = program.rungs().next().expect("a rung");
        prop_assert!(rung.network.len() <= tokens(&text).len());
    }

    #[test]
    fn layout_changes_neither_program_nor_comments_and_is_stable(text in texts()) {
        let formatted = format(&text);
        prop_assert_eq!(&format(&formatted.text).text, &formatted.text);
        prop_assert_eq!(comments(&formatted.text), comments(&text));
        prop_assert_eq!(said(&program(&formatted.text)), said(&program(&text)));
        for left in formatted.left {
            let statement = &text[left.range()];
            prop_assert!(formatted.text.contains(statement), "left as it is: {}", statement);
        }
    }

    #[test]
    fn every_place_lies_in_the_text(text in texts()) {
        let reading = ladder::read(text.as_bytes());
        let rungs = reading.program.rungs();
        let elements = rungs.flat_map(|(_, rung)| places(rung));
        let findings = reading.diagnostics.iter().map(|finding| finding.span);
        for place in elements.chain(findings) {
            prop_assert!(text.get(place.range()).is_some(), "{:?} of {}", place, text.len());
        }
    }

    #[test]
    fn every_contact_and_coil_stands_where_its_name_is_written(expr in expressions()) {
        let text = format!("rung: {expr} -> v");
        let program = program(&text);
        let (_, rung) = program.rungs().next().expect("a rung");
        for (_, element) in rung.network.elements() {
            let whole = rung.place(element.within);
            for operand in element.kind.reads().into_iter().chain(element.kind.writes()) {
                let written = &text[rung.place(operand.within).range()];
                prop_assert_eq!(written, notation::quoted(&operand.name));
                prop_assert!(whole.cover(rung.place(operand.within)) == whole);
            }
        }
    }

    #[test]
    fn no_text_is_too_strange(
        text in "(rung|input|label|->|:=|:|[a-c]|[*+/(),\\[]|\"| |//|\n|\r|%I0|5s|5|é|\u{feff}){0,60}",
    ) {
        let text = format!("rung: a -> b\n{text}");
        let formatted = format(&text);
        prop_assert_eq!(&format(&formatted.text).text, &formatted.text);
        prop_assert_eq!(comments(&formatted.text), comments(&text));
        prop_assert_eq!(said(&program(&formatted.text)), said(&program(&text)));
    }
}

/// Doubling a rung doubles its network, whatever its form: sums in series,
/// nested parentheses, bypasses, edges, legs.
#[test]
fn networks_grow_linearly() {
    let forms: [fn(usize) -> String; 5] = [
        |n| format!("rung: {0} * {0} -> v, w", sum("a", n)),
        |n| format!("rung: {} -> v", vec!["(1 + a)"; n].join("*")),
        |n| format!("rung: a*{} -> v", vec!["rise(b*c)"; n].join("*")),
        |n| format!("rung: a -> {}", vec!["(b -> c)"; n].join(", ")),
        |n| format!("rung: {} -> {}", sum("a", n), vec!["v"; n].join(", ")),
    ];
    for form in forms {
        let size = |n: usize| {
            let program = program(&form(n));
            let (_, rung) = program.rungs().next().expect("a rung");
            rung.network.graph().node_count() + rung.network.graph().edge_count()
        };
        let (once, twice) = (size(500), size(1000));
        assert!(
            twice <= 2 * once + once / 20,
            "{once} and {twice}: {}",
            form(3)
        );
    }
}

fn sum(name: &str, terms: usize) -> String {
    format!("({})", vec![name; terms].join(" + "))
}

#[test]
fn deep_nesting_is_refused_and_not_followed() {
    for (open, close) in [("(", ")"), ("/(", ")"), ("rise(", ")")] {
        let text = format!(
            "rung: {}a{} -> v",
            open.repeat(100_000),
            close.repeat(100_000)
        );
        let reading = ladder::read(text.as_bytes());
        assert_eq!(reading.diagnostics.len(), 1, "{open}");
    }
    let legs = format!(
        "rung: a -> {}b -> c{}",
        "(b -> ".repeat(100_000),
        ")".repeat(100_000)
    );
    assert!(!ladder::read(legs.as_bytes()).diagnostics.is_empty());
    assert_eq!(format(&legs).text, legs + "\n");
}
