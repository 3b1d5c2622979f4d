//! What can be typed in a scenario.

use logic::notation::{Token, TokenKind};
use source::Span;

use super::variables::{Wanted, variables};
use super::{Completion, CompletionKind, Completions};
use crate::Scenario;
use crate::navigate::Pair;
use crate::statement::{self, Typed, boundary, code};

/// Words that begin a line of the head, with what follows them and what they
/// mean.
const HEAD: [(&str, &str, &str); 4] = [
    ("scenario", " \"${1:Filling}\"", "the title"),
    ("for", " ${1:tank.ladder}", "what it runs on"),
    ("timing", " ${1:settled}", "when a step is over"),
    ("cycle", " ${1:100ms}", "the time from scan to scan"),
];

/// What can be done in a step.
const DONE: [(&str, &str, &str); 4] = [
    ("on", " ${1:input}", "an input goes on"),
    ("off", " ${1:input}", "an input goes off"),
    ("wait", " ${1:5s}", "scans until the time has passed"),
    ("scan", " ${1:3}", "so many scans"),
];

/// What can be typed at the byte `offset` of a scenario, best first. `files` are
/// those that it may run on.
pub fn complete_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    files: &[String],
    offset: usize,
) -> Option<Completions> {
    let text = &*scenario.text;
    let offset = boundary(text, offset);
    let line = statement::line(text, offset);
    let typed = Typed::at(text, offset);
    if typed.in_comment {
        return None;
    }
    let word_start = typed.span.range().start.max(line.start);
    let before = code(text, line.start..word_start);
    let asked = Asked {
        text,
        pair,
        before: &before,
        quoted: typed.quoted,
    };
    let items = match asked.first_word() {
        None => asked.line(is_head(scenario, line.start)),
        Some("for") => files.iter().map(|file| of_file(file)).collect(),
        Some("timing") => vec![
            Completion::word("scan", "a step lasts as long as it says"),
            Completion::word("settled", "a step lasts until nothing changes"),
        ],
        Some("cycle") => times(&["10ms", "100ms", "1s"]),
        Some("scenario") => Vec::new(),
        Some(_) => asked.in_step(),
    };
    Some(Completions {
        span: typed.span,
        items,
    })
}

/// Whether no step stands before the byte `line`.
fn is_head(scenario: &Scenario, line: usize) -> bool {
    let mut steps = scenario.steps().iter();
    steps.next().is_none_or(|it| line <= it.span.range().start)
}

struct Asked<'a> {
    text: &'a str,
    pair: Pair<'a>,
    /// The tokens of the line before the word that is typed.
    before: &'a [Token],
    quoted: bool,
}

impl Asked<'_> {
    fn first_word(&self) -> Option<&str> {
        self.before.first().map(|token| token.text(self.text))
    }

    fn line(&self, is_head: bool) -> Vec<Completion> {
        let mut items = Vec::new();
        if !self.quoted {
            items.extend(DONE.iter().map(worded));
            if is_head {
                items.extend(HEAD.iter().map(worded));
            }
        }
        items.extend(self.driven());
        items
    }

    fn in_step(&self) -> Vec<Completion> {
        let is_arrow = |token: &Token| token.kind == TokenKind::DoubleArrow;
        let expects = self.before.iter().any(is_arrow);
        let Some(last) = self.before.last() else {
            return Vec::new();
        };
        let word = last.text(self.text);
        match last.kind {
            TokenKind::Name if matches!(word, "on" | "off") && expects => self.expected(),
            TokenKind::Name if matches!(word, "on" | "off") => self.driven(),
            TokenKind::Name if word == "wait" => times(&["1s", "5s", "100ms"]),
            TokenKind::Name if word == "only" => self.expectations(),
            TokenKind::DoubleArrow => {
                let mut items = self.expectations();
                if !self.quoted {
                    let only = Completion::word("only", "no other output may have changed");
                    items.insert(0, only);
                }
                items
            }
            TokenKind::Comma if expects => self.expectations(),
            TokenKind::Comma => self.line(false),
            _ if self.quoted || expects => Vec::new(),
            _ => vec![Completion::word("=>", "what must hold after it follows")],
        }
    }

    fn expectations(&self) -> Vec<Completion> {
        let mut items = Vec::new();
        if !self.quoted {
            items.extend(
                [("on", "it must be on"), ("off", "it must be off")]
                    .map(|(word, detail)| Completion::word(word, detail)),
            );
        }
        items.extend(self.expected());
        items
    }

    /// What can be given a value: inputs first.
    fn driven(&self) -> Vec<Completion> {
        match self.pair.ladder {
            Some(ladder) => variables(ladder, Wanted::Driven, Span::default(), spelled),
            None => self.of_spec(|grafcet| grafcet.inputs.iter().chain(&[])),
        }
    }

    /// What can be expected: outputs first, then steps.
    fn expected(&self) -> Vec<Completion> {
        let mut items = match self.pair.ladder {
            Some(ladder) => variables(ladder, Wanted::Expected, Span::default(), spelled),
            None => self.of_spec(|grafcet| grafcet.outputs.iter().chain(&grafcet.internals)),
        };
        let steps = self.pair.spec.into_iter();
        items.extend(
            steps
                .flat_map(|spec| spec.reading.spec.grafcet.steps())
                .map(|step| {
                    let detail = match &step.state {
                        Some(state) => format!("step for {state}"),
                        None => "step".to_owned(),
                    };
                    Completion::new(&*step.name, CompletionKind::Step, detail)
                        .insert(spelled(&step.name))
                }),
        );
        items
    }

    fn of_spec<'v, I>(&'v self, wanted: impl Fn(&'v grafcet::Grafcet) -> I) -> Vec<Completion>
    where
        I: Iterator<Item = &'v grafcet::Variable>,
    {
        let grafcet = self.pair.spec.map(|spec| &spec.reading.spec.grafcet);
        let all = grafcet.into_iter().flat_map(wanted);
        let variable = |it: &grafcet::Variable| {
            let comment = it.comment.as_deref().unwrap_or_default();
            Completion::new(&*it.name, CompletionKind::Variable, comment).insert(spelled(&it.name))
        };
        all.map(variable).collect()
    }
}

fn spelled(name: &str) -> String {
    ::scenario::spelled(name)
}

fn worded((word, rest, detail): &(&str, &str, &str)) -> Completion {
    Completion::word(word, detail).snippet(format!("{word}{rest}"))
}

fn of_file(name: &str) -> Completion {
    Completion::new(name, CompletionKind::File, "").insert(logic::notation::quoted(name))
}

fn times(all: &[&str]) -> Vec<Completion> {
    let time = |it: &&str| Completion::new(*it, CompletionKind::Constant, "a time");
    all.iter().map(time).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::tests_of_runs::{LADDER, SPEC, Tank};

    /// What can be put in at `$0`, and what it replaces.
    fn offered(ladder: &str, text: &str) -> (Vec<String>, String) {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let tank = Tank::new(ladder, SPEC, &text);
        let files = ["tank.ladder".to_owned(), "line 3.L5X".to_owned()];
        match complete_in_scenario(&tank.scenario, tank.pair(), &files, offset) {
            Some(found) => (
                found.items.iter().map(|it| it.insert.clone()).collect(),
                text[found.span.range()].to_owned(),
            ),
            None => (Vec::new(), String::new()),
        }
    }

    #[track_caller]
    fn check(text: &str, items: &[&str], typed: &str) {
        let (offered, replaced) = offered(LADDER, text);
        assert_eq!((offered.join(" "), &*replaced), (items.join(" "), typed));
    }

    #[test]
    fn inputs_are_driven_and_outputs_expected() {
        check("on $0", &["s", "ls2", "v1"], "");
        check("on s, off l$0 => on v1", &["s", "ls2", "v1"], "l");
        check("on s => on $0", &["v1", "s", "ls2", "X0", "Xv1"], "");
        check(
            "on s => off v1, off \"X$0",
            &["v1", "s", "ls2", "X0", "Xv1"],
            "\"X",
        );
    }

    #[test]
    fn words_come_where_they_mean_something() {
        check(
            "$0",
            &[
                "on", "off", "wait", "scan", "scenario", "for", "timing", "cycle", "s", "ls2", "v1",
            ],
            "",
        );
        check(
            "on s\n$0",
            &["on", "off", "wait", "scan", "s", "ls2", "v1"],
            "",
        );
        check(
            "on s, $0",
            &["on", "off", "wait", "scan", "s", "ls2", "v1"],
            "",
        );
        check(
            "on s => $0",
            &["only", "on", "off", "v1", "s", "ls2", "X0", "Xv1"],
            "",
        );
        check(
            "on s => only o$0",
            &["on", "off", "v1", "s", "ls2", "X0", "Xv1"],
            "o",
        );
        check("on s $0", &["=>"], "");
        check("on s => on v1 $0", &[], "");
        check("wait $0", &["1s", "5s", "100ms"], "");
        check("timing s$0", &["scan", "settled"], "s");
        check("for $0", &["tank.ladder", "\"line 3.L5X\""], "");
        check("on s // on $0", &[], "");
    }

    #[test]
    fn without_a_ladder_the_spec_has_the_names() {
        assert_eq!(offered("", "on $0").0, ["s", "ls2"]);
        assert_eq!(offered("", "on s => on $0").0, ["v1", "X0", "Xv1"]);
    }
}
