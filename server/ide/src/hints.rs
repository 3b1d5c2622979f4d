//! What stands behind a coil, a contact or a step, in small letters.

use std::collections::HashSet;

use ::ladder::{CoilKind, ContactKind, ElementKind};
use grafcet::Role;
use logic::{Budget, Name};
use recovery::conditions::{Conditions, Variable};
use recovery::states::Holding;
use source::Span;

use crate::{Ladder, Spec, legible};

/// A remark behind a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// Behind this byte.
    pub offset: usize,
    /// What it says.
    pub text: String,
    /// More of it, for those who ask.
    pub detail: String,
}

/// Longer conditions are not shown: a hint must not push the text away.
const LONGEST: usize = 32;

/// The hints of a ladder within `span`: what keeps a coil that holds a state,
/// and which contacts are interlocks.
pub fn hints_in_ladder(ladder: &Ladder, span: Span, budget: &Budget) -> Vec<Hint> {
    let analysis = &ladder.analysis;
    let mut hints = Vec::new();
    for (_, rung) in ladder.program().rungs() {
        if rung.span.end < span.start || span.end < rung.span.start {
            continue;
        }
        let mut locks: HashSet<Name> = HashSet::new();
        for (_, element) in rung.network.elements() {
            if let ElementKind::Coil(coil) = &element.kind
                && let Some(state) = analysis.states().find(&coil.operand.name)
            {
                let names = state
                    .interlocks
                    .iter()
                    .filter_map(|it| analysis.states().state(*it));
                locks.extend(names.map(|it| it.name.clone()));
            }
        }
        for (_, element) in rung.network.elements() {
            let whole = rung.place(element.within);
            if whole.end < span.start || span.end < whole.start {
                continue;
            }
            let found = match &element.kind {
                ElementKind::Contact(contact)
                    if contact.kind == ContactKind::Closed
                        && locks.contains(&contact.operand.name) =>
                {
                    let name = &contact.operand.name;
                    Some(Hint {
                        offset: whole.range().end,
                        text: "interlock".to_owned(),
                        detail: format!("keeps the coil off while {name} is on"),
                    })
                }
                ElementKind::Coil(coil) => {
                    let variable = analysis.conditions.find(&coil.operand.name);
                    variable.and_then(|it| of_coil(ladder, it, coil.kind, whole, budget))
                }
                _ => None,
            };
            hints.extend(found);
        }
    }
    hints.sort_by_key(|hint| hint.offset);
    hints
}

fn of_coil(
    ladder: &Ladder,
    variable: &Variable,
    kind: CoilKind,
    span: Span,
    budget: &Budget,
) -> Option<Hint> {
    let state = ladder.analysis.states().find(&variable.name)?;
    let conditions: &Conditions = &ladder.analysis.conditions;
    let said = |function: &logic::Function| {
        legible(function, conditions, budget).filter(|it| it.len() <= LONGEST)
    };
    let (text, detail) = match (state.holding, kind) {
        (Holding::SealIn, _) => {
            let stays = said(&state.plain.restrict(state.atom, true));
            (
                stays.map_or("holds".to_owned(), |it| format!("holds while {it}")),
                "seals itself in",
            )
        }
        (Holding::Latch, CoilKind::Reset) => return None,
        (Holding::Latch, _) => {
            let ends = said(&state.plain_deactivation());
            (
                ends.map_or("latched".to_owned(), |it| format!("latched until {it}")),
                "keeps its value until it is reset",
            )
        }
    };
    Some(Hint {
        offset: span.range().end,
        text,
        detail: format!("{} holds a state: {detail}", variable.name),
    })
}

/// The hints of a spec within `span`: what the ladder says about the states
/// that steps stand for.
pub fn hints_in_spec(spec: &Spec, ladder: &Ladder, span: Span) -> Vec<Hint> {
    let grafcet = &spec.reading.spec.grafcet;
    let mentions = spec.reading.places.mentions.iter();
    let declared = mentions.filter(|it| it.declares && it.role == Role::Step);
    let here = declared.filter(|it| span.start <= it.span.end && it.span.start <= span.end);
    let hints = here.filter_map(|mention| {
        let step = grafcet.steps().find(|step| step.name == mention.name)?;
        let state = step.state.as_ref().filter(|_| step.comment.is_none())?;
        let text = ladder.analysis.description(state)?;
        Some(Hint {
            offset: mention.span.range().end,
            text: text.to_string(),
            detail: format!("what the ladder says about {state}"),
        })
    });
    hints.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ladder with its hints between `«` and `»`.
    fn shown(text: &str) -> String {
        let budget = Budget::default();
        let ladder = Ladder::read(text.into(), &budget);
        let hints = hints_in_ladder(&ladder, Span::new(0, text.len()), &budget);
        let mut out = text.to_owned();
        for hint in hints.iter().rev() {
            out.insert_str(hint.offset, &format!("«{}»", hint.text));
        }
        out
    }

    #[test]
    fn coils_that_hold_a_state_say_while_what() {
        assert_eq!(
            shown("rung: (s + v1) * /ls2 -> v1\nrung: s -> lamp\n"),
            "rung: (s + v1) * /ls2 -> v1«holds while /ls2»\nrung: s -> lamp\n"
        );
        assert_eq!(
            shown("rung: s -> set v1\nrung: ls2 -> reset v1\n"),
            "rung: s -> set v1«latched until ls2»\nrung: ls2 -> reset v1\n"
        );
    }

    #[test]
    fn interlocks_are_marked() {
        assert_eq!(
            shown("rung: (a + up) * /top * /down -> up\nrung: (b + down) * /up * /low -> down\n"),
            "rung: (a + up) * /top * /down«interlock» -> up«holds while /down*/top»\n\
             rung: (b + down) * /up«interlock» * /low -> down«holds while /up*/low»\n"
        );
    }

    #[test]
    fn only_what_is_looked_at_is_worked_out() {
        let text = "rung: (s + v1) * /ls2 -> v1\nrung: (t + v2) * /ls2 -> v2\n";
        let budget = Budget::default();
        let ladder = Ladder::read(text.into(), &budget);
        let hints = hints_in_ladder(&ladder, Span::new(0, 20), &budget);
        assert_eq!(hints.len(), 0);
        let hints = hints_in_ladder(&ladder, Span::new(28, text.len()), &budget);
        assert_eq!(hints.len(), 1);
    }
}
