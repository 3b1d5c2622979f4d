use ::ladder::Class;
use grafcet::Role;
use logic::Name;

use super::{Scenario, variable};
use crate::navigate::Pair;
use crate::tokens::{Mark, Marks, Token, TokenKind, apart};

/// The names of a scenario, in the order of the text, as what the ladder and the
/// spec have under them: a coil, a step, a variable. Names that neither knows
/// are left out.
pub fn tokens_in_scenario(scenario: &Scenario, pair: Pair<'_>) -> Vec<Token> {
    let tokens = scenario.names().filter_map(|named| {
        let (kind, mut marks) = of_name(pair, named.name)?;
        if named.is_driven {
            marks = marks.with(Mark::Modification);
        }
        Some(Token {
            span: named.span,
            kind,
            marks,
        })
    });
    apart(tokens.collect(), &scenario.text)
}

fn of_name(pair: Pair<'_>, name: &Name) -> Option<(TokenKind, Marks)> {
    let mut marks = Marks::default();
    if let Some(ladder) = pair.ladder
        && let Some(known) = variable(ladder, name)
    {
        let declared = ladder.program().declarations.find(&known);
        if declared.is_some_and(|it| it.class == Class::Constant) {
            marks = marks.with(Mark::Readonly);
        }
        if ladder.analysis.states().find(&known).is_some() {
            marks = marks.with(Mark::State);
        }
        let is_coil = ladder.analysis.conditions.find(&known).is_some();
        return Some(match is_coil {
            true => (TokenKind::Coil, marks),
            false => (TokenKind::Variable, marks),
        });
    }
    let spec = pair.spec?;
    let places = &spec.reading.places;
    if places.declaration(name, Role::Step).is_some() {
        return Some((TokenKind::EnumMember, marks));
    }
    let mut variables = spec.reading.spec.grafcet.variables();
    let is_known = variables.any(|it| it.name == *name || it.address.as_ref() == Some(name));
    is_known.then_some((TokenKind::Variable, marks))
}

#[cfg(test)]
mod tests {
    use super::super::tests_of_runs::{LADDER, SPEC, Tank};
    use super::*;

    #[test]
    fn names_are_what_the_ladder_and_the_spec_have_under_them() {
        let text = "on s, on what => on v1, on Xv1, off %Q0\n";
        let tank = Tank::new(LADDER, SPEC, text);
        let tokens = tokens_in_scenario(&tank.scenario, tank.pair());
        let shown = tokens.iter().map(|token| {
            let marks = Mark::ALL.into_iter().filter(|it| token.marks.has(*it));
            let marks: Vec<&str> = marks.map(Mark::word).collect();
            let word = token.kind.word();
            format!("{}: {word} {}", &text[token.span.range()], marks.join(" "))
        });
        assert_eq!(
            shown.collect::<Vec<_>>(),
            [
                "s: variable modification",
                "v1: coil state",
                "Xv1: enumMember ",
                "%Q0: coil state",
            ]
        );
    }
}
