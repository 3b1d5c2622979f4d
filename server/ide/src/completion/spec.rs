//! What can be typed in the rule text of a grafcet.

use grafcet::Role;
use logic::Budget;
use logic::notation::{Token, TokenKind};
use recovery::successions::Evidence;

use super::decision::decision_before;
use super::variables::Wanted;
use super::{Completion, CompletionKind, Completions};
use crate::section::{Section, section};
use crate::statement::{self, Typed, boundary, code};
use crate::{Ladder, Spec, next};

/// What can be typed at the byte `offset` of a rule text, best first; decisions
/// of weaker evidence than `weakest` are left out.
pub fn complete_in_spec(
    spec: &Spec,
    ladder: Option<&Ladder>,
    offset: usize,
    weakest: Evidence,
    budget: &Budget,
) -> Option<Completions> {
    let asked = Asked {
        spec,
        ladder,
        weakest,
        budget,
    };
    let text = &*spec.text;
    let offset = boundary(text, offset);
    let line = statement::line(text, offset);
    if let Some(comment) = decision_before(text, offset) {
        return Some(asked.in_decision(comment, offset));
    }
    let typed = Typed::at(text, offset);
    if typed.in_comment {
        return None;
    }
    let word_start = typed.span.range().start;
    let begins = text.get(line.start..word_start)?;
    let is_at_line_begin = begins.trim_start_matches('\u{feff}').trim().is_empty();
    let statement = statement::in_spec(text, offset);
    let before = code(text, statement.start..word_start.max(statement.start));
    let section = section(text, statement.start);
    let mut items = Vec::new();
    if before.is_empty() && is_at_line_begin && !typed.quoted {
        items.extend(asked.lines(section));
        items.extend(asked.labels(section));
        items.extend(words());
    } else {
        items.extend(asked.in_statement(&before, section));
    }
    Some(Completions {
        span: typed.span,
        items,
    })
}

/// Words that begin a line, with what follows them and what they mean.
const WORDS: [(&str, &str, &str); 18] = [
    (
        "Step",
        " ${1:X1} for ${2:state}",
        "declares steps, with the states they stand for",
    ),
    ("Transition", " ${1:t1}", "declares transitions"),
    (
        "Input",
        " ${1:name}",
        "declares what is read from the plant",
    ),
    (
        "Output",
        " ${1:name}",
        "declares what is written to the plant",
    ),
    ("Internal", " ${1:name}", "declares what is kept inside"),
    ("Marking", " ${1:X1}", "the steps of the initial situation"),
    ("Transitions:", "", "rules of transitions follow"),
    ("Steps:", "", "rules of actions follow"),
    ("Environment:", "", "rules of what the plant can do follow"),
    ("Never:", "", "what must never hold follows"),
    ("Macro", " ${1:M1}(${2:expansion})", "declares a macro-step"),
    (
        "Enclosing",
        " ${1:X1}(${2:part})",
        "declares an enclosing step",
    ),
    (
        "Activation",
        " ${1:X1}",
        "steps that an enclosing step activates",
    ),
    ("Partial", " ${1:G1}", "begins a partial grafcet"),
    (
        "Expansion",
        " ${1:E1}(${2:entry}, ${3:exit})",
        "begins the expansion of a macro-step",
    ),
    (
        "Reusable",
        " ${1:R1}(${2:parameter})",
        "begins a reusable grafcet",
    ),
    (
        "Instance",
        " ${1:r1} of ${2:R1}",
        "a copy of a reusable grafcet that runs",
    ),
    ("Grafcet", " ${1:Name}", "names the grafcet"),
];

fn words() -> impl Iterator<Item = Completion> {
    WORDS
        .iter()
        .map(|(word, form, detail)| match form.is_empty() {
            true => Completion::word(word, detail),
            false => Completion::word(word, detail).snippet(format!("{word}{form}")),
        })
}

/// What is asked about, and by which measure.
pub(super) struct Asked<'a> {
    /// The spec.
    pub(super) spec: &'a Spec,
    /// The ladder beside it.
    pub(super) ladder: Option<&'a Ladder>,
    /// The weakest evidence that counts.
    pub(super) weakest: Evidence,
    /// What answering may cost.
    pub(super) budget: &'a Budget,
}

impl Asked<'_> {
    /// Whole lines that fit a section.
    pub(super) fn lines(&self, section: Section) -> Vec<Completion> {
        let Some(ladder) = self.ladder else {
            return Vec::new();
        };
        let lines = next(self.spec, ladder, self.weakest, self.budget).into_iter();
        let line = |it: crate::Next| Completion {
            documentation: Some(it.reason),
            ..Completion::new(it.line, CompletionKind::Line, it.evidence)
        };
        lines.filter(|it| it.fits(section)).map(line).collect()
    }

    /// Labels with which a rule of the section begins: transitions that have no
    /// rule yet, steps.
    fn labels(&self, section: Section) -> Vec<Completion> {
        let behind_colon = |it: Completion| {
            let insert = format!("{}: ", it.insert);
            it.insert(insert)
        };
        match section {
            Section::Transitions => {
                let places = &self.spec.reading.places;
                let labels = self.named(Role::Transition, CompletionKind::Label);
                let is_free = |it: &Completion| places.transition(&it.label).is_none();
                labels
                    .into_iter()
                    .filter(is_free)
                    .map(behind_colon)
                    .collect()
            }
            Section::Steps => self.steps().into_iter().map(behind_colon).collect(),
            _ => Vec::new(),
        }
    }

    fn in_statement(&self, before: &[Token], section: Section) -> Vec<Completion> {
        let text = &*self.spec.text;
        let Some((first, rest)) = before.split_first() else {
            return Vec::new();
        };
        if rest
            .first()
            .is_some_and(|token| token.kind == TokenKind::Colon)
        {
            return self.in_rule(&rest[1..], section);
        }
        let last = before
            .last()
            .map(|token| token.text(text))
            .unwrap_or_default();
        let begins_name = rest.is_empty() || last == ",";
        match first.text(text).to_ascii_lowercase().as_str() {
            "step" | "macro" | "enclosing" if last == "for" => self.states(),
            "macro" | "enclosing" if last == "(" => self.named(Role::Part, CompletionKind::Routine),
            "step" if !begins_name => vec![Completion::word("for", "the state it stands for")],
            "input" | "output" | "internal" if begins_name => {
                let known = self.known();
                let mut items = self.of_ladder(if first.text(text).eq_ignore_ascii_case("input") {
                    Wanted::Read
                } else {
                    Wanted::Written
                });
                items.retain(|it| !known.contains(it.label.as_str()));
                items
            }
            "marking" | "activation" if begins_name => self.steps(),
            "instance" if last == "of" => self.named(Role::Part, CompletionKind::Routine),
            "instance" if rest.len() == 1 => vec![Completion::word("of", "what it is a copy of")],
            _ => Vec::new(),
        }
    }

    /// Behind the colon of a rule.
    fn in_rule(&self, before: &[Token], section: Section) -> Vec<Completion> {
        let yields = before
            .iter()
            .position(|token| token.kind == TokenKind::Yields);
        let kind = before.last().map(|token| token.kind);
        let follows_name = statement::ends_operand(kind);
        let values = || {
            let mut items = self.steps();
            items.extend(self.values());
            items
        };
        match (section, yields) {
            (Section::Transitions, Some(_)) => match kind {
                Some(TokenKind::At) => self.steps(),
                Some(TokenKind::Yields | TokenKind::Star) => {
                    let marked = |it: Completion| {
                        let insert = format!("@{}", it.insert);
                        Completion {
                            label: insert.clone(),
                            ..it.insert(insert)
                        }
                    };
                    self.steps().into_iter().map(marked).collect()
                }
                _ => Vec::new(),
            },
            (Section::Steps, Some(at)) => self.in_action(&before[at + 1..]),
            (Section::Declarations, _) => Vec::new(),
            (Section::Never, Some(_)) => Vec::new(),
            _ if follows_name => Vec::new(),
            (Section::Transitions, None) if before.is_empty() => values(),
            _ => {
                let mut items = self.values();
                items.extend(self.steps());
                items
            }
        }
    }

    /// What an action does.
    fn in_action(&self, before: &[Token]) -> Vec<Completion> {
        let text = &*self.spec.text;
        let words: Vec<&str> = before.iter().map(|token| token.text(text)).collect();
        match words.as_slice() {
            [] => {
                let mut items = self.outputs();
                items.push(Completion::word("set", "writes 1, which stays").insert("set "));
                items.push(Completion::word("reset", "writes 0, which stays").insert("reset "));
                items.push(
                    Completion::word("force", "forces a partial grafcet")
                        .insert("force ")
                        .snippet("force ${1:G1}{${2:X1}}"),
                );
                items
            }
            ["set" | "reset"] => self.outputs(),
            ["force"] => self.named(Role::Part, CompletionKind::Routine),
            [.., "on"] => {
                let mut items = vec![
                    Completion::word("activation", "when the step becomes active"),
                    Completion::word("deactivation", "when the step ends"),
                ];
                items.extend(self.values());
                items
            }
            ["set" | "reset", _] => vec![Completion::word("on", "an event follows").insert("on ")],
            [.., "after" | "until"] => Vec::new(),
            [_] | [_, "after" | "until", _] => vec![
                Completion::word("after", "a delay follows").insert("after "),
                Completion::word("until", "a limit follows").insert("until "),
            ],
            _ => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests;
