use std::collections::HashSet;

use ::ladder::{Element, ElementKind, Routine, Rung, Within};
use grafcet::Role;
use logic::Name;
use petgraph::graph::NodeIndex;
use recovery::conditions::Place;
use source::Span;

use super::subject::{access, callee, definition_of, state_of};
use super::{Access, Pair, Reference, Side, Subject};
use crate::{Ladder, Spec};

/// Every place of a subject, in both texts: of a state its coils, its
/// contacts, its steps with all that is said of them, and the decisions about
/// it. What is a part of a variable, as a timer's output is, counts too.
pub fn references(pair: Pair<'_>, subject: &Subject) -> Vec<Reference> {
    let mut found = match pair.ladder {
        Some(ladder) => in_ladder(ladder, subject),
        None => Vec::new(),
    };
    if let Some(spec) = pair.spec {
        found.extend(in_spec(spec, subject));
    }
    found.sort_by_key(|it| (it.side, it.span, it.access));
    found.dedup_by_key(|it| (it.side, it.span));
    found
}

pub(super) fn in_ladder(ladder: &Ladder, subject: &Subject) -> Vec<Reference> {
    let at = |span: Span, access| Reference {
        side: Side::Ladder,
        span,
        access,
    };
    match subject {
        Subject::Variable(name) => ladder
            .names()
            .all()
            .iter()
            .filter(|it| is_part(&it.name, name))
            .map(|it| at(it.span, it.usage.into()))
            .collect(),
        Subject::Value(state) => {
            let mut found = elements(ladder, |_, kind| {
                let same = state_of(ladder, kind)? == *state;
                let access = match kind {
                    ElementKind::Assign(_) => Access::Written,
                    _ => Access::Read,
                };
                same.then_some((None, access))
            });
            let registers = ladder.analysis.registers.iter();
            let arcs = registers.flat_map(|register| {
                let arcs = register.arcs.iter();
                arcs.filter(|arc| register.state_name(arc.to) == *state)
            });
            let written = arcs.flat_map(|arc| &arc.written_at);
            found.extend(written.map(|(_, span)| at(*span, Access::Written)));
            found
        }
        Subject::Routine(routine) => {
            let declared = ladder.program().routines.get(*routine);
            let declared = declared.and_then(|it| ladder.routine_name(it));
            let mut found: Vec<Reference> = declared
                .map(|span| at(span, Access::Declared))
                .into_iter()
                .collect();
            found.extend(elements(ladder, |place, kind| {
                let (called, span) = match kind {
                    ElementKind::Call(call) => (
                        callee(ladder, place.routine, &call.routine.name),
                        Some(call.routine.within),
                    ),
                    ElementKind::Block(block) => (definition_of(ladder, &block.name), None),
                    _ => return None,
                };
                (called == Some(*routine)).then_some((span, Access::Read))
            }));
            found
        }
        Subject::Label { routine, name } => elements(ladder, |place, kind| {
            let (label, access) = match kind {
                ElementKind::Jump(label) => (label, Access::Read),
                ElementKind::Label(label) => (label, Access::Declared),
                _ => return None,
            };
            let same = place.routine == *routine && label.name == *name;
            same.then_some((Some(label.within), access))
        }),
        Subject::Step(_) | Subject::InSpec(_) => Vec::new(),
    }
}

/// The elements that `wanted` takes, at the span that it gives or the
/// element's own.
fn elements(
    ladder: &Ladder,
    wanted: impl Fn(Place, &ElementKind) -> Option<(Option<Within>, Access)>,
) -> Vec<Reference> {
    let mut found = Vec::new();
    for (routine, it) in ladder.program().routines.iter().enumerate() {
        for (place, rung, element) in placed(routine, it) {
            if let Some((within, access)) = wanted(place, &element.kind) {
                found.push(Reference {
                    side: Side::Ladder,
                    span: rung.place(within.unwrap_or(element.within)),
                    access,
                });
            }
        }
    }
    found
}

/// The elements of a routine with their places.
fn placed(routine: usize, it: &Routine) -> impl Iterator<Item = (Place, &Rung, &Element)> {
    let rungs = it.rungs.iter().enumerate();
    rungs.flat_map(move |(rung, within)| {
        let elements = within.network.elements();
        elements.map(move |(element, it): (NodeIndex, _)| {
            let place = Place {
                routine,
                rung,
                element: element.index(),
            };
            (place, within, it)
        })
    })
}

/// Whether `name` is the variable `whole`, or a part of it.
pub(crate) fn is_part(name: &str, whole: &str) -> bool {
    let rest = name.strip_prefix(whole);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn in_spec(spec: &Spec, subject: &Subject) -> Vec<Reference> {
    let places = &spec.reading.places;
    let steps: Vec<&Name> = match subject {
        Subject::Variable(state) | Subject::Value(state) => {
            let steps = spec.reading.spec.grafcet.steps();
            let standing = steps.filter(|step| step.state.as_ref() == Some(state));
            standing.map(|step| &step.name).collect()
        }
        Subject::Step(name) => vec![name],
        _ => Vec::new(),
    };
    let same: HashSet<Span> = match subject {
        Subject::InSpec(mention) => places.same_as(mention).map(|it| it.span).collect(),
        _ => HashSet::new(),
    };
    let mentions = places.mentions.iter().filter(|it| match it.role {
        Role::Step => steps.contains(&&it.name),
        Role::State => match subject {
            Subject::Variable(name) | Subject::Value(name) => it.name == *name,
            _ => false,
        },
        Role::Variable => match subject {
            Subject::Variable(name) => is_part(&it.name, name),
            _ => false,
        },
        _ => same.contains(&it.span),
    });
    let mentions = mentions.map(|it| Reference {
        side: Side::Spec,
        span: it.span,
        access: access(it),
    });
    mentions.collect()
}

#[cfg(test)]
mod tests {
    use super::super::subject;
    use super::super::tests::{Fixture, LADDER, SPEC, with_cursor};
    use super::*;

    /// All places of what is at the cursor.
    fn places(ladder: &str, spec: &str) -> Vec<String> {
        let fixture = Fixture::new(ladder, spec);
        let subject = subject(fixture.pair(), fixture.side, fixture.offset).expect("a subject");
        let found = references(fixture.pair(), &subject);
        let shown = found.iter().map(|it| {
            let word = match it.access {
                Access::Declared => "declared",
                Access::Read => "read",
                Access::Written => "written",
            };
            format!("{} {word}", fixture.show(it.side, it.span))
        });
        shown.collect()
    }

    #[test]
    fn a_state_is_one_thing_in_both_texts() {
        let wanted = [
            "ladder 3: v1 declared",
            "ladder 4: v1 read",
            "ladder 4: v1 written",
            "ladder 5: v1 read",
            "ladder 6: v1 read",
            "spec 1: Xv1 declared",
            "spec 1: v1 read",
            "spec 6: Xv1 written",
            "spec 7: v1 read",
        ];
        assert_eq!(places(&with_cursor(LADDER, "s + v$01"), SPEC), wanted);
        assert_eq!(places(LADDER, &with_cursor(SPEC, "@X$0v1")), wanted);
        assert_eq!(places(LADDER, &with_cursor(SPEC, "accept v$01")), wanted);
    }

    #[test]
    fn what_only_the_spec_knows_is_found_there() {
        let spec = with_cursor(SPEC, "Marking X$00");
        let steps = ["spec 1: X0 declared", "spec 4: X0 read", "spec 6: X0 read"];
        assert_eq!(places(LADDER, &spec), steps);
        let spec = with_cursor(SPEC, "Transition t$01");
        assert_eq!(
            places(LADDER, &spec),
            ["spec 2: t1 declared", "spec 6: t1 read"]
        );
    }

    #[test]
    fn the_outputs_of_a_timer_are_its_own() {
        let ladder = "rung: a -> TON(t$01, 5s)\nrung: t1.Q -> t10";
        assert_eq!(
            places(ladder, ""),
            ["ladder 1: t1 written", "ladder 2: t1.Q read"]
        );
    }

    #[test]
    fn labels_and_routines_have_their_jumps_and_calls() {
        let ladder = "rung: a -> jump again\nrung label ag$0ain: b -> jump again";
        assert_eq!(
            places(ladder, ""),
            [
                "ladder 1: again read",
                "ladder 2: again declared",
                "ladder 2: again read"
            ]
        );
        let ladder = "rung: 1 -> call Doors\n\nroutine Do$0ors\nrung: b -> c";
        assert_eq!(
            places(ladder, ""),
            ["ladder 1: Doors read", "ladder 3: Doors declared"]
        );
    }

    #[test]
    fn a_value_of_a_register_is_compared_and_written() {
        let ladder = "\
rung: Seq = 0 * go -> Seq := 10
rung: Seq = 10 * done -> Seq := 20
rung: Seq = 20 * back -> Seq := 0
";
        assert_eq!(
            places(ladder, "Step X for Seq=$010"),
            [
                "ladder 1: Seq := 10 written",
                "ladder 2: Seq = 10 read",
                "spec 1: X declared",
                "spec 1: Seq=10 read"
            ]
        );
    }
}
