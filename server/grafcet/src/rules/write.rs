use std::collections::HashSet;

use logic::Name;

use super::syntax::Item;
use super::words::{GRAFCET, Section, Word};
use super::{decisions, spell};
use crate::{Chart, Grafcet, Part, Spec, StepKind};

/// Lists of bare names are broken here, counted in characters.
pub(crate) const WIDTH: usize = 80;

/// The canonical text of a spec: all that it holds, each thing in its place,
/// the same on every run and machine.
///
/// Reading the text gives the spec back, and writing that gives the same text
/// again. A name that no text can hold, because it has a quote or a line end
/// in it, has `'` in their place.
pub fn write(spec: &Spec) -> String {
    let steps = step_names(&spec.grafcet);
    let mut blocks = Vec::new();
    if let Some(name) = &spec.grafcet.name {
        blocks.push(vec![grafcet_line(name)]);
    }
    blocks.push(declarations(&spec.grafcet));
    blocks.extend(chart_sections(&spec.grafcet.chart, &steps));
    for part in &spec.grafcet.parts {
        blocks.extend(part_blocks(part, &steps));
    }
    let environment = spec.environment.iter().map(environment_line).collect();
    blocks.push(section_lines(Section::Environment, environment));
    let never = spec.never.iter().map(never_line).collect();
    blocks.push(section_lines(Section::Never, never));
    blocks.push(
        spec.decisions
            .iter()
            .map(decisions::decision_text)
            .collect(),
    );

    blocks.retain(|block| !block.is_empty());
    let blocks: Vec<String> = blocks.iter().map(|lines| lines.join("\n")).collect();
    match blocks.is_empty() {
        true => String::new(),
        false => blocks.join("\n\n") + "\n",
    }
}

/// The names of all steps.
pub(crate) fn step_names(grafcet: &Grafcet) -> HashSet<Name> {
    grafcet.steps().map(|step| step.name.clone()).collect()
}

pub(crate) fn grafcet_line(name: &Name) -> String {
    format!("{GRAFCET} {}", spell::name(name))
}

fn declarations(grafcet: &Grafcet) -> Vec<String> {
    let mut lines = Vec::new();
    for (word, items) in chart_lists(&grafcet.chart) {
        if word == Word::Marking {
            for (word, items) in global_lists(grafcet) {
                lines.extend(list_lines(word, &items));
            }
        }
        lines.extend(list_lines(word, &items));
    }
    lines
}

/// The lists of the whole spec, in canonical order.
pub(crate) fn global_lists(grafcet: &Grafcet) -> [(Word, Vec<Item>); 4] {
    let variables = |list: &[crate::Variable]| list.iter().cloned().map(Item::Variable).collect();
    let instances = grafcet.instances.iter().cloned();
    [
        (Word::Input, variables(&grafcet.inputs)),
        (Word::Output, variables(&grafcet.outputs)),
        (Word::Internal, variables(&grafcet.internals)),
        (Word::Instance, instances.map(Item::Instance).collect()),
    ]
}

/// The lists of one chart, in canonical order.
pub(crate) fn chart_lists(chart: &Chart) -> [(Word, Vec<Item>); 6] {
    let steps = |word: Word| {
        let of_word = chart
            .steps
            .iter()
            .filter(|step| step_word(&step.kind) == word);
        of_word.cloned().map(Item::Step).collect()
    };
    // In the order in which the lists above declare them.
    let marked = |is_marked: fn(&crate::Step) -> bool| {
        let mut marked: Vec<&crate::Step> =
            chart.steps.iter().filter(|step| is_marked(step)).collect();
        marked.sort_by_key(|step| step_word(&step.kind));
        let names = marked.into_iter().map(|step| step.name.clone());
        names.map(Item::Name).collect()
    };
    let transitions = chart.transitions.iter();
    [
        (Word::Step, steps(Word::Step)),
        (Word::Macro, steps(Word::Macro)),
        (Word::Enclosing, steps(Word::Enclosing)),
        (
            Word::Transition,
            transitions
                .map(|transition| Item::Name(transition.name.clone()))
                .collect(),
        ),
        (Word::Marking, marked(|step| step.initial)),
        (Word::Activation, marked(|step| step.activation_link)),
    ]
}

/// The word that declares a step of this kind.
pub(crate) fn step_word(kind: &StepKind) -> Word {
    match kind {
        StepKind::Plain => Word::Step,
        StepKind::Macro(_) => Word::Macro,
        StepKind::Enclosing(_) => Word::Enclosing,
    }
}

/// The lines that declare `items`: one for each that has something said about
/// it, and one for each run of bare names.
pub(crate) fn list_lines(word: Word, items: &[Item]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    // Whether the last line may take another bare name.
    let mut open = false;
    for item in items {
        let text = item_text(item);
        let bare = is_bare(item);
        match lines.last_mut() {
            Some(line) if open && bare && fits(line, &text) => {
                line.push_str(", ");
                line.push_str(&text);
            }
            _ => {
                let line = format!("{} {text}", word.text());
                lines.push(spell::with_comment(
                    line,
                    item.comment().map(|said| &**said),
                ));
            }
        }
        open = bare;
    }
    lines
}

/// Whether another name fits on a line.
fn fits(line: &str, name: &str) -> bool {
    line.chars().count() + 2 + name.chars().count() <= WIDTH
}

/// Whether nothing but the name is said.
pub(crate) fn is_bare(item: &Item) -> bool {
    let is_quiet = item.comment().is_none_or(|said| said.is_empty());
    is_quiet
        && match item {
            Item::Step(step) => step.state.is_none() && step.kind == StepKind::Plain,
            Item::Variable(variable) => variable.address.is_none(),
            Item::Instance(_) => false,
            Item::Name(_) => true,
        }
}

pub(crate) fn item_text(item: &Item) -> String {
    match item {
        Item::Step(step) => spell::step(step),
        Item::Variable(variable) => spell::variable(variable),
        Item::Instance(instance) => spell::instance(instance),
        Item::Name(name) => spell::name(name),
    }
}

fn chart_sections(chart: &Chart, steps: &HashSet<Name>) -> [Vec<String>; 2] {
    let transitions = chart.transitions.iter();
    let actions = chart.actions.iter();
    [
        section_lines(
            Section::Transitions,
            transitions
                .map(|transition| transition_line(transition, steps))
                .collect(),
        ),
        section_lines(Section::Steps, actions.map(action_line).collect()),
    ]
}

/// A section with its head, or nothing where it has no rules.
pub(crate) fn section_lines(section: Section, mut rules: Vec<String>) -> Vec<String> {
    if !rules.is_empty() {
        rules.insert(0, format!("{}:", section.text()));
    }
    rules
}

/// A part, in blocks with blank lines between.
pub(crate) fn part_blocks(part: &Part, steps: &HashSet<Name>) -> Vec<Vec<String>> {
    let mut head = vec![spell::part(part)];
    for (word, items) in chart_lists(&part.chart) {
        head.extend(list_lines(word, &items));
    }
    let mut blocks = vec![head];
    blocks.extend(chart_sections(&part.chart, steps));
    blocks.retain(|block| !block.is_empty());
    blocks
}

pub(crate) fn transition_line(transition: &crate::Transition, steps: &HashSet<Name>) -> String {
    commented(spell::transition(transition, steps), &transition.comment)
}

pub(crate) fn action_line(action: &crate::Action) -> String {
    commented(spell::action(action), &action.comment)
}

pub(crate) fn environment_line(rule: &crate::EnvironmentRule) -> String {
    commented(spell::environment(rule), &rule.comment)
}

pub(crate) fn never_line(property: &crate::Property) -> String {
    commented(spell::property(property), &property.comment)
}

fn commented(line: String, comment: &Option<Name>) -> String {
    spell::with_comment(line, comment.as_deref())
}
