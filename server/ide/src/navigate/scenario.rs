//! From the names of a scenario to the ladder and the spec, and back.

use grafcet::Role;
use source::Span;

use super::definition::{declared_in_ladder, first, jump, writers};
use super::{Access, Jump, Pair, Side, Subject, Target};
use crate::scenario::{is_meant, meaning, variable};
use crate::{Ladder, Scenario, Spec};

/// What gives the thing at the byte `offset` of a scenario its value: the coils
/// of an output, the declaration of an input, the step of a step's variable.
pub fn definition_in_scenario(scenario: &Scenario, pair: Pair<'_>, offset: usize) -> Option<Jump> {
    let named = scenario.name_at(offset)?;
    let coils = pair.ladder.map_or(Vec::new(), |it| driving(it, named.name));
    let others = declared(pair, named.name);
    jump(named.span, first(vec![coils, others]))
}

/// Where the thing at the byte `offset` of a scenario is declared: in the
/// ladder, else in the spec. What nothing declares begins where a ladder first
/// writes it.
pub fn declaration_in_scenario(scenario: &Scenario, pair: Pair<'_>, offset: usize) -> Option<Jump> {
    let named = scenario.name_at(offset)?;
    let coils = pair.ladder.map_or(Vec::new(), |it| driving(it, named.name));
    let written = coils.into_iter().min().into_iter().collect();
    jump(named.span, first(vec![declared(pair, named.name), written]))
}

/// Every place of a subject in a scenario that runs on the pair: written where
/// it is driven, read where something is expected of it.
pub fn references_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    subject: &Subject,
) -> Vec<(Span, Access)> {
    let meant = scenario
        .names()
        .filter(|it| is_meant(pair, it.name, subject));
    let places = meant.map(|it| match it.is_driven {
        true => (it.span, Access::Written),
        false => (it.span, Access::Read),
    });
    places.collect()
}

/// The places in a scenario of what stands at its byte `offset`.
pub fn highlights_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    offset: usize,
) -> Vec<(Span, Access)> {
    let Some(named) = scenario.name_at(offset) else {
        return Vec::new();
    };
    let subject = meaning(pair, named.name);
    let same = scenario.names().filter(|it| {
        it.name == named.name || subject.is_some() && meaning(pair, it.name) == subject
    });
    let places = same.map(|it| match it.is_driven {
        true => (it.span, Access::Written),
        false => (it.span, Access::Read),
    });
    places.collect()
}

/// What drives a variable of a ladder that a scenario calls `name`.
pub(crate) fn driving(ladder: &Ladder, name: &logic::Name) -> Vec<Target> {
    variable(ladder, name).map_or(Vec::new(), |name| writers(ladder, &name))
}

/// What a spec says of a step or variable: its step, the actions that write it,
/// else its declaration.
pub(crate) fn standing(spec: &Spec, name: &logic::Name) -> Vec<Target> {
    let places = &spec.reading.places;
    let target = |span| Target::new(Side::Spec, span, span);
    if let Some(step) = places.declaration(name, Role::Step) {
        return vec![target(step.span)];
    }
    let same = places.mentions.iter();
    let same = same.filter(|it| it.role == Role::Variable && it.name == *name);
    let (mut written, mut declared) = (Vec::new(), Vec::new());
    for mention in same {
        if mention.written {
            written.push(target(mention.span));
        } else if mention.declares {
            declared.push(target(mention.span));
        }
    }
    first(vec![written, declared])
}

fn declared(pair: Pair<'_>, name: &logic::Name) -> Vec<Target> {
    let in_ladder = pair.ladder.map_or(Vec::new(), |ladder| {
        let name = variable(ladder, name);
        name.map_or(Vec::new(), |name| declared_in_ladder(ladder, &name))
    });
    let in_spec = pair.spec.map_or(Vec::new(), |it| standing(it, name));
    first(vec![in_ladder, in_spec])
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Fixture, LADDER, SPEC, with_cursor};
    use super::*;

    const FILLED: &str = "on s => on v1, on Xv1\non ls2 => off %Q0, on lamp, on nothing\n";

    /// The scenario with the texts that it runs on, and its cursor.
    fn at(context: &str) -> (Scenario, Fixture, usize) {
        let text = with_cursor(FILLED, context);
        let offset = text.find("$0").expect("a cursor");
        // The fixture wants a cursor of its own.
        let fixture = Fixture::new(&format!("$0{LADDER}"), SPEC);
        (Scenario::read(FILLED.into()), fixture, offset)
    }

    fn defined(context: &str) -> Vec<String> {
        let (scenario, fixture, offset) = at(context);
        let jump = definition_in_scenario(&scenario, fixture.pair(), offset);
        let to = jump.map_or(Vec::new(), |it| it.to);
        to.iter()
            .map(|it| fixture.show(it.side, it.whole))
            .collect()
    }

    #[test]
    fn an_output_leads_to_its_coil_and_an_input_to_its_declaration() {
        assert_eq!(defined("on v$01"), ["ladder 4: v1"]);
        assert_eq!(defined("%Q$00"), ["ladder 4: v1"]);
        assert_eq!(defined("on s$0"), ["ladder 1: input s"]);
        assert_eq!(defined("on Xv$01"), ["spec 1: Xv1"]);
        assert_eq!(defined("noth$0ing"), [""; 0]);
        assert_eq!(defined("$0=> on v1"), [""; 0]);
    }

    #[test]
    fn a_declaration_is_where_it_is_declared_or_first_written() {
        let declared = |context: &str| {
            let (scenario, fixture, offset) = at(context);
            let jump = declaration_in_scenario(&scenario, fixture.pair(), offset)?;
            Some(fixture.show(jump.to[0].side, jump.to[0].whole))
        };
        assert_eq!(
            declared("on v$01").as_deref(),
            Some("ladder 3: output v1 %Q0")
        );
        assert_eq!(declared("la$0mp").as_deref(), Some("ladder 6: lamp"));
    }

    #[test]
    fn a_state_its_address_and_its_step_are_one_thing() {
        let (scenario, fixture, offset) = at("on v$01");
        let shown = |found: Vec<(Span, Access)>| -> Vec<&str> {
            found.iter().map(|(it, _)| &FILLED[it.range()]).collect()
        };
        let subject = Subject::Variable("v1".into());
        let found = references_in_scenario(&scenario, fixture.pair(), &subject);
        assert_eq!(shown(found), ["v1", "Xv1", "%Q0"]);
        let lit = highlights_in_scenario(&scenario, fixture.pair(), offset);
        assert_eq!(shown(lit), ["v1", "Xv1", "%Q0"]);
        let (_, _, offset) = at("noth$0ing");
        let lit = highlights_in_scenario(&scenario, fixture.pair(), offset);
        assert_eq!(lit, [(Span::new(offset - 4, offset + 3), Access::Read)]);
    }
}
