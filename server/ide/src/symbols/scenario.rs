use source::Span;

use super::{Symbol, SymbolKind, title};
use crate::Scenario;

/// The scenario under its title, and its steps.
pub fn symbols_of_scenario(scenario: &Scenario) -> Vec<Symbol> {
    let steps = scenario.steps().iter().map(|step| {
        let expected = ::scenario::expected(step);
        let comment = step.comment.as_deref().map(title).unwrap_or_default();
        let said = [expected, comment].into_iter().filter(|it| !it.is_empty());
        let said: Vec<String> = said.collect();
        let done = ::scenario::done(step);
        Symbol::new(SymbolKind::ScenarioStep, done, step.span, step.span)
            .detailed(title(&said.join("  ")))
    });
    let steps = steps.collect();
    match (&scenario.reading.scenario.title, scenario.heading()) {
        (Some(name), Some(heading)) => vec![Symbol {
            children: steps,
            ..Symbol::new(
                SymbolKind::Scenario,
                &**name,
                Span::new(0, scenario.text.len()),
                heading,
            )
        }],
        _ => steps,
    }
}

#[cfg(test)]
mod tests {
    use super::super::drawn;
    use super::*;

    fn outline(text: &str) -> String {
        drawn(&symbols_of_scenario(&Scenario::read(text.into())), text, 0)
    }

    #[test]
    fn steps_stand_under_the_title() {
        let text = "scenario \"Filled\"\non s =>only on v1 // goes\nwait 5s\n";
        assert_eq!(
            outline(text),
            "\
Scenario Filled | - | \"Filled\"
  ScenarioStep on s | only on v1  goes | on s =>only on v1
  ScenarioStep wait 5s | - | wait 5s
"
        );
        assert_eq!(outline("on s\n"), "ScenarioStep on s | - | on s\n");
        assert_eq!(outline(""), "");
    }
}
