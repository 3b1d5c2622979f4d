//! Renaming in a ladder.

use std::collections::BTreeMap;

use ::ladder::Format;
use logic::Name;
use source::{Edit, Span};

use super::written::{
    Variable, is_part_of, is_same, pieces, renamed, variable_called, within_quotes,
};
use super::{Refusal, leftover, same};
use crate::completion::spell;
use crate::{Ladder, Mention, Usage, edited, statement};

/// The variable at the byte `offset`, and the bytes that name it there.
pub(super) fn at(ladder: &Ladder, offset: usize) -> Option<Result<(Variable, Span), Refusal>> {
    let format = ladder.program().format;
    let mention = ladder.names().at(offset)?;
    let text = ladder.text.get(mention.span.range())?;
    let start = mention.span.range().start;
    let touches =
        |it: &std::ops::Range<usize>| Span::new(start + it.start, start + it.end).touches(offset);
    let piece = pieces(format, text).into_iter().find(touches);
    let Some(piece) = piece else {
        return Some(Err(Refusal(
            "what stands here is a value, an address or a part of something else, and has no \
             name of its own"
                .to_owned(),
        )));
    };
    let written = &text[piece.clone()];
    // The name of the whole place, or of one variable in a term.
    let whole = &*mention.name;
    let name = match mention.usage {
        Usage::Declared => whole,
        _ if pieces(format, text).len() == 1 => whole,
        _ => written,
    };
    let variable = match variable_called(ladder, name)? {
        Ok(variable) => variable,
        Err(refusal) => return Some(Err(refusal)),
    };
    let is_spelled = is_same(format, written, &variable.local)
        || is_part_of(&written.to_lowercase(), &variable.local.to_lowercase());
    if !is_spelled {
        let message = format!(
            "`{written}` is another spelling of `{}`; rename it where that name stands",
            variable.name
        );
        return Some(Err(Refusal(message)));
    }
    let from = start + piece.start;
    Some(Ok((
        variable.clone(),
        Span::new(from, from + variable.local.len()),
    )))
}

/// The edits that rename a variable, and its new name in the program.
pub(super) fn rename(
    ladder: &Ladder,
    variable: &Variable,
    new: &str,
) -> Result<(Vec<Edit>, Name), Refusal> {
    let format = ladder.program().format;
    is_free(ladder, variable, new)?;
    let mut edits: BTreeMap<Span, Edit> = BTreeMap::new();
    for mention in ladder.names().all() {
        for span in places(ladder, variable, mention) {
            let text = match format {
                Format::Ladder => respelled(ladder, span, variable, new),
                _ => Edit {
                    span,
                    text: new.to_owned(),
                },
            };
            edits.insert(text.span, text);
        }
    }
    let edits: Vec<Edit> = edits.into_values().collect();
    let text = edited(&ladder.text, &edits);
    // In other letters, where those are the same, the name is everywhere still.
    let is_other = !is_same(format, new, &variable.local);
    if is_other && let Some(line) = leftover::line_of(ladder, &edits, &text, &variable.local) {
        return Err(Refusal(format!(
            "`{}` also stands in line {line}, where it cannot be renamed safely",
            variable.local
        )));
    }
    let again = ::ladder::read(text.as_bytes());
    // Scopes stay before the name, as far as the name needs them still.
    let scope = variable.name.strip_suffix(&*variable.local);
    let with_scope = format!("{}{new}", scope.unwrap_or_default());
    let mut names = vec![Name::from(with_scope.as_str())];
    if with_scope != new {
        names.push(new.into());
    }
    let mut difference = None;
    for name in names {
        match same::up_to_name(ladder, &again, &variable.name, &name) {
            Ok(()) => return Ok((edits, name)),
            Err(place) => difference = difference.or(Some(place)),
        }
    }
    let place = difference.unwrap_or_else(|| "the program".to_owned());
    Err(Refusal(format!(
        "`{}` cannot be renamed here: {place} would say something else, as the name also stands \
         where it cannot be edited, or `{new}` means something there",
        variable.local
    )))
}

/// Refuses a name that the ladder has already.
fn is_free(ladder: &Ladder, variable: &Variable, new: &str) -> Result<(), Refusal> {
    let format = ladder.program().format;
    let is_new = |name: &str| {
        let local = is_same(format, name, new);
        local
            || is_part_of(&name.to_lowercase(), &new.to_lowercase())
                && !is_same(format, new, &variable.local)
    };
    let own = |name: &str| name == &*variable.name || is_part_of(name, &variable.name);
    let all = ladder.names().all().iter();
    if let Some(taken) = all
        .map(|it| &it.name)
        .find(|name| is_new(name) && !own(name))
    {
        return Err(Refusal(format!("the ladder has a `{taken}` already")));
    }
    let is_whole = |it: &&Mention| is_part_of(new, &it.name) && !own(&it.name);
    match ladder.names().all().iter().find(is_whole) {
        Some(whole) => Err(Refusal(format!(
            "`{new}` would be a part of `{}`, which the ladder has",
            whole.name
        ))),
        None => Ok(()),
    }
}

/// The bytes at a place that name the variable, with the quotes around them.
fn places(ladder: &Ladder, variable: &Variable, mention: &Mention) -> Vec<Span> {
    let format = ladder.program().format;
    let (span, text) = match declared_at(ladder, variable, mention) {
        Some(declared) => declared,
        None => {
            let text = ladder.text.get(mention.span.range()).unwrap_or_default();
            (mention.span, text)
        }
    };
    let speaks =
        renamed(format, &mention.name, Some(text), &variable.name, "\u{0}") != *mention.name;
    if !speaks
        || mention.usage == Usage::Declared
            && !is_same(format, text.trim_matches('"'), &variable.local)
    {
        return Vec::new();
    }
    let start = span.range().start;
    let is_it = |written: &str| match format {
        Format::Ladder => written == variable.local || is_part_of(written, &variable.local),
        _ => is_same(format, written, &variable.local),
    };
    pieces(format, text)
        .into_iter()
        .filter(|piece| is_it(&text[piece.clone()]))
        .map(|piece| {
            let is_quoted =
                text[..piece.start].ends_with('"') && text[piece.end..].starts_with('"');
            let quote = usize::from(is_quoted && format == Format::Ladder);
            Span::new(start + piece.start - quote, start + piece.end + quote)
        })
        .collect()
}

/// The token of a declaration in rung notation that names what it declares.
fn declared_at<'l>(
    ladder: &'l Ladder,
    variable: &Variable,
    mention: &Mention,
) -> Option<(Span, &'l str)> {
    let is_it = mention.usage == Usage::Declared && mention.name == variable.name;
    if !is_it || ladder.program().format != Format::Ladder {
        return None;
    }
    let whole = statement::line(&ladder.text, mention.span.range().start);
    let tokens = statement::code(&ladder.text, whole);
    let name = tokens
        .get(1)
        .filter(|it| it.name(&ladder.text) == variable.local)?;
    Some((name.span, name.text(&ladder.text)))
}

/// The edit of a token of rung notation, in quotes where it needs them.
fn respelled(ladder: &Ladder, span: Span, variable: &Variable, new: &str) -> Edit {
    let text = &ladder.text[span.range()];
    let inner = within_quotes(text, Span::new(0, text.len())).range();
    let rest = &text[inner][variable.local.len()..];
    Edit {
        span,
        text: spell(&format!("{new}{rest}")),
    }
}
