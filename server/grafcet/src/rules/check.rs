//! What there is to say about a text, beyond what it means.

use std::collections::{HashMap, HashSet};

use logic::Name;
use source::{Diagnostic, Edit, Span, codes};

use super::places::Scope;
use super::rewrite::{Room, room};
use super::spell;
use super::syntax::{Document, Item, Kind, Mark, Statement, Usage};
use super::words::{DECISION, Word};
use crate::{PartKind, Spec};

/// The findings about `document`, in the order of their places.
pub(crate) fn diagnostics(
    document: &Document<'_>,
    steps: &HashSet<Name>,
    spec: &Spec,
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for statement in &document.statements {
        found.extend(syntax(statement));
        found.extend(misplaced_decision(document, statement));
    }
    let declared = declared(document, &mut found);
    let scope = Scope::new(steps, spec);
    let mut rooms = Rooms::default();
    for statement in &document.statements {
        for mark in &statement.marks {
            found.extend(undeclared(
                document, statement, mark, &declared, &scope, &mut rooms,
            ));
        }
        instances(statement, spec, &mut found);
    }
    rules_of_transitions(document, &declared, &mut found);
    found.extend(no_initial_step(document, spec));
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}

fn syntax(statement: &Statement) -> Option<Diagnostic> {
    let problem = statement.problem.as_ref()?;
    if statement.tokens.is_empty() {
        let help = "write `//! accept a -> b`, `//! accept a -> b & c`, `//! reject a -> b`, \
                    `//! initial a`, `//! keep t1` or `//! end a`";
        let message = format!("decision not understood: {}", problem.message);
        let span = match problem.span.is_empty() {
            true => statement.span(),
            false => problem.span,
        };
        return Some(Diagnostic::new(codes::DECISION_SYNTAX, span, message).help(help));
    }
    let what = match (&statement.kind, statement.label()) {
        (Kind::List(word, _), _) => format!("{} list", word.text()),
        (_, Some(label)) => format!("rule {}", spell::name(label)),
        _ => "line".to_owned(),
    };
    let message = format!("{what} not understood: {}", problem.message);
    // An empty place cannot be seen: show the sign before it.
    let span = match problem.span.is_empty() {
        true => statement
            .tokens
            .last()
            .map_or(problem.span, |last| last.span),
        false => problem.span,
    };
    let help = match statement.section.filter(|_| statement.label().is_some()) {
        Some(section) => form_of(section),
        None => "docs/notation.md shows every form",
    };
    Some(Diagnostic::new(codes::SPEC_SYNTAX, span, message).help(help))
}

fn form_of(section: super::words::Section) -> &'static str {
    use super::words::Section;
    match section {
        Section::Transitions => "a transition is written `t1: p1*m |- @p2`",
        Section::Steps => "an action is written `p2: |- R`, `p2: m |- R` or `p2: |- set R`",
        Section::Environment => "an environment rule is written `e1: a |- b` or `e1: a |- @b`",
        Section::Never => "a property is written `n1: a*b`",
    }
}

/// A decision after a statement would go unheard.
fn misplaced_decision(document: &Document<'_>, statement: &Statement) -> Option<Diagnostic> {
    let comment = statement.trailing_comment()?;
    let misplaced =
        !statement.tokens.is_empty() && comment.text(document.text).starts_with(DECISION);
    misplaced.then(|| {
        let message = "a decision on the line of something else is a plain comment";
        Diagnostic::new(codes::DECISION_SYNTAX, comment.span, message)
            .help("give it a line of its own")
    })
}

/// The declared names with their places. Parameters are under their part.
#[derive(Default)]
struct Declared<'d> {
    global: HashMap<&'d Name, (Usage, Span)>,
    parameters: HashMap<&'d Name, HashMap<&'d Name, Span>>,
}

impl<'d> Declared<'d> {
    fn place(&self, name: &Name, part: Option<&Name>) -> Option<Span> {
        let parameters = part.and_then(|part| self.parameters.get(part));
        let parameter = parameters.and_then(|parameters| parameters.get(name));
        let global = self.global.get(name).map(|(_, span)| span);
        parameter.or(global).copied()
    }

    fn usage(&self, name: &Name) -> Option<Usage> {
        self.global.get(name).map(|(usage, _)| *usage)
    }
}

/// Collects the declarations, reporting every second one of a name.
fn declared<'d>(document: &'d Document<'_>, found: &mut Vec<Diagnostic>) -> Declared<'d> {
    let mut declared = Declared::default();
    let mut rules: HashMap<&Name, Span> = HashMap::new();
    for statement in &document.statements {
        for mark in &statement.marks {
            let first = match mark.usage {
                Usage::DeclaresParameter => {
                    let Some(part) = &statement.part else {
                        continue;
                    };
                    let parameters = declared.parameters.entry(part).or_default();
                    let first = parameters.get(&mark.name).copied();
                    parameters.entry(&mark.name).or_insert(mark.span);
                    first.or_else(|| declared.global.get(&mark.name).map(|(_, span)| *span))
                }
                Usage::Declares(_) | Usage::DeclaresPart | Usage::DeclaresRule => {
                    let first = declared.global.get(&mark.name).map(|(_, span)| *span);
                    let own = (mark.usage, mark.span);
                    declared.global.entry(&mark.name).or_insert(own);
                    first
                }
                Usage::Transition => {
                    let first = rules.get(&mark.name).copied();
                    rules.entry(&mark.name).or_insert(mark.span);
                    first
                }
                _ => None,
            };
            found.extend(first.map(|first| twice(mark, first)));
        }
    }
    declared
}

fn twice(mark: &Mark, first: Span) -> Diagnostic {
    let name = spell::name(&mark.name);
    let (message, help) = match mark.usage {
        Usage::Transition => (
            format!("transition {name} has a rule already; this one does not count"),
            "give it another label, or take one of the two out",
        ),
        _ => (
            format!("{name} is declared already; this declaration does not count"),
            "a name means one thing: rename one of them",
        ),
    };
    Diagnostic::new(codes::SPEC_DECLARED_TWICE, mark.span, message)
        .help(help)
        .related(first, "declared here")
}

/// Where names can be declared, found once.
#[derive(Default)]
struct Rooms(HashMap<(Option<Name>, Word), Room>);

impl Rooms {
    fn declare(
        &mut self,
        document: &Document<'_>,
        part: Option<&Name>,
        word: Word,
        name: &str,
    ) -> Edit {
        let key = (part.cloned(), word);
        let room = self
            .0
            .entry(key)
            .or_insert_with(|| room(document, part, word));
        room.declare(document, word, name)
    }
}

fn undeclared(
    document: &Document<'_>,
    statement: &Statement,
    mark: &Mark,
    declared: &Declared<'_>,
    scope: &Scope<'_>,
    rooms: &mut Rooms,
) -> Option<Diagnostic> {
    let name = &mark.name;
    let part = statement.part.as_ref();
    let usage = declared.usage(name);
    let is_a = |fits: fn(Word) -> bool| matches!(usage, Some(Usage::Declares(word)) if fits(word));
    let (what, word) = match mark.usage {
        Usage::Step if !is_a(Word::declares_step) => ("a step", Some(Word::Step)),
        Usage::Transition if !is_a(|word| word == Word::Transition) => {
            ("a transition", Some(Word::Transition))
        }
        Usage::Part if usage != Some(Usage::DeclaresPart) => ("a part", None),
        Usage::Value | Usage::Output => {
            let known = is_a(|word| word.declares_step() || word.declares_variable())
                || declared.place(name, part).is_some() && usage.is_none()
                || scope.is_instance_step(name)
                || name.starts_with('%');
            if known {
                return None;
            }
            match mark.usage {
                Usage::Output => ("an output", Some(Word::Output)),
                _ => (
                    "an input, an output, an internal variable or a step",
                    Some(Word::Input),
                ),
            }
        }
        _ => return None,
    };
    let spelled = spell::name(name);
    let message = format!("{spelled} is not declared as {what}");
    let diagnostic = Diagnostic::new(codes::SPEC_UNDECLARED, mark.span, message);
    if let Some(other) = declared.place(name, part) {
        return Some(
            diagnostic
                .related(other, "declared here as something else")
                .help("a name means one thing: use another name"),
        );
    }
    Some(match word {
        Some(word) => {
            let part = part.filter(|_| !word.is_global());
            let edit = rooms.declare(document, part, word, &spelled);
            let title = format!("Declare `{} {spelled}`", word.text());
            diagnostic
                .help("declare it, or correct the spelling")
                .fix(title, vec![edit])
        }
        None => diagnostic.help(
            "begin the part with `Partial`, `Expansion` or `Reusable` and its name, or correct \
             the spelling",
        ),
    })
}

/// Instances must give as many names as their grafcet takes.
fn instances(statement: &Statement, spec: &Spec, found: &mut Vec<Diagnostic>) {
    let Kind::List(Word::Instance, entries) = &statement.kind else {
        return;
    };
    for entry in entries {
        let Item::Instance(instance) = &entry.item else {
            continue;
        };
        let Some(part) = spec.grafcet.part(&instance.of) else {
            continue;
        };
        let of = spell::name(&part.name);
        let PartKind::Reusable { parameters } = &part.kind else {
            let message = format!("{of} is not declared as a reusable grafcet");
            found.push(
                Diagnostic::new(codes::SPEC_UNDECLARED, entry.span, message)
                    .help("begin the part with `Reusable` and its name"),
            );
            continue;
        };
        let (wanted, given) = (parameters.len(), instance.arguments.len());
        if wanted == given {
            continue;
        }
        let message = format!("{of} takes {wanted} names, and {given} are given");
        let help = "an instance is written `Instance d1 of Drill(a, b)`, with one variable for \
                    each parameter of `Reusable Drill(x, y)`";
        found.push(Diagnostic::new(codes::SPEC_SYNTAX, entry.span, message).help(help));
    }
}

/// Declared transitions without a rule can never be cleared.
fn rules_of_transitions(
    document: &Document<'_>,
    declared: &Declared<'_>,
    found: &mut Vec<Diagnostic>,
) {
    let labels: HashSet<&Name> = document
        .statements
        .iter()
        .filter_map(Statement::label)
        .collect();
    for (name, (usage, span)) in &declared.global {
        if *usage != Usage::Declares(Word::Transition) || labels.contains(*name) {
            continue;
        }
        let message = format!("transition {} has no rule", spell::name(name));
        found.push(
            Diagnostic::new(codes::TRANSITION_WITHOUT_RULE, *span, message)
                .help("write its rule under `Transitions:`, or take the declaration out"),
        );
    }
}

fn no_initial_step(document: &Document<'_>, spec: &Spec) -> Option<Diagnostic> {
    let grafcet = &spec.grafcet;
    let has_source = grafcet
        .transitions()
        .any(|transition| transition.from.is_empty());
    let instance_starts = grafcet.instances.iter().any(|instance| {
        let part = grafcet.part(&instance.of);
        part.is_some_and(|part| part.chart.steps.iter().any(|step| step.initial))
    });
    if has_source || instance_starts || grafcet.initial_steps().next().is_some() {
        return None;
    }
    let (_, _, first) = document
        .entries()
        .find(|(_, word, _)| word.declares_step())?;
    let name = spell::name(first.item.name());
    let at = document
        .statements
        .iter()
        .find(|statement| statement.span().range().contains(&first.span.range().start));
    let part = at.and_then(|statement| statement.part.as_ref());
    let edit = room(document, part, Word::Marking).declare(document, Word::Marking, &name);
    Some(
        Diagnostic::new(
            codes::SPEC_NO_INITIAL_STEP,
            first.span,
            "no step is active at the start, so nothing can ever happen",
        )
        .help("mark the steps of the initial situation: `Marking p1`")
        .fix(format!("Add `Marking {name}`"), vec![edit]),
    )
}
