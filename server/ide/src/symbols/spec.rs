use grafcet::{Mention, Role, RulePlace, SectionPlace, Step};
use source::Span;

use super::{Symbol, SymbolKind, title};
use crate::Spec;

/// The grafcet, its parts, their steps, and their sections with the rules.
pub fn symbols_of_spec(spec: &Spec) -> Vec<Symbol> {
    let places = &spec.reading.places;
    let steps = places.mentions.iter().filter_map(|it| step(spec, it));
    let rules = places.rules.iter().map(|it| rule(spec, it));
    let mut leaves: Vec<Symbol> = steps.chain(rules).collect();
    let mut inner = places.sections.iter().map(section).collect::<Vec<_>>();
    // Sections stand in parts, rules in sections, steps in parts.
    inner.append(&mut leaves);
    inner.sort_by_key(|it| (it.whole.start, std::cmp::Reverse(it.whole.end)));
    let symbols = nested(inner);
    let name = places
        .mentions
        .iter()
        .find(|it| it.role == Role::Grafcet && it.declares);
    match name {
        Some(name) => vec![Symbol {
            children: symbols,
            ..Symbol::new(
                SymbolKind::Grafcet,
                &*name.name,
                Span::new(0, spec.text.len()),
                name.span,
            )
        }],
        None => symbols,
    }
}

/// The tree of symbols that come in the order of their first bytes, each
/// before those that stand in it.
fn nested(symbols: Vec<Symbol>) -> Vec<Symbol> {
    let mut done: Vec<Symbol> = Vec::new();
    let mut open: Vec<Symbol> = Vec::new();
    let close = |open: &mut Vec<Symbol>, done: &mut Vec<Symbol>| {
        if let Some(closed) = open.pop() {
            match open.last_mut() {
                Some(outer) => outer.children.push(closed),
                None => done.push(closed),
            }
        }
    };
    for symbol in symbols {
        while open
            .last()
            .is_some_and(|it| it.whole.end < symbol.whole.end || is_leaf(it.kind))
        {
            close(&mut open, &mut done);
        }
        open.push(symbol);
    }
    while !open.is_empty() {
        close(&mut open, &mut done);
    }
    done
}

fn is_leaf(kind: SymbolKind) -> bool {
    !matches!(kind, SymbolKind::Part | SymbolKind::Section)
}

fn section(place: &SectionPlace) -> Symbol {
    let kind = match place.is_part {
        true => SymbolKind::Part,
        false => SymbolKind::Section,
    };
    Symbol::new(kind, &*place.title, place.span, place.heading)
}

fn step(spec: &Spec, mention: &Mention) -> Option<Symbol> {
    if mention.role != Role::Step || !mention.declares {
        return None;
    }
    let step = spec.reading.spec.grafcet.step(&mention.name)?;
    let symbol = Symbol::new(SymbolKind::Step, &*step.name, mention.span, mention.span);
    Some(symbol.detailed(said_of(step)))
}

fn said_of(step: &Step) -> String {
    let mut words = Vec::new();
    if step.initial {
        words.push("initial".to_owned());
    }
    words.extend(step.state.as_ref().map(|state| format!("for {state}")));
    words.extend(step.comment.as_deref().map(title));
    words.join(", ")
}

fn rule(spec: &Spec, place: &RulePlace) -> Symbol {
    let kind = match place.role {
        Role::Transition => SymbolKind::Transition,
        Role::Step => SymbolKind::Action,
        _ => SymbolKind::Rule,
    };
    let mentions = &spec.reading.places.mentions;
    let label = mentions
        .binary_search_by_key(&place.span.start, |it| it.span.start)
        .ok()
        .and_then(|at| mentions.get(at));
    let label = label.map_or(place.span, |it| it.span);
    let said = spec.text.get(label.range().end..place.span.range().end);
    let said = said
        .unwrap_or_default()
        .trim_start_matches([':', ' ', '\t']);
    let words: Vec<&str> = said.split_whitespace().collect();
    let symbol = Symbol::new(kind, &*place.name, place.span, label);
    symbol.detailed(title(&words.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::super::drawn;
    use super::*;

    fn outline(text: &str) -> String {
        drawn(&symbols_of_spec(&Spec::read(text.into())), text, 0)
    }

    #[test]
    fn a_grafcet_has_steps_and_sections_with_rules() {
        let text = "\
Grafcet Tank
Step X0, Xv1 for v1
Step \"X 2\" // Drain
Transition t1
Input s
Output R
Marking X0
Transitions:
t1: X0*s |- @Xv1
Steps:
Xv1: s |- R
Environment:
e1: s |- s
Never:
n1: R
//! accept v1 -> v2
";
        assert_eq!(
            outline(text),
            "\
Grafcet Tank | - | Tank
  Step X0 | initial | X0
  Step Xv1 | for v1 | Xv1
  Step X 2 | Drain | \"X 2\"
  Section Transitions | - | Transitions:
    Transition t1 | X0*s |- @Xv1 | t1
  Section Steps | - | Steps:
    Action Xv1 | s |- R | Xv1
  Section Environment | - | Environment:
    Rule e1 | s |- s | e1
  Section Never | - | Never:
    Rule n1 | R | n1
"
        );
    }

    #[test]
    fn parts_hold_their_own() {
        let text = "\
Step X0
Partial G1
Step Y0
Transitions:
t1: Y0 |- @Y0
Partial G2
Step Z0
";
        assert_eq!(
            outline(text),
            "\
Step X0 | - | X0
Part G1 | - | Partial G1
  Step Y0 | - | Y0
  Section Transitions | - | Transitions:
    Transition t1 | Y0 |- @Y0 | t1
Part G2 | - | Partial G2
  Step Z0 | - | Z0
"
        );
    }

    #[test]
    fn a_text_that_says_nothing_has_nothing() {
        assert_eq!(outline(""), "");
        assert_eq!(outline("nonsense ( here\n"), "");
    }
}
