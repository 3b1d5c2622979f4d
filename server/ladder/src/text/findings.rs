//! Diagnostics about statements that do not follow the grammar.

use logic::notation::{Lexer, Problem};
use source::{Diagnostic, Span, codes};

/// Why something could not be read.
pub(super) type Refusal = Box<Diagnostic>;

/// "expected this, found that", at the lexer's place.
pub(super) fn expected(lexer: &Lexer<'_>, what: &str) -> Diagnostic {
    syntax(
        lexer.here(),
        format!("expected {what}, found {}", lexer.found()),
    )
}

/// A statement that breaks the grammar at `span`.
pub(super) fn syntax(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(codes::LADDER_SYNTAX, span, message)
}

/// What the reader of expressions could not read.
pub(super) fn problem(problem: Problem) -> Diagnostic {
    syntax(problem.span, problem.message)
}
