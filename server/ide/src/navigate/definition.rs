use ::ladder::ElementKind;
use grafcet::Role;
use logic::Name;
use source::Span;

use super::subject::named;
use super::{Access, Pair, Side, Subject, Target};
use crate::{Ladder, Mention, Spec, Usage, element};

/// Where somebody goes to from a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Jump {
    /// The name, in the text that was asked about.
    pub from: Span,
    /// The places, in the order of the texts.
    pub to: Vec<Target>,
}

/// What gives the thing at the byte `offset` its value or its meaning: the
/// other end of a contact, a coil, a step, a call.
pub fn definition(pair: Pair<'_>, side: Side, offset: usize) -> Option<Jump> {
    let named = named(pair, side, offset)?;
    let coils = |name: &Name| pair.ladder.map_or(Vec::new(), |it| writers(it, name));
    let steps = |state: &Name| pair.spec.map_or(Vec::new(), |it| steps_for(it, state));
    let declared = || declared(pair, side, &named.subject);
    let to = match (&named.subject, side) {
        (Subject::Variable(name), Side::Ladder) => match named.access {
            Access::Written => first(vec![steps(name), declared(), coils(name)]),
            Access::Read | Access::Declared => first(vec![coils(name), declared()]),
        },
        (Subject::Variable(name), Side::Spec) => {
            let in_ladder = pair
                .ladder
                .map_or(Vec::new(), |it| declared_in_ladder(it, name));
            first(vec![coils(name), in_ladder, declared()])
        }
        (Subject::Value(state), Side::Ladder) => first(vec![steps(state), values(pair, state)]),
        (Subject::Value(state), Side::Spec) => first(vec![values(pair, state), declared()]),
        (Subject::InSpec(mention), _) if mention.role == Role::Transition => {
            let rule = pair
                .spec?
                .reading
                .places
                .rules
                .iter()
                .find(|it| it.role == Role::Transition && it.name == mention.name);
            match rule.filter(|rule| rule.span.start != mention.span.start) {
                Some(rule) => {
                    let label = Span::new(rule.span.range().start, rule.span.range().start);
                    vec![Target::new(Side::Spec, rule.span, label)]
                }
                None => declared(),
            }
        }
        (
            Subject::Step(_) | Subject::Routine(_) | Subject::Label { .. } | Subject::InSpec(_),
            _,
        ) => declared(),
    };
    jump(named.span, to)
}

/// Where the thing at the byte `offset` is declared, in the same text. What no
/// line of a ladder declares begins where it is first written.
pub fn declaration(pair: Pair<'_>, side: Side, offset: usize) -> Option<Jump> {
    let named = named(pair, side, offset)?;
    let mut to = declared(pair, side, &named.subject);
    if let (Subject::Variable(name), Side::Ladder, true) = (&named.subject, side, to.is_empty()) {
        let all = pair.ladder.map_or(Vec::new(), |it| writers(it, name));
        to.extend(all.into_iter().min());
    }
    jump(named.span, to)
}

pub(super) fn jump(from: Span, mut to: Vec<Target>) -> Option<Jump> {
    to.sort();
    to.dedup();
    (!to.is_empty()).then_some(Jump { from, to })
}

/// The first answer that says anything.
pub(super) fn first(answers: Vec<Vec<Target>>) -> Vec<Target> {
    let mut answers = answers.into_iter();
    answers.find(|it| !it.is_empty()).unwrap_or_default()
}

fn declared(pair: Pair<'_>, side: Side, subject: &Subject) -> Vec<Target> {
    match (subject, side) {
        (Subject::Variable(name), Side::Ladder) => pair
            .ladder
            .map_or(Vec::new(), |it| declared_in_ladder(it, name)),
        (Subject::Value(state), Side::Ladder) => {
            let register = state.split_once('=').map_or("", |(register, _)| register);
            pair.ladder
                .map_or(Vec::new(), |it| declared_in_ladder(it, register))
        }
        (Subject::Variable(name) | Subject::Value(name), Side::Spec) => {
            let Some(spec) = pair.spec else {
                return Vec::new();
            };
            let variable = spec.reading.places.declaration(name, Role::Variable);
            let variable = variable.map(|it| Target::new(Side::Spec, it.span, it.span));
            match steps_for(spec, name) {
                steps if steps.is_empty() => variable.into_iter().collect(),
                steps => steps,
            }
        }
        (Subject::Step(name), _) => {
            let places = pair.spec.map(|spec| &spec.reading.places);
            let found = places.and_then(|places| places.declaration(name, Role::Step));
            let found = found.map(|it| Target::new(Side::Spec, it.span, it.span));
            found.into_iter().collect()
        }
        (Subject::InSpec(mention), _) => {
            let places = pair.spec.map(|spec| &spec.reading.places);
            let same = places.into_iter().flat_map(|it| it.same_as(mention));
            same.filter(|it| it.declares)
                .map(|it| Target::new(Side::Spec, it.span, it.span))
                .collect()
        }
        (Subject::Routine(at), _) => pair.ladder.map_or(Vec::new(), |it| routine(it, *at)),
        (Subject::Label { routine, name }, _) => pair
            .ladder
            .map_or(Vec::new(), |it| labels(it, *routine, name)),
    }
}

/// What writes a variable: its coils, and what writes the whole that it is a
/// part of, as a timer writes its output.
pub(super) fn writers(ladder: &Ladder, name: &str) -> Vec<Target> {
    let wholes = std::iter::successors(Some(name), |name| Some(name.rsplit_once('.')?.0));
    wholes
        .flat_map(|name| ladder.names().of(name))
        .filter(|it| it.usage == Usage::Written)
        .map(|it| target(ladder, it))
        .collect()
}

pub(super) fn declared_in_ladder(ladder: &Ladder, name: &str) -> Vec<Target> {
    let wholes = std::iter::successors(Some(name), |name| Some(name.rsplit_once('.')?.0));
    let declarations = wholes.map(|name| {
        let all = ladder.names().of(name);
        let declared = all.filter(|it| it.usage == Usage::Declared);
        declared.map(|it| target(ladder, it)).collect()
    });
    first(declarations.collect())
}

fn target(ladder: &Ladder, mention: &Mention) -> Target {
    let element = mention
        .place
        .and_then(|place| element(ladder.program(), place));
    let whole = match element {
        Some((rung, element)) => rung.place(element.within),
        None => {
            let declaration = ladder.program().declarations.find(&mention.name);
            let span = declaration.map(|it| it.span);
            // Of several declarations of one name only the first is found.
            let holds = |it: &Span| it.start <= mention.span.start && it.end >= mention.span.end;
            span.filter(holds).unwrap_or(mention.span)
        }
    };
    Target::new(Side::Ladder, whole, mention.span)
}

/// The declarations of the steps that stand for a state.
fn steps_for(spec: &Spec, state: &Name) -> Vec<Target> {
    let steps = spec.reading.spec.grafcet.steps();
    steps
        .filter(|step| step.state.as_ref() == Some(state))
        .filter_map(|step| spec.reading.places.declaration(&step.name, Role::Step))
        .map(|it| Target::new(Side::Spec, it.span, it.span))
        .collect()
}

/// The elements that write a value to a step register; the register's
/// declaration where none does.
fn values(pair: Pair<'_>, state: &Name) -> Vec<Target> {
    let Some(ladder) = pair.ladder else {
        return Vec::new();
    };
    let registers = ladder.analysis.registers.iter();
    let written = registers.flat_map(|register| {
        let arcs = register.arcs.iter();
        let here = arcs.filter(|arc| register.state_name(arc.to) == *state);
        here.flat_map(|arc| &arc.written_at)
    });
    let written = written.map(|(_, span)| Target::new(Side::Ladder, *span, *span));
    first(vec![
        written.collect(),
        declared(pair, Side::Ladder, &Subject::Value(state.clone())),
    ])
}

fn routine(ladder: &Ladder, at: usize) -> Vec<Target> {
    let Some(routine) = ladder.program().routines.get(at) else {
        return Vec::new();
    };
    let name = ladder.routine_name(routine);
    let name = name.unwrap_or(Span::at(routine.span.range().start));
    vec![Target::new(Side::Ladder, routine.span, name)]
}

fn labels(ladder: &Ladder, routine: usize, name: &Name) -> Vec<Target> {
    let routine = ladder.program().routines.get(routine);
    let rungs = routine.into_iter().flat_map(|it| &it.rungs);
    let elements = rungs.flat_map(|rung| rung.network.elements().map(move |(_, it)| (rung, it)));
    let labels = elements.filter_map(|(rung, it)| match &it.kind {
        ElementKind::Label(label) if label.name == *name => {
            Some((rung.place(it.within), rung.place(label.within)))
        }
        _ => None,
    });
    labels
        .map(|(whole, name)| Target::new(Side::Ladder, whole, name))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Fixture, LADDER, SPEC, with_cursor};
    use super::*;

    fn shown(fixture: &Fixture, jump: Option<Jump>) -> Vec<String> {
        let to = jump.map_or(Vec::new(), |it| it.to);
        to.iter()
            .map(|it| fixture.show(it.side, it.whole))
            .collect()
    }

    /// Where the definition of what is at the cursor is.
    fn defined(ladder: &str, spec: &str) -> Vec<String> {
        let fixture = Fixture::new(ladder, spec);
        let jump = definition(fixture.pair(), fixture.side, fixture.offset);
        shown(&fixture, jump)
    }

    fn from_ladder(context: &str) -> Vec<String> {
        defined(&with_cursor(LADDER, context), SPEC)
    }

    fn from_spec(context: &str) -> Vec<String> {
        defined(LADDER, &with_cursor(SPEC, context))
    }

    #[test]
    fn a_contact_leads_to_its_coil_and_an_input_to_its_declaration() {
        assert_eq!(from_ladder("s + v$01"), ["ladder 4: v1"]);
        assert_eq!(from_ladder("($0s + v1"), ["ladder 1: input s"]);
        assert_eq!(from_ladder("output v$01"), ["ladder 4: v1"]);
    }

    #[test]
    fn a_coil_leads_to_its_step_and_without_one_to_its_declaration_or_itself() {
        assert_eq!(from_ladder("-> v$01"), ["spec 1: Xv1"]);
        assert_eq!(
            defined("output v1 // Fill\nrung: a -> v$01", ""),
            ["ladder 1: output v1"]
        );
        assert_eq!(from_ladder("-> l$0amp"), ["ladder 6: lamp"]);
    }

    #[test]
    fn a_step_and_a_state_lead_to_the_coil() {
        assert_eq!(from_spec("@X$0v1"), ["ladder 4: v1"]);
        assert_eq!(from_spec("for $0v1"), ["ladder 4: v1"]);
        assert_eq!(from_spec("-> v$02"), ["ladder 5: v2"]);
        assert_eq!(from_spec("t1: X$00"), ["spec 1: X0"]);
        assert_eq!(from_spec("X0*$0s"), ["ladder 1: input s"]);
    }

    #[test]
    fn a_transition_leads_to_its_rule_and_back() {
        assert_eq!(from_spec("Transition t$01"), ["spec 6: t1: X0*s |- @Xv1"]);
        assert_eq!(from_spec("\nt$01: X0"), ["spec 2: t1"]);
    }

    #[test]
    fn a_timer_is_found_from_its_output() {
        let ladder = "rung: a -> TON(t1, 5s)\nrung: t1$0.Q -> b";
        assert_eq!(defined(ladder, ""), ["ladder 1: TON(t1, 5s)"]);
    }

    #[test]
    fn jumps_lead_to_labels_and_calls_to_routines() {
        let ladder = "rung: a -> jump ag$0ain\nrung label again: b -> c";
        assert_eq!(defined(ladder, ""), ["ladder 2: again"]);
        let ladder = "rung: 1 -> call Do$0ors\n\nroutine Doors\nrung: b -> c";
        assert_eq!(
            defined(ladder, ""),
            ["ladder 3: routine Doors\nrung: b -> c"]
        );
        let ladder = "rung: 1 -> jump no$0where";
        assert_eq!(defined(ladder, ""), [""; 0]);
    }

    const REGISTER: &str = "\
rung: Seq = 0 * go -> Seq := 10
rung: Seq = 10 * done -> Seq := 20
rung: Seq = 20 * back -> Seq := 0
";

    #[test]
    fn a_value_of_a_register_leads_to_what_writes_it() {
        assert_eq!(
            defined(REGISTER, "Step X for Se$0q=10"),
            ["ladder 1: Seq := 10"]
        );
        let ladder = with_cursor(REGISTER, "Seq = 1$00");
        assert_eq!(defined(&ladder, "Step X for Seq=10"), ["spec 1: X"]);
    }

    #[test]
    fn declarations_stay_in_the_text() {
        let declared = |ladder: &str, spec: &str| {
            let fixture = Fixture::new(ladder, spec);
            let jump = declaration(fixture.pair(), fixture.side, fixture.offset);
            shown(&fixture, jump)
        };
        let spec = with_cursor(SPEC, "@X$0v1");
        assert_eq!(declared(LADDER, &spec), ["spec 1: Xv1"]);
        let ladder = with_cursor(LADDER, "-> v$01");
        assert_eq!(declared(&ladder, SPEC), ["ladder 3: output v1 %Q0"]);
        // Nothing declares these.
        let ladder = "rung: d1.E1 * a -> b\nrung: c -> set d1.E1\nrung: $0d1.E1 -> reset d1.E1";
        assert_eq!(declared(ladder, ""), ["ladder 2: set d1.E1"]);
        let ladder = "rung: a -> TON(t1, 5s)\nrung: t1$0.Q -> b";
        assert_eq!(declared(ladder, ""), ["ladder 1: TON(t1, 5s)"]);
        assert_eq!(declared("rung: $0a -> b", ""), [""; 0]);
    }
}
