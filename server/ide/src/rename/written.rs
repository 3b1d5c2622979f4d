//! How a variable is written at each of its places.
//!
//! A variable has one name in the program, but a text may write it in several
//! ways: with a member behind it (`t1.Q`), inside an index or a term, in other
//! letters, by its address, or without the scope that tells it from another.

use std::ops::Range;

use ::ladder::Format;
use logic::Name;
use logic::notation::{Lexer, TokenKind, is_literal};
use source::Span;

use super::Refusal;
use crate::{Ladder, Usage};

/// A variable that can be renamed.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// Its name in the program.
    pub(super) name: Name,
    /// The same as the text writes it: without the scope.
    pub(super) local: String,
}

/// Whether the format takes capital and small letters for the same.
pub(super) fn ignores_case(format: Format) -> bool {
    format != Format::Ladder
}

/// Whether two names are one in a format.
pub(super) fn is_same(format: Format, a: &str, b: &str) -> bool {
    match ignores_case(format) {
        true => a.to_lowercase() == b.to_lowercase(),
        false => a == b,
    }
}

/// Whether `name` is a member or an element of what is called `whole`.
pub(super) fn is_part_of(name: &str, whole: &str) -> bool {
    let rest = name.strip_prefix(whole);
    rest.is_some_and(|rest| rest.starts_with(['.', '[', '^']))
}

/// The variable called `name`, or of which that is a member or a value. `None`
/// if the ladder has none of that name.
pub(super) fn variable_called(ladder: &Ladder, name: &str) -> Option<Result<Variable, Refusal>> {
    let known = |name: &str| ladder.names().of(name).next().is_some();
    let register = name.split_once('=').map(|(register, _)| register);
    let name = register.filter(|_| !known(name)).unwrap_or(name);
    let root = root(ladder, name);
    if known(root) {
        return Some(variable(ladder, root));
    }
    // In an index, a name may stand in other letters.
    let format = ladder.program().format;
    let mut all = ladder.names().all().iter();
    let same = all.find(|it| ignores_case(format) && is_same(format, &it.name, root))?;
    Some(variable(ladder, &same.name))
}

/// The variable that a name belongs to: of `t1.Q` the timer `t1`, of a bit the
/// word, since what is a part of another thing cannot be called otherwise.
fn root<'n>(ladder: &Ladder, name: &'n str) -> &'n str {
    let wholes = name
        .match_indices(['.', '[', '^'])
        .map(|(at, _)| &name[..at]);
    let used = |it: &&str| !it.is_empty() && ladder.names().of(it).next().is_some();
    wholes.into_iter().find(used).unwrap_or(name)
}

fn variable(ladder: &Ladder, name: &str) -> Result<Variable, Refusal> {
    if name.starts_with('%') || is_literal(name) {
        return Err(Refusal(format!(
            "`{name}` is an address or a value, not a name"
        )));
    }
    match as_declared(ladder, name).or_else(|| as_whole(ladder, name)) {
        Some(local) => Ok(Variable {
            name: name.into(),
            local,
        }),
        None => Err(Refusal(format!(
            "`{name}` is never written by that name; rename it where it is declared"
        ))),
    }
}

/// How a text writes the variable where it stands alone; as it is declared,
/// where it is.
fn as_declared(ladder: &Ladder, name: &str) -> Option<String> {
    let format = ladder.program().format;
    let mut mentions: Vec<_> = ladder.names().of(name).collect();
    mentions.sort_by_key(|it| it.usage != Usage::Declared);
    let with_scope = |written: &str| {
        let scope = name.strip_suffix(written)?;
        scope.ends_with(['.', '/', ':']).then_some(())
    };
    mentions.into_iter().find_map(|mention| {
        let text = ladder.text.get(mention.span.range())?;
        let written = ladder.text.get(within_quotes(text, mention.span).range())?;
        let is_name = is_same(format, written, name) || with_scope(written).is_some();
        (is_name && !written.is_empty()).then(|| written.to_owned())
    })
}

/// How a text writes the variable where only parts of it stand.
fn as_whole(ladder: &Ladder, name: &str) -> Option<String> {
    let format = ladder.program().format;
    let all = ladder.names().all().iter();
    let mut parts = all.filter(|it| is_part_of(&it.name, name));
    parts.find_map(|it| {
        let text = ladder.text.get(it.span.range())?;
        let first = pieces(format, text).into_iter().next()?;
        let start = text[first].get(..name.len())?;
        is_same(format, start, name).then(|| start.to_owned())
    })
}

/// The bytes of a name without the quotes around it.
pub(super) fn within_quotes(text: &str, span: Span) -> Span {
    let range = span.range();
    match text.len() >= 2 && text.starts_with('"') && text.ends_with('"') {
        true => Span::new(range.start + 1, range.end - 1),
        false => span,
    }
}

/// The names with which paths begin in a piece of a program, quotes left out: of
/// `(a[i].x + ABS(b))` these are `a[i].x`'s `a`, `i` and `b`. In rung notation a
/// name is a whole token.
pub(super) fn pieces(format: Format, text: &str) -> Vec<Range<usize>> {
    if format != Format::Ladder {
        return paths(text);
    }
    let mut lexer = Lexer::new(text);
    let mut found = Vec::new();
    while let Some(token) = lexer.take() {
        let is_function =
            token.kind == TokenKind::Name && lexer.peek_kind() == Some(TokenKind::Open);
        if matches!(token.kind, TokenKind::Name | TokenKind::Quoted) && !is_function {
            found.push(within_quotes(token.text(text), token.span).range());
        }
    }
    found
}

/// The identifiers of a text that are no members, no parts of addresses and no
/// functions.
fn paths(text: &str) -> Vec<Range<usize>> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut before = None;
    let mut rest = text.char_indices().peekable();
    while let Some((start, c)) = rest.next() {
        if !is_part(c) {
            before = Some(c);
            continue;
        }
        let mut end = start + c.len_utf8();
        while let Some((at, c)) = rest.next_if(|(_, c)| is_part(*c)) {
            end = at + c.len_utf8();
        }
        let after = rest.peek().map(|(_, c)| *c);
        let begins = !matches!(before, Some('.' | ':' | '%' | '#' | '\\'));
        if begins && !c.is_ascii_digit() && !matches!(after, Some('(' | ':' | '#')) {
            found.push(start..end);
        }
        before = None;
    }
    found
}

/// A name or a term of the program, with the variable called `old` called `new`.
/// `written` is the text of the place, where it has one: what is one name there
/// is no term.
pub(super) fn renamed(
    format: Format,
    name: &str,
    written: Option<&str>,
    old: &str,
    new: &str,
) -> String {
    if name == old {
        return new.to_owned();
    }
    if is_part_of(name, old) && (format == Format::Ladder || !name.contains('[')) {
        return format!("{new}{}", &name[old.len()..]);
    }
    let is_one = |written: &str| {
        let token = Lexer::new(written).peek();
        token.is_some_and(|token| {
            token.span.len() == written.len()
                && matches!(token.kind, TokenKind::Name | TokenKind::Quoted)
        })
    };
    if format == Format::Ladder && written.is_none_or(is_one) {
        return name.to_owned();
    }
    let mut out = String::new();
    let mut done = 0;
    for piece in pieces(format, name) {
        let here = &name[piece.clone()];
        // A name with a scope before it is longer than the piece.
        let whole = &name[piece.start..];
        let is_old = match format {
            Format::Ladder => here == old || is_part_of(here, old),
            _ => {
                let behind = whole.strip_prefix(old);
                behind.is_some_and(|it| !it.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
            }
        };
        if is_old && piece.start >= done {
            out += &name[done..piece.start];
            out += new;
            done = piece.start + old.len();
        }
    }
    out + &name[done..]
}
