//! Where blanks stand between the tokens of a statement.
//!
//! Layout never changes a token nor the order of tokens, only what is between
//! them: that is why formatting cannot change what a program says.

use logic::notation::{Token, TokenKind};

/// What a stretch of tokens is, which decides what `/` and `*` mean in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// Left of `->`: `/` complements, `*` is a series connection.
    Condition,
    /// Right of `->`.
    Outputs,
    /// Right of `:=`, up to the next comma: `/` divides.
    Assigned,
    /// What a box is given, commas and all: `/` divides.
    Term,
}

/// A term with the blanks that belong to it.
pub(super) fn term_text(text: &str, tokens: &[Token]) -> String {
    joined(text, tokens, &gaps(tokens, Mode::Term))
}

/// The tokens in a row, each with a blank before it where `gaps` says so.
pub(super) fn joined(text: &str, tokens: &[Token], gaps: &[bool]) -> String {
    let mut line = String::new();
    for (token, gap) in tokens.iter().zip(gaps) {
        if *gap && !line.is_empty() {
            line.push(' ');
        }
        line.push_str(token.text(text));
    }
    line
}

/// Whether a blank stands before each of the tokens.
///
/// The series connection of a whole rung is written `a * (b + c)`, one inside
/// a sum or in parentheses `a*b`: the eye finds the outermost first.
pub(super) fn gaps(tokens: &[Token], mode: Mode) -> Vec<bool> {
    let wide_product = mode == Mode::Condition && !has_outer_sum(tokens);
    let mut scene = Scene {
        modes: vec![mode],
        wide_product,
        previous: None,
    };
    tokens.iter().map(|token| scene.next(token.kind)).collect()
}

/// Whether a `+` stands outside all parentheses, left of the first arrow.
fn has_outer_sum(tokens: &[Token]) -> bool {
    let mut depth = 0_usize;
    for token in tokens {
        match token.kind {
            TokenKind::Open => depth += 1,
            TokenKind::Close => depth = depth.saturating_sub(1),
            TokenKind::Arrow => return false,
            TokenKind::Plus if depth == 0 => return true,
            _ => {}
        }
    }
    false
}

/// What is known when the next token comes.
struct Scene {
    /// The modes around the place, outermost first, one for each parenthesis.
    modes: Vec<Mode>,
    wide_product: bool,
    previous: Option<Previous>,
}

#[derive(Clone, Copy)]
struct Previous {
    kind: TokenKind,
    /// What it wants behind it, if the next token has no wish of its own.
    gap_behind: bool,
}

impl Scene {
    fn mode(&self) -> Mode {
        self.modes.last().copied().unwrap_or(Mode::Outputs)
    }

    fn next(&mut self, kind: TokenKind) -> bool {
        let (before, behind) = self.wishes(kind);
        let gap = match self.previous {
            None => false,
            // Two slashes would begin a comment.
            Some(previous) if previous.kind == TokenKind::Slash && kind == TokenKind::Slash => true,
            Some(previous) => before && previous.gap_behind,
        };
        self.enter(kind);
        self.previous = Some(Previous {
            kind,
            gap_behind: behind,
        });
        gap
    }

    /// Whether the token goes with a blank before it, and one behind it.
    fn wishes(&self, kind: TokenKind) -> (bool, bool) {
        let previous = self.previous.map(|previous| previous.kind);
        match kind {
            TokenKind::Comma => (previous == Some(TokenKind::Comma), true),
            TokenKind::Close | TokenKind::Colon => (false, true),
            TokenKind::Open => (!self.is_call(), false),
            TokenKind::Star => {
                let wide = self.in_term() || self.modes.len() == 1 && self.wide_product;
                (wide, wide)
            }
            TokenKind::Slash if self.in_term() => (true, true),
            TokenKind::Slash => (previous != Some(TokenKind::Time), false),
            TokenKind::Caret => (true, false),
            TokenKind::Minus => (true, previous.is_some_and(ends_value)),
            _ => (true, true),
        }
    }

    /// Whether a parenthesis here begins what a name is given: `rise(`, `TON(`.
    fn is_call(&self) -> bool {
        matches!(
            self.previous.map(|previous| previous.kind),
            Some(TokenKind::Name | TokenKind::Quoted)
        )
    }

    /// Notes what the token begins or ends.
    fn enter(&mut self, kind: TokenKind) {
        match (kind, self.mode()) {
            (TokenKind::Open, Mode::Condition) => self.modes.push(Mode::Condition),
            (TokenKind::Open, Mode::Outputs) if !self.is_call() => {
                self.modes.push(Mode::Condition);
            }
            (TokenKind::Open, _) => self.modes.push(Mode::Term),
            (TokenKind::Close, _) if self.modes.len() > 1 => {
                self.modes.pop();
            }
            (TokenKind::Arrow, _) | (TokenKind::Comma, Mode::Assigned) => {
                self.go_on(Mode::Outputs);
            }
            (TokenKind::Assign, Mode::Outputs) => self.go_on(Mode::Assigned),
            _ => {}
        }
    }

    fn go_on(&mut self, mode: Mode) {
        if let Some(last) = self.modes.last_mut() {
            *last = mode;
        }
    }

    fn in_term(&self) -> bool {
        matches!(self.mode(), Mode::Assigned | Mode::Term)
    }
}

fn ends_value(kind: TokenKind) -> bool {
    matches!(
        kind,
        TokenKind::Name
            | TokenKind::Quoted
            | TokenKind::Number
            | TokenKind::Time
            | TokenKind::Close
    )
}

#[cfg(test)]
mod tests {
    use logic::notation::Lexer;

    use super::*;

    fn spaced(text: &str) -> String {
        let mut lexer = Lexer::new(text);
        while lexer.take().is_some() {}
        let tokens = lexer.taken_since(0);
        joined(text, tokens, &gaps(tokens, Mode::Condition))
    }

    #[test]
    fn the_outermost_product_is_wide() {
        assert_eq!(spaced("a*b*(c+d*/e)"), "a * b * (c + d*/e)");
        assert_eq!(spaced("a * b+c"), "a*b + c");
    }

    #[test]
    fn a_slash_complements_in_a_condition_and_divides_in_a_term() {
        assert_eq!(
            spaced("/ a*/ / b->x:=y/2-( -z ),/ v,(c*/d->w)"),
            "/a * / /b -> x := y / 2 - (-z), /v, (c*/d -> w)"
        );
    }

    #[test]
    fn boxes_and_edges_hold_on_to_their_parentheses() {
        assert_eq!(
            spaced("rise ( a )*x>-3 -> TON (t1,5s),set  b,FB(i,IN:=a,Q=>c)"),
            "rise(a) * x > -3 -> TON(t1, 5s), set b, FB(i, IN := a, Q => c)"
        );
    }
}
