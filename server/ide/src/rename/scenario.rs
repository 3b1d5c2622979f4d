//! Renaming in scenarios: from one, and in all that name what is renamed.

use grafcet::Role;
use logic::notation::TokenKind;
use logic::{Budget, Name};
use source::{Edit, Span};

use super::written::{variable_called, within_quotes};
use super::{Own, Refusal, Renamable, Renaming, Target, renamable, rename_target};
use crate::navigate::Pair;
use crate::statement::{code, line, lines};
use crate::{Scenario, StepName, edited, scenario::variable};

/// What can be renamed at the byte `offset` of a scenario; `None` where no name
/// stands.
pub fn renamable_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    offset: usize,
) -> Option<Result<Renamable, Refusal>> {
    Some(target(scenario, pair, offset)?.map(renamable))
}

/// Renames what stands at the byte `offset` of a scenario in the ladder and in
/// the spec; [`edits_in_scenario`] does it in scenarios.
pub fn rename_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    offset: usize,
    new: &str,
    budget: &Budget,
) -> Option<Result<Renaming, Refusal>> {
    let target = target(scenario, pair, offset)?;
    Some(target.and_then(|(target, _)| rename_target(&target, pair.ladder, pair.spec, new, budget)))
}

fn target(
    scenario: &Scenario,
    pair: Pair<'_>,
    offset: usize,
) -> Option<Result<(Target, Span), Refusal>> {
    let named = scenario.name_at(offset)?;
    let text = scenario.text.get(named.span.range())?;
    let inner = within_quotes(text, named.span);
    let refused = |message: String| Some(Err(Refusal(message)));
    if let Some(ladder) = pair.ladder
        && let Some(known) = variable(ladder, named.name)
    {
        let found = match variable_called(ladder, &known)? {
            Ok(found) => found,
            Err(refusal) => return Some(Err(refusal)),
        };
        if !named.name.starts_with(&*found.name) {
            return refused(format!(
                "`{}` is the address of `{}`; rename it where that name stands",
                named.name, found.name
            ));
        }
        let start = inner.range().start;
        let span = Span::new(start, (start + found.name.len()).min(inner.range().end));
        return Some(Ok((Target::Variable(found), span)));
    }
    let places = pair.spec.map(|spec| &spec.reading.places);
    let role = [Role::Step, Role::Variable].into_iter().find(|role| {
        let mut mentions = places.into_iter().flat_map(|it| &it.mentions);
        mentions.any(|it| it.role == *role && it.name == *named.name)
    });
    match role {
        Some(role) => {
            let own = Own {
                name: named.name.clone(),
                role,
                part: None,
            };
            Some(Ok((Target::Own(own), inner)))
        }
        None => refused(format!(
            "neither the ladder nor the spec has a `{}`",
            named.name
        )),
    }
}

/// The edits that give the names of a scenario which runs on the ladder and the
/// spec their new names.
pub fn edits_in_scenario(scenario: &Scenario, renaming: &Renaming) -> Result<Vec<Edit>, Refusal> {
    let renamed = |it: &StepName<'_>| new_name(it.name, renaming);
    let mut others = scenario.names().filter(|it| renamed(it).is_none());
    let is_taken = |name: &Name| renaming.names.values().any(|new| new == name);
    if let Some(taken) = others.find(|it| is_taken(it.name)) {
        return Err(Refusal(format!(
            "a scenario speaks of a `{}` already",
            taken.name
        )));
    }
    if let Some((name, line)) = not_understood(scenario, renaming) {
        return Err(Refusal(format!(
            "`{name}` also stands in line {line}, where it cannot be renamed safely"
        )));
    }
    let edits = scenario.names().filter_map(|it| {
        Some(Edit {
            span: it.span,
            text: ::scenario::spelled(&renamed(&it)?),
        })
    });
    let edits: Vec<Edit> = edits.collect();
    let again = Scenario::read(edited(&scenario.text, &edits).into());
    let wanted = scenario
        .names()
        .map(|it| renamed(&it).unwrap_or_else(|| it.name.to_string()));
    let says_the_same = wanted.eq(again.names().map(|it| it.name.to_string()))
        && scenario.reading.diagnostics.len() == again.reading.diagnostics.len();
    match says_the_same {
        true => Ok(edits),
        false => Err(Refusal(
            "with that name a scenario would say something else".to_owned(),
        )),
    }
}

/// A name that would be renamed, in a line that was not understood, and that line,
/// from 1.
fn not_understood(scenario: &Scenario, renaming: &Renaming) -> Option<(String, usize)> {
    let text = &*scenario.text;
    let broken = scenario.reading.diagnostics.iter();
    let mut tokens = broken.flat_map(|it| code(text, line(text, it.span.range().start)));
    let token = tokens.find(|token| {
        let is_name = matches!(token.kind, TokenKind::Name | TokenKind::Quoted);
        is_name && new_name(&token.name(text).into(), renaming).is_some()
    })?;
    let before = text.get(..token.span.range().start)?;
    let number = lines(before).len();
    Some((token.name(text).to_owned(), number))
}

/// What a name in a scenario becomes, if it is renamed or a part of what is.
fn new_name(name: &Name, renaming: &Renaming) -> Option<String> {
    let wholes = name.match_indices(['.', '[']).map(|(at, _)| &name[..at]);
    let wholes = std::iter::once(&**name).chain(wholes);
    let mut found = wholes.filter_map(|whole| {
        let new = renaming.names.get(whole)?;
        Some(format!("{new}{}", &name[whole.len()..]))
    });
    found.next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::tests_of_runs::{LADDER, SPEC, Tank};

    const FILLED: &str = "on s => on v1, on Xv1, on \"v1\"\non %I1 => off %Q0  // v1\n";

    /// Ladder, spec and scenario after what is at `$0` of the scenario was
    /// called `new`; or why it was not.
    fn renamed(text: &str, new: &str) -> Result<[String; 3], String> {
        let offset = text.find("$0").expect("a cursor");
        let tank = Tank::new(LADDER, SPEC, &text.replace("$0", ""));
        let (pair, scenario) = (tank.pair(), &tank.scenario);
        let renaming = rename_in_scenario(scenario, pair, offset, new, &Budget::default());
        let renaming = renaming.expect("a name").map_err(|refusal| refusal.0)?;
        let edits = edits_in_scenario(scenario, &renaming).map_err(|refusal| refusal.0)?;
        Ok([
            edited(&tank.ladder.text, &renaming.ladder),
            edited(&tank.spec.text, &renaming.spec),
            edited(&scenario.text, &edits),
        ])
    }

    fn at(context: &str) -> String {
        FILLED.replacen(&context.replace("$0", ""), context, 1)
    }

    #[test]
    fn a_variable_is_renamed_everywhere_with_its_step() {
        let [ladder, spec, scenario] = renamed(&at("on v$01"), "fill valve").expect("renamed");
        assert_eq!(ladder, LADDER.replace("v1", "\"fill valve\""));
        assert!(
            spec.contains("Step X0, \"Xfill valve\" for \"fill valve\"\n"),
            "{spec}"
        );
        assert_eq!(
            scenario,
            "on s => on \"fill valve\", on \"Xfill valve\", on \"fill valve\"\n\
             on %I1 => off %Q0  // v1\n"
        );
    }

    #[test]
    fn a_step_is_renamed_in_the_spec_alone() {
        let [ladder, spec, scenario] = renamed(&at("on X$0v1"), "Filling").expect("renamed");
        assert_eq!(ladder, LADDER);
        assert_eq!(spec, SPEC.replace("Xv1", "Filling"));
        assert_eq!(scenario, FILLED.replace("Xv1", "Filling"));
    }

    #[test]
    fn words_and_members_keep_their_meaning() {
        let [_, _, scenario] = renamed(&at("on s$0 "), "only").expect("renamed");
        assert_eq!(scenario, FILLED.replace("on s ", "on \"only\" "));
        let ladder = "input a\nrung: a -> TON(t1, 5s)\nrung: t1.Q -> b\n";
        let tank = Tank::new(ladder, "", "on a => off t1.Q\n");
        let offset = tank.scenario.text.find("1.Q").expect("in the text");
        let (scenario, pair) = (&tank.scenario, tank.pair());
        let found = renamable_in_scenario(scenario, pair, offset).expect("a name");
        let found = found.expect("a timer");
        assert_eq!(&scenario.text[found.span.range()], "t1");
        let renaming = rename_in_scenario(scenario, pair, offset, "mix", &Budget::default());
        let renaming = renaming.expect("a name").expect("renamed");
        let edits = edits_in_scenario(scenario, &renaming).expect("renamed");
        assert_eq!(edited(&scenario.text, &edits), "on a => off mix.Q\n");
    }

    #[test]
    fn what_cannot_be_renamed_is_refused_with_a_sentence() {
        let refused = |context: &str, new: &str| renamed(&at(context), new).expect_err("a refusal");
        assert_eq!(refused("on v$01", "s"), "the ladder has a `s` already");
        assert_eq!(
            refused("off %Q$00", "fill"),
            "`%Q0` is the address of `v1`; rename it where that name stands"
        );
        assert_eq!(
            refused("on %I$01", "x"),
            "neither the ladder nor the spec has a `%I1`"
        );
        let text = "on s => on $0v1\r\nof s\r\nof v1 => on X\r\n";
        assert_eq!(
            renamed(text, "fill").expect_err("a refusal"),
            "`v1` also stands in line 3, where it cannot be renamed safely"
        );
        let text = "on s => on $0v1, off fill\n";
        assert_eq!(
            renamed(text, "fill").expect_err("a refusal"),
            "a scenario speaks of a `fill` already"
        );
    }
}
