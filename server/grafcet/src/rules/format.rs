use logic::notation::{Token, TokenKind};
use source::Diagnostic;

use super::syntax::{Document, Kind, Line, Statement};
use super::words::{GRAFCET, PartWord};
use super::{decisions, parse, read};
use crate::PartKind;

/// A text in canonical layout, and the findings about it.
#[derive(Clone, Debug)]
pub struct Formatted {
    /// The text.
    pub text: String,
    /// What reading the text it was made from finds.
    pub diagnostics: Vec<Diagnostic>,
}

/// Lays a rule text out: blanks between signs, one blank line at most, one
/// before each section, no indentation but in the lines that a statement goes
/// on in.
///
/// Statements, their order, their parentheses and their comments stay, and so
/// does every line that cannot be understood, byte for byte. Formatting twice
/// gives the same as once.
pub fn format(text: &str) -> Formatted {
    let document = parse::parse(text);
    let mut lines: Vec<Laid> = Vec::new();
    for statement in &document.statements {
        lay(&document, statement, &mut lines);
    }
    while lines.last().is_some_and(Laid::is_blank) {
        lines.pop();
    }
    let line_end = document.line_end();
    let mut out = String::with_capacity(text.len());
    if text.starts_with('\u{feff}') {
        out.push('\u{feff}');
    }
    for line in lines {
        out.push_str(&line.text);
        out.push_str(line_end);
    }
    Formatted {
        text: out,
        diagnostics: read(text).diagnostics,
    }
}

/// A line of the result.
struct Laid {
    text: String,
    is_comment: bool,
}

impl Laid {
    fn is_blank(&self) -> bool {
        self.text.is_empty()
    }

    fn blank() -> Self {
        Self {
            text: String::new(),
            is_comment: false,
        }
    }
}

fn lay(document: &Document<'_>, statement: &Statement, lines: &mut Vec<Laid>) {
    let is_comment = matches!(statement.kind, Kind::Comment);
    match &statement.kind {
        Kind::Blank => {
            if lines.last().is_some_and(|last| !last.is_blank()) {
                lines.push(Laid::blank());
            }
            return;
        }
        Kind::Decision(decision) => {
            lines.push(Laid {
                text: decisions::decision_text(decision),
                is_comment: false,
            });
            return;
        }
        Kind::Section(_) | Kind::Part(..) => blank_before_head(lines),
        _ => {}
    }
    for (nth, line) in statement.lines.iter().enumerate() {
        let text = match statement.problem {
            Some(_) => document
                .text
                .get(line.start..line.end)
                .unwrap_or_default()
                .to_owned(),
            None => laid(document, statement, line, nth),
        };
        lines.push(Laid { text, is_comment });
    }
}

/// A head has a blank line before it, and before the comment above it.
fn blank_before_head(lines: &mut Vec<Laid>) {
    let comments = lines
        .iter()
        .rev()
        .take_while(|line| line.is_comment)
        .count();
    let at = lines.len() - comments;
    let before = at.checked_sub(1).and_then(|before| lines.get(before));
    if before.is_some_and(|before| !before.is_blank()) {
        lines.insert(at, Laid::blank());
    }
}

fn laid(document: &Document<'_>, statement: &Statement, line: &Line, nth: usize) -> String {
    let mut text = match nth {
        0 => String::new(),
        _ => "    ".to_owned(),
    };
    let mut before: Option<Token> = None;
    for (at, token) in line.tokens.iter().enumerate() {
        if let Some(before) = before
            && is_apart(
                document,
                statement,
                before,
                *token,
                line.tokens.get(at.wrapping_sub(2)),
            )
        {
            text.push(' ');
        }
        match leading_word(statement).filter(|_| nth == 0 && at == 0) {
            Some(word) => text.push_str(word),
            None => text.push_str(token.text(document.text)),
        }
        before = Some(*token);
    }
    if let Some(comment) = line.comment {
        if before.is_some() {
            text.push_str("  ");
        }
        text.push_str(comment.text(document.text).trim_end());
    }
    text
}

/// The word that begins the statement, as it is to be written.
fn leading_word(statement: &Statement) -> Option<&'static str> {
    Some(match &statement.kind {
        Kind::List(word, _) => word.text(),
        Kind::Section(section) => section.text(),
        Kind::Grafcet(_) => GRAFCET,
        Kind::Part(_, kind) => match kind {
            PartKind::Partial => PartWord::Partial,
            PartKind::Expansion { .. } => PartWord::Expansion,
            PartKind::Reusable { .. } => PartWord::Reusable,
        }
        .text(),
        _ => return None,
    })
}

/// Whether a blank stands between two tokens, where `earlier` is the token
/// before both.
fn is_apart(
    document: &Document<'_>,
    statement: &Statement,
    before: Token,
    after: Token,
    earlier: Option<&Token>,
) -> bool {
    use TokenKind as T;
    let in_list = matches!(statement.kind, Kind::List(..));
    let is_operand = |kind| matches!(kind, T::Name | T::Quoted | T::Number | T::Close);
    match (before.kind, after.kind) {
        // Two would begin a comment.
        (T::Slash, T::Slash) => true,
        // A state: `Seq=10`.
        (T::Equal, _) | (_, T::Equal) if in_list => false,
        (T::Minus, _) if in_list => false,
        (_, T::Colon | T::Comma | T::Close | T::CloseBrace | T::Star) => false,
        (T::Star | T::Slash | T::At | T::Open | T::OpenBrace | T::Caret, _) => false,
        (T::Name, T::Open) => before.text(document.text).eq_ignore_ascii_case("on"),
        (T::Quoted, T::Open) | (_, T::OpenBrace) => false,
        (T::Time, T::Slash) => false,
        // A sign, not an operator: nothing stands before it that it could
        // subtract from.
        (T::Minus, _) => earlier.is_some_and(|earlier| is_operand(earlier.kind)),
        _ => true,
    }
}
