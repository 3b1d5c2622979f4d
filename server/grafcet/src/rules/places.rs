use std::collections::{HashMap, HashSet};

use logic::Name;
use source::Span;

use super::syntax::{Document, Kind, Mark, Statement, Usage};
use super::words::{Section, Word};
use crate::{PartKind, Spec};

/// Where the names and rules of a text stand: for hovers, for going to a
/// declaration, for renaming, and for findings that need more than the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Places {
    /// Every name, in the order of the text.
    pub mentions: Vec<Mention>,
    /// Every rule that was understood, in the order of the text.
    pub rules: Vec<RulePlace>,
    /// The lines of the spec's decisions, in the same order.
    pub decisions: Vec<Span>,
    /// Every section and every part, in the order of the text.
    pub sections: Vec<SectionPlace>,
}

/// A name where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mention {
    /// The name, without quotes.
    pub name: Name,
    /// What it names.
    pub role: Role,
    /// Whether it is declared here.
    pub declares: bool,
    /// Whether the rule around it gives it a value: a step after the
    /// transition or forced by the action, or what the action acts upon.
    pub written: bool,
    /// The part that the text around it belongs to. A parameter means
    /// something in its part only.
    pub part: Option<Name>,
    /// Where; quotes included.
    pub span: Span,
}

/// What a name names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// The grafcet.
    Grafcet,
    /// A step, or its variable.
    Step,
    /// An input, an output or an internal variable, declared or not.
    Variable,
    /// A transition.
    Transition,
    /// A part.
    Part,
    /// A parameter of a reusable grafcet.
    Parameter,
    /// An instance.
    Instance,
    /// An environment rule or a property.
    Rule,
    /// A state of the ladder.
    State,
}

/// A rule where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RulePlace {
    /// Its label: of an action, the step.
    pub name: Name,
    /// What the rule is about: a transition, the step of an action, or an
    /// environment rule or property.
    pub role: Role,
    /// The rule, from its label to its last sign.
    pub span: Span,
    /// Its line or lines, from the first byte to the last line end.
    pub lines: Span,
}

/// A section or a part where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SectionPlace {
    /// The word of the section, `Transitions`, or the name of the part.
    pub title: Name,
    /// Whether it is a part. Sections stand in parts.
    pub is_part: bool,
    /// Its first line.
    pub heading: Span,
    /// From its heading to the last rule in it; of a part, to the last line
    /// that says something.
    pub span: Span,
}

impl Places {
    /// The name at the byte `offset`, or just before it.
    pub fn mention_at(&self, offset: usize) -> Option<&Mention> {
        let after = self
            .mentions
            .partition_point(|mention| mention.span.range().start <= offset);
        let found = self.mentions.get(after.checked_sub(1)?)?;
        found.span.touches(offset).then_some(found)
    }

    /// Every place that names the same thing as `mention`.
    pub fn same_as<'p>(&'p self, mention: &'p Mention) -> impl Iterator<Item = &'p Mention> {
        self.mentions.iter().filter(move |other| {
            let same_scope = other.role != Role::Parameter || other.part == mention.part;
            other.name == mention.name && other.role == mention.role && same_scope
        })
    }

    /// The rule of the transition called `name`.
    pub fn transition(&self, name: &str) -> Option<&RulePlace> {
        let mut all = self.rules.iter();
        all.find(|rule| rule.role == Role::Transition && &*rule.name == name)
    }

    /// Where `name` is declared as a `role`.
    pub fn declaration(&self, name: &str, role: Role) -> Option<&Mention> {
        let mut all = self.mentions.iter();
        all.find(|mention| mention.declares && mention.role == role && &*mention.name == name)
    }
}

/// What a name in an expression names.
pub(crate) struct Scope<'s> {
    steps: &'s HashSet<Name>,
    parameters: HashMap<&'s Name, HashSet<&'s Name>>,
    /// `d1.E1` for step `E1` of instance `d1`.
    instance_steps: HashSet<String>,
}

impl<'s> Scope<'s> {
    pub(crate) fn new(steps: &'s HashSet<Name>, spec: &'s Spec) -> Self {
        let parameters = spec
            .grafcet
            .parts
            .iter()
            .filter_map(|part| match &part.kind {
                PartKind::Reusable { parameters } => {
                    Some((&part.name, parameters.iter().collect()))
                }
                _ => None,
            });
        let instance_steps = spec.grafcet.instances.iter().flat_map(|instance| {
            let part = spec.grafcet.part(&instance.of);
            let steps = part.into_iter().flat_map(|part| &part.chart.steps);
            steps.map(move |step| format!("{}.{}", instance.name, step.name))
        });
        Self {
            steps,
            parameters: parameters.collect(),
            instance_steps: instance_steps.collect(),
        }
    }

    /// What `mark`, standing in `part`, names.
    pub(crate) fn role(&self, mark: &Mark, part: Option<&Name>) -> Role {
        match mark.usage {
            Usage::DeclaresGrafcet => Role::Grafcet,
            Usage::Declares(word) => match word {
                Word::Transition => Role::Transition,
                Word::Instance => Role::Instance,
                Word::Input | Word::Output | Word::Internal => Role::Variable,
                _ => Role::Step,
            },
            Usage::DeclaresPart | Usage::Part => Role::Part,
            Usage::DeclaresParameter => Role::Parameter,
            Usage::DeclaresRule => Role::Rule,
            Usage::Transition | Usage::Rule => Role::Transition,
            Usage::Step => Role::Step,
            Usage::State => Role::State,
            Usage::Value | Usage::Output => self.value(&mark.name, part),
        }
    }

    fn value(&self, name: &Name, part: Option<&Name>) -> Role {
        let parameters = part.and_then(|part| self.parameters.get(part));
        if parameters.is_some_and(|parameters| parameters.contains(name)) {
            Role::Parameter
        } else if self.steps.contains(name) || self.instance_steps.contains(&**name) {
            Role::Step
        } else {
            Role::Variable
        }
    }

    /// Whether `name` is the variable of an instance's step.
    pub(crate) fn is_instance_step(&self, name: &str) -> bool {
        self.instance_steps.contains(name)
    }
}

pub(crate) fn places(document: &Document<'_>, steps: &HashSet<Name>, spec: &Spec) -> Places {
    let scope = Scope::new(steps, spec);
    let mut places = Places::default();
    for statement in &document.statements {
        let part = statement.part.as_ref();
        let mentions = statement.marks.iter().map(|mark| Mention {
            name: mark.name.clone(),
            role: scope.role(mark, part),
            declares: declares(mark.usage),
            written: written(statement, mark),
            part: part.cloned(),
            span: mark.span,
        });
        places.mentions.extend(mentions);
        if matches!(statement.kind, Kind::Decision(_)) {
            places.decisions.push(statement.span());
        }
        places.rules.extend(rule(statement));
        sections(statement, &mut places.sections);
    }
    places
}

/// Begins a section or part at its heading, and lets those that are open reach
/// to the statement.
fn sections(statement: &Statement, sections: &mut Vec<SectionPlace>) {
    let begins = |title: Name, is_part| SectionPlace {
        title,
        is_part,
        heading: statement.span(),
        span: statement.span(),
    };
    match &statement.kind {
        Kind::Blank => {}
        Kind::Part(name, _) => sections.push(begins(name.clone(), true)),
        kind => {
            let part = sections.iter_mut().rev().find(|it| it.is_part);
            if let Some(part) = part {
                part.span = part.span.cover(statement.span());
            }
            if let Kind::Section(section) = kind {
                sections.push(begins(section.text().into(), false));
            } else if statement.label().is_some()
                && let Some(last) = sections.last_mut()
            {
                last.span = last.span.cover(statement.span());
            }
        }
    }
}

/// Whether a statement writes what is named at `mark`. The first mark of a
/// rule is its label.
fn written(statement: &Statement, mark: &Mark) -> bool {
    let is_label = statement.marks.first().map(|it| it.span) == Some(mark.span);
    match statement.kind {
        Kind::Transition(_) => mark.usage == Usage::Step,
        Kind::Action(_) => {
            !is_label && matches!(mark.usage, Usage::Output | Usage::Part | Usage::Step)
        }
        _ => false,
    }
}

fn declares(usage: Usage) -> bool {
    matches!(
        usage,
        Usage::Declares(_)
            | Usage::DeclaresPart
            | Usage::DeclaresParameter
            | Usage::DeclaresRule
            | Usage::DeclaresGrafcet
    )
}

fn rule(statement: &Statement) -> Option<RulePlace> {
    if matches!(statement.kind, Kind::Broken(_)) {
        return None;
    }
    Some(RulePlace {
        name: statement.label()?.clone(),
        role: match statement.section? {
            Section::Transitions => Role::Transition,
            Section::Steps => Role::Step,
            Section::Environment | Section::Never => Role::Rule,
        },
        span: statement.span(),
        lines: Span::new(statement.start(), statement.next()),
    })
}
