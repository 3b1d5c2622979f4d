//! What can be typed in the rule text of a grafcet.

use std::collections::BTreeSet;

use grafcet::{Role, spelled, spelled_state};
use logic::notation::{Token, TokenKind};
use logic::{Budget, Name};
use recovery::successions::Evidence;
use source::Span;

use super::variables::{Wanted, variables};
use super::{Completion, CompletionKind, Completions};
use crate::next::{followers, why};
use crate::section::{Section, section};
use crate::statement::{self, Typed, boundary, code, tokens};
use crate::{Decided, Ladder, Spec, next};

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

/// The comment of a decision line in which a caret stands, behind its sign.
fn decision_before(text: &str, offset: usize) -> Option<Token> {
    let line = statement::line(text, offset);
    let tokens = tokens(text, line);
    let comment = tokens
        .first()
        .filter(|token| token.kind == TokenKind::Comment)?;
    let is_inside = comment.span.range().start + SIGN.len() <= offset;
    (comment.text(text).starts_with(SIGN) && is_inside).then_some(*comment)
}

const SIGN: &str = "//!";

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

const VERDICTS: [(&str, &str); 5] = [
    ("accept", "the state follows, several together"),
    ("reject", "the state does not follow"),
    ("initial", "the sequence starts in the state"),
    ("keep", "the rule stays as it is, whatever the ladder gives"),
    ("end", "the branch of the state joins no other"),
];

/// What is asked about, and by which measure.
struct Asked<'a> {
    spec: &'a Spec,
    ladder: Option<&'a Ladder>,
    weakest: Evidence,
    budget: &'a Budget,
}

impl Asked<'_> {
    /// Whole lines that fit a section.
    fn lines(&self, section: Section) -> Vec<Completion> {
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
        let follows_name = matches!(
            kind,
            Some(
                TokenKind::Name
                    | TokenKind::Quoted
                    | TokenKind::Close
                    | TokenKind::Number
                    | TokenKind::Time
            )
        );
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

    /// Behind `//!`.
    fn in_decision(&self, comment: Token, offset: usize) -> Completions {
        let text = &*self.spec.text;
        let start = comment.span.range().start + SIGN.len();
        // What is typed stands in a comment of the text, and is code of its own.
        let inner = Typed::at(&text[start..comment.span.range().end], offset - start);
        let span = Span::new(
            start + inner.span.range().start,
            start + inner.span.range().end,
        );
        let before = code(text, start..span.range().start.max(start));
        let words: Vec<&str> = before.iter().map(|token| token.name(text)).collect();
        let items = match words.as_slice() {
            _ if inner.in_comment => Vec::new(),
            [] => return self.decisions(comment, offset),
            ["accept" | "reject"] => self.states(),
            ["accept" | "reject", _] => vec![Completion::word("->", "the state after it follows")],
            ["accept" | "reject", from, "->"] => self.after(from, &[]),
            ["accept", from, "->", to @ ..] if to.last() == Some(&"&") => self.after(from, to),
            ["initial" | "end"] => self.states(),
            ["keep"] => self.named(Role::Transition, CompletionKind::Label),
            _ => Vec::new(),
        };
        Completions { span, items }
    }

    /// Whole decisions, which replace the line so far, and the words that begin
    /// one.
    fn decisions(&self, comment: Token, offset: usize) -> Completions {
        let mut items = self.lines(Section::Declarations);
        let word = |(word, detail): &(&str, &str)| {
            Completion::word(word, detail).insert(format!("{SIGN} {word} "))
        };
        items.extend(VERDICTS.iter().map(word));
        let end = comment.span.range().end;
        Completions {
            span: Span::new(comment.span.range().start, end.max(offset)),
            items,
        }
    }

    /// States that may follow `from`, about which nothing is decided, those in
    /// `taken` left out; then all others.
    fn after(&self, from: &str, taken: &[&str]) -> Vec<Completion> {
        let Some(ladder) = self.ladder else {
            return Vec::new();
        };
        let decided = Decided::of(self.spec);
        let mut items = Vec::new();
        let mut seen: BTreeSet<&str> = taken.iter().copied().collect();
        for succession in followers(ladder, &decided, self.weakest) {
            if *succession.from != *from || !seen.insert(&succession.to) {
                continue;
            }
            items.push(Completion {
                documentation: Some(why(succession, ladder, self.budget)),
                ..Completion::new(
                    &*succession.to,
                    CompletionKind::State,
                    succession.evidence.word(),
                )
                .insert(spelled_state(&succession.to))
            });
        }
        let others = self.states().into_iter();
        items.extend(others.filter(|it| *it.label != *from && !seen.contains(it.label.as_str())));
        items
    }

    /// The states of the ladder.
    fn states(&self) -> Vec<Completion> {
        let Some(ladder) = self.ladder else {
            return Vec::new();
        };
        let analysis = &ladder.analysis;
        let values = analysis.registers.iter().flat_map(|register| {
            let states = register.states.iter();
            states.map(|it| (register.state_name(it.value), it.title.clone(), None))
        });
        let coils = analysis.states.states.iter().map(|state| {
            let name = state.name.clone();
            (name.clone(), analysis.description(&name), Some(name))
        });
        let state = |(name, title, variable): (Name, Option<Name>, Option<Name>)| Completion {
            variable,
            ..Completion::new(
                &*name,
                CompletionKind::State,
                title.as_deref().unwrap_or_default(),
            )
            .insert(spelled_state(&name))
        };
        coils.chain(values).map(state).collect()
    }

    fn steps(&self) -> Vec<Completion> {
        let steps = self.spec.reading.spec.grafcet.steps();
        let step = |it: &grafcet::Step| {
            let said = match (&it.state, &it.comment) {
                (Some(state), Some(comment)) => format!("for {state}  {comment}"),
                (Some(state), None) => format!("for {state}"),
                (None, comment) => comment.as_deref().unwrap_or_default().to_owned(),
            };
            Completion::new(&*it.name, CompletionKind::Step, said).insert(spelled(&it.name))
        };
        steps.map(step).collect()
    }

    /// Variables that are declared in the spec.
    fn declared<'v>(&self, all: impl Iterator<Item = &'v grafcet::Variable>) -> Vec<Completion> {
        let variable = |it: &grafcet::Variable| {
            let mut said: Vec<&str> = Vec::new();
            said.extend(it.address.as_deref());
            said.extend(it.comment.as_deref());
            Completion {
                variable: Some(it.name.clone()),
                ..Completion::new(&*it.name, CompletionKind::Variable, said.join("  "))
                    .insert(spelled(&it.name))
            }
        };
        all.map(variable).collect()
    }

    /// Variables that can be read: the spec's own, then the ladder's.
    fn values(&self) -> Vec<Completion> {
        let mut items = self.declared(self.spec.reading.spec.grafcet.variables());
        let known = self.known();
        let others = self.of_ladder(Wanted::Read).into_iter();
        items.extend(others.filter(|it| !known.contains(it.label.as_str())));
        items
    }

    fn outputs(&self) -> Vec<Completion> {
        let grafcet = &self.spec.reading.spec.grafcet;
        self.declared(grafcet.outputs.iter().chain(&grafcet.internals))
    }

    fn of_ladder(&self, wanted: Wanted) -> Vec<Completion> {
        let known = self.ladder.filter(|ladder| ladder.is_known());
        known.map_or(Vec::new(), |ladder| {
            variables(ladder, wanted, Span::default(), spelled)
        })
    }

    /// Names that the spec declares as variables or steps.
    fn known(&self) -> BTreeSet<&str> {
        let grafcet = &self.spec.reading.spec.grafcet;
        let variables = grafcet.variables().map(|it| &*it.name);
        variables
            .chain(grafcet.steps().map(|it| &*it.name))
            .collect()
    }

    /// What is declared in a role.
    fn named(&self, role: Role, kind: CompletionKind) -> Vec<Completion> {
        let mut seen = BTreeSet::new();
        let mentions = self.spec.reading.places.mentions.iter();
        mentions
            .filter(|it| it.role == role && seen.insert(&it.name))
            .map(|it| Completion::new(&*it.name, kind, "").insert(spelled(&it.name)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::completion::tests::in_spec;

    const TANK: &str = "\
input s %I0 // Start
input ls2
input ls3
output v1
output v2
rung: (s + v1) * /ls2 -> v1
rung: (v2 + ls2*/v1) * /ls3 -> v2
";

    const HEAD: &str = "\
Step X1 for v1 // Fill
Step \"my step\" for v2
Transition t1, t2
Input s
Output v1

Transitions:
t1: X1*s |- @\"my step\"
";

    #[track_caller]
    fn check(text: &str, replaced: &str, first: &[&str]) {
        let (found, typed) = in_spec(TANK, text);
        let found: Vec<&str> = found.iter().map(String::as_str).take(first.len()).collect();
        assert_eq!((found.as_slice(), &*typed), (first, replaced));
    }

    #[test]
    fn a_line_begins_with_what_is_open() {
        check("$0", "", &["//! accept v1 -> v2", "Step", "Transition"]);
        check(
            &format!("{HEAD}$0"),
            "",
            &["//! accept v1 -> v2", "t2: ", "Step"],
        );
    }

    #[test]
    fn a_decision_goes_on_with_what_may_follow() {
        check(
            "//! acc$0",
            "//! acc",
            &["//! accept v1 -> v2", "//! accept ", "//! reject "],
        );
        check("//! accept v1 -> $0", "", &["v2"]);
        check("//! accept $0", "", &["v1", "v2"]);
        check("//! accept v1$0", "v1", &["v1", "v2"]);
        check("//! initial v$0", "v", &["v1", "v2"]);
        check(&format!("{HEAD}//! keep $0"), "", &["t1", "t2"]);
        check("// accept $0", "", &[]);
    }

    #[test]
    fn a_step_stands_for_a_state() {
        check("Step X1 for $0", "", &["v1", "v2"]);
        check("Step X1 $0", "", &["for"]);
        check(&format!("{HEAD}\nMarking $0"), "", &["X1", "\"my step\""]);
    }

    #[test]
    fn an_input_is_one_that_is_not_declared_yet() {
        check("Input s, $0", "", &["ls2", "ls3", "v1"]);
        check("Input s\nInput $0", "", &["ls2", "ls3", "v1"]);
    }

    #[test]
    fn a_rule_leads_from_steps_to_steps() {
        check(
            &format!("{HEAD}t2: $0"),
            "",
            &["X1", "\"my step\"", "s", "v1", "ls2"],
        );
        check(&format!("{HEAD}t2: X1*$0"), "", &["s", "v1", "ls2"]);
        check(&format!("{HEAD}t2: X1 |- $0"), "", &["@X1", "@\"my step\""]);
        check(&format!("{HEAD}t2: X1 |- @$0"), "", &["X1", "\"my step\""]);
    }

    #[test]
    fn an_action_writes_an_output() {
        check(
            &format!("{HEAD}Steps:\n$0"),
            "",
            &["//! accept v1 -> v2", "X1: "],
        );
        check(
            &format!("{HEAD}Steps:\nX1: |- $0"),
            "",
            &["v1", "set ", "reset "],
        );
        check(
            &format!("{HEAD}Steps:\nX1: |- v1 $0"),
            "",
            &["after ", "until "],
        );
        check(
            &format!("{HEAD}Steps:\nX1: |- set v1 on $0"),
            "",
            &["activation", "deactivation"],
        );
    }
}
