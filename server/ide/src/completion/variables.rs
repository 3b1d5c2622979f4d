//! The variables of a ladder, as they can be typed.

use std::collections::BTreeMap;

use ::ladder::{Class, Declaration, ElementKind, Format};
use logic::Name;
use logic::notation::{Lexer, TokenKind, is_literal};
use source::Span;

use super::{Completion, CompletionKind};
use crate::{Ladder, Usage};

/// What the variable is wanted for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    /// To be read.
    Read,
    /// To be written.
    Written,
    /// To be declared: those that are not.
    Undeclared,
    /// To be given a value in a scenario.
    Driven,
    /// To be looked at in a scenario.
    Expected,
}

/// A variable of a ladder.
struct Variable<'l> {
    name: &'l Name,
    declaration: Option<&'l Declaration>,
    written: bool,
    /// Where it comes first in the text.
    place: u32,
}

/// The variables of a ladder in the order in which they are likely wanted. A
/// name is inserted as `spell` writes it; one that stands only in the bytes
/// `typed` is not yet one.
pub(super) fn variables(
    ladder: &Ladder,
    wanted: Wanted,
    typed: Span,
    spell: fn(&str) -> String,
) -> Vec<Completion> {
    let mut all = collected(ladder, typed);
    all.retain(|it| match wanted {
        Wanted::Read | Wanted::Driven | Wanted::Expected => true,
        Wanted::Written => it.declaration.is_none_or(|it| it.class != Class::Constant),
        Wanted::Undeclared => it.declaration.is_none() && !it.name.contains('.'),
    });
    all.sort_by_key(|it| (rank(it, wanted), it.place));
    all.iter().map(|it| completion(it, spell)).collect()
}

fn collected(ladder: &Ladder, typed: Span) -> Vec<Variable<'_>> {
    let program = ladder.program();
    let mut all: BTreeMap<&Name, Variable<'_>> = BTreeMap::new();
    for mention in ladder.names().all() {
        let is_typed = typed.start <= mention.span.start && mention.span.end <= typed.end;
        if mention.usage != Usage::Declared
            && (is_typed || !is_name(ladder, mention.span, &mention.name))
        {
            continue;
        }
        let variable = all.entry(&mention.name).or_insert_with(|| Variable {
            name: &mention.name,
            declaration: program.declarations.find(&mention.name),
            written: false,
            place: mention.span.start,
        });
        variable.written |= mention.usage == Usage::Written;
    }
    for (_, rung) in program.rungs() {
        for (_, element) in rung.network.elements() {
            let output = match &element.kind {
                ElementKind::Timer(timer) => &timer.output,
                ElementKind::Counter(counter) => &counter.output,
                _ => continue,
            };
            all.entry(output).or_insert_with(|| Variable {
                name: output,
                declaration: None,
                written: true,
                // Behind its instance.
                place: rung.place(element.within).end,
            });
        }
    }
    all.into_values().collect()
}

/// Whether an operand is a variable and not a number or a term.
fn is_name(ladder: &Ladder, span: Span, name: &str) -> bool {
    if ladder.program().format != Format::Ladder {
        let is_part = |c: char| c.is_alphanumeric() || "_.:[]\\".contains(c);
        let begins = name.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '\\');
        return begins && name.chars().all(is_part);
    }
    let written = ladder.text.get(span.range()).unwrap_or_default();
    let token = Lexer::new(written).peek();
    let whole = token.is_some_and(|token| {
        matches!(token.kind, TokenKind::Name | TokenKind::Quoted)
            && token.span.len() == written.len()
    });
    whole && !is_literal(name)
}

/// For a scenario what is driven are inputs, and what is expected outputs. For a condition inputs and states come first, for a coil outputs that no
/// other coil writes.
fn rank(it: &Variable<'_>, wanted: Wanted) -> u8 {
    let class = it.declaration.map_or(Class::Unknown, |it| it.class);
    match (wanted, class) {
        (Wanted::Undeclared, _) => 0,
        (Wanted::Driven, Class::Input | Class::InOut) => 0,
        (Wanted::Driven, _) if !it.written => 1,
        (Wanted::Driven, _) => 2,
        (Wanted::Expected, Class::Output | Class::InOut) => 0,
        (Wanted::Expected, Class::Input | Class::Constant) => 3,
        (Wanted::Expected, _) if it.written => 1,
        (Wanted::Expected, _) => 2,
        (Wanted::Written, Class::Output | Class::InOut) if !it.written => 0,
        (Wanted::Written, Class::Output | Class::InOut) => 1,
        (Wanted::Written, Class::Input) => 3,
        (Wanted::Written, _) => 2,
        (_, Class::Input | Class::InOut) => 0,
        (_, Class::Constant) => 3,
        (_, _) if it.written => 1,
        (_, _) => 2,
    }
}

fn completion(it: &Variable<'_>, spell: fn(&str) -> String) -> Completion {
    let kind = match it.declaration.map(|it| it.class) {
        Some(Class::Constant) => CompletionKind::Constant,
        _ => CompletionKind::Variable,
    };
    let mut detail: Vec<&str> = Vec::new();
    if let Some(declaration) = it.declaration {
        detail.extend(class_word(declaration.class));
        detail.extend(declaration.address.as_deref());
        detail.extend(declaration.data_type.as_deref());
        detail.extend(declaration.description.as_deref().map(first_line));
    }
    Completion {
        variable: Some(it.name.clone()),
        ..Completion::new(&**it.name, kind, detail.join("  ")).insert(spell(it.name))
    }
}

fn class_word(class: Class) -> Option<&'static str> {
    match class {
        Class::Input => Some("input"),
        Class::Output => Some("output"),
        Class::InOut => Some("input and output"),
        Class::Internal => Some("internal"),
        Class::Constant => Some("constant"),
        Class::Unknown => None,
    }
}

fn first_line(text: &str) -> &str {
    text.trim().lines().next().unwrap_or_default()
}

/// The addresses that are declared, each with the name of its variable.
pub(super) fn addresses(ladder: &Ladder) -> impl Iterator<Item = Completion> {
    let all = ladder.program().declarations.iter();
    all.filter_map(|it| {
        let address = it
            .address
            .as_ref()
            .filter(|address| address.starts_with('%'))?;
        Some(Completion {
            variable: Some(it.name.clone()),
            ..Completion::new(&**address, CompletionKind::Variable, &*it.name)
        })
    })
}
