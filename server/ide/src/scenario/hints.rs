//! What stands behind the steps of a scenario, and, of a scan that somebody
//! chose, behind the contacts of the ladder and the steps of the spec.

use ::ladder::ElementKind;
use grafcet::Role;
use logic::notation::{quoted, time};
use logic::{Datum, Name};
use recovery::simulation::{Moment, Row, Simulation};
use source::Span;

use super::{Run, Scenario};
use crate::navigate::Pair;
use crate::{Hint, Ladder, Spec};

/// Longer lists are cut, for a hint must not push the text away.
const LONGEST: usize = 60;

/// What a contact or coil that passes power on is marked by.
const POWERED: &str = "●";

/// Behind each step within `span` what is on when it is over: the outputs of
/// the ladder, the active steps of the spec, and in what the two differ.
pub fn hints_in_scenario(scenario: &Scenario, pair: Pair<'_>, run: &Run, span: Span) -> Vec<Hint> {
    let Some(simulation) = &run.simulation else {
        return Vec::new();
    };
    let ends = simulation.rows.iter().filter(|row| row.is_last);
    let hints = ends.filter_map(|row| {
        let place = scenario.steps().get(row.step)?.span;
        let is_here = span.start <= place.end && place.start <= span.end;
        is_here.then(|| Hint {
            offset: place.range().end,
            text: cut(&summary(simulation, pair, row)),
            detail: detail(simulation, pair, row),
        })
    });
    hints.collect()
}

fn summary(simulation: &Simulation, pair: Pair<'_>, row: &Row) -> String {
    let mut parts = Vec::new();
    if pair.ladder.is_some() {
        parts.push(on(&simulation.ladder, &row.values.ladder));
    }
    if pair.spec.is_some() {
        parts.push(listed(&row.values.active));
    }
    if !row.differences.is_empty() {
        parts.push(format!("differ: {}", listed(&row.differences)));
    }
    parts.join(" · ")
}

fn detail(simulation: &Simulation, pair: Pair<'_>, row: &Row) -> String {
    let lines = fields(simulation, pair, row);
    let lines: Vec<String> = lines
        .into_iter()
        .map(|(label, value)| format!("{label}: {value}"))
        .collect();
    lines.join("\n")
}

/// All that there is to say about a scan, each with its label.
pub(crate) fn fields(
    simulation: &Simulation,
    pair: Pair<'_>,
    row: &Row,
) -> Vec<(&'static str, String)> {
    let mut fields = vec![("scan", format!("{}, at {}", row.scan, time(row.time_ms)))];
    if pair.ladder.is_some() {
        fields.push(("ladder", on(&simulation.ladder, &row.values.ladder)));
    }
    if pair.spec.is_some() {
        fields.push(("active steps", listed(&row.values.active)));
        fields.push(("spec", on(&simulation.grafcet, &row.values.grafcet)));
    }
    if !row.differences.is_empty() {
        fields.push(("differ", listed(&row.differences)));
    }
    fields
}

/// The variables that are on, numbers with their values.
fn on(names: &[Name], values: &[Datum]) -> String {
    let all = names.iter().zip(values).filter(|(_, value)| value.is_on());
    let on: Vec<String> = all
        .map(|(name, value)| match value {
            Datum::Bool(_) => quoted(name),
            number => format!("{}={number}", quoted(name)),
        })
        .collect();
    match on.is_empty() {
        true => "nothing on".to_owned(),
        false => on.join(" "),
    }
}

fn listed(names: &[Name]) -> String {
    match names {
        [] => "none".to_owned(),
        names => {
            let names: Vec<String> = names.iter().map(|name| quoted(name)).collect();
            names.join(" ")
        }
    }
}

fn cut(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{}…", text[..at].trim_end()),
        None => text.to_owned(),
    }
}

/// The contacts, coils and boxes of a ladder within `span` through which power
/// went in the scan of `moment`.
pub fn powered_in_ladder(ladder: &Ladder, moment: &Moment<'_>, span: Span) -> Vec<Hint> {
    let mut hints = Vec::new();
    for (at, routine) in ladder.program().routines.iter().enumerate() {
        for (nth, rung) in routine.rungs.iter().enumerate() {
            if rung.span.end < span.start || span.end < rung.span.start {
                continue;
            }
            let Some(power) = moment.power(at, nth) else {
                continue;
            };
            for (element, it) in rung.network.elements().skip(1) {
                let (is_on, detail) = match &it.kind {
                    ElementKind::Contact(_) | ElementKind::Comparison(_) => {
                        (power.after(element), "passes power on in this scan")
                    }
                    _ => (power.at(element), "gets power in this scan"),
                };
                if is_on {
                    hints.push(Hint {
                        offset: rung.place(it.within).range().end,
                        text: POWERED.to_owned(),
                        detail: detail.to_owned(),
                    });
                }
            }
        }
    }
    hints.sort_by_key(|hint| hint.offset);
    hints.dedup_by_key(|hint| hint.offset);
    hints
}

/// The steps of a spec within `span` that are active after the scan of
/// `moment`, where they are declared.
pub fn situation_in_spec(spec: &Spec, moment: &Moment<'_>, span: Span) -> Vec<Hint> {
    let active: Vec<&Name> = moment.active().collect();
    let mentions = spec.reading.places.mentions.iter();
    let here = mentions.filter(|it| {
        let is_here = span.start <= it.span.end && it.span.start <= span.end;
        it.declares && it.role == Role::Step && is_here && active.contains(&&it.name)
    });
    let hints = here.map(|it| Hint {
        offset: it.span.range().end,
        text: format!("{POWERED} active"),
        detail: format!("{} is active after this scan", it.name),
    });
    hints.collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests_of_runs::{LADDER, SCENARIO, SPEC, Tank};
    use super::*;

    /// A text with its hints between `«` and `»`.
    fn shown(text: &str, hints: &[Hint]) -> String {
        let mut out = text.to_owned();
        for hint in hints.iter().rev() {
            out.insert_str(hint.offset, &format!("«{}»", hint.text));
        }
        out
    }

    #[test]
    fn behind_a_step_stands_what_is_on_after_it() {
        let tank = Tank::new(LADDER, SPEC, SCENARIO);
        let all = Span::new(0, SCENARIO.len());
        let run = tank.run();
        let hints = hints_in_scenario(&tank.scenario, tank.pair(), &run, all);
        assert_eq!(
            shown(SCENARIO, &hints),
            "\
on s => on v1«v1 · Xv1»
off s, scan 3 => on v1«v1 · Xv1»
on ls2 => off v1«nothing on · X0»
"
        );
        assert_eq!(
            hints[1].detail,
            "scan: 4, at 40ms\nladder: v1\nactive steps: Xv1\nspec: v1"
        );
        let here = Span::at(SCENARIO.len() - 2);
        let hints = hints_in_scenario(&tank.scenario, tank.pair(), &run, here);
        assert_eq!(hints.len(), 1);
    }

    #[test]
    fn what_differs_is_said_and_long_lists_are_cut() {
        let idle = SPEC.replace("Xv1: |- v1\n", "");
        let tank = Tank::new(LADDER, &idle, SCENARIO);
        let all = Span::new(0, SCENARIO.len());
        let hints = hints_in_scenario(&tank.scenario, tank.pair(), &tank.run(), all);
        assert_eq!(hints[0].text, "v1 · Xv1 · differ: v1");
        assert_eq!(cut(&"v1 ".repeat(40)).chars().count(), LONGEST);
    }

    #[test]
    fn power_is_shown_where_it_went_in_the_scan() {
        let tank = Tank::new(LADDER, SPEC, SCENARIO);
        let powered = |step: usize| {
            let moment = tank.moment(step);
            let all = Span::new(0, LADDER.len());
            shown(LADDER, &powered_in_ladder(&tank.ladder, &moment, all))
        };
        let rung = |text: String| text.lines().last().map(str::to_owned);
        assert_eq!(
            rung(powered(0)).as_deref(),
            Some("rung: (s«●» + v1) * /ls2«●» -> v1«●»")
        );
        assert_eq!(
            rung(powered(1)).as_deref(),
            Some("rung: (s + v1«●») * /ls2«●» -> v1«●»")
        );
        assert_eq!(
            rung(powered(2)).as_deref(),
            Some("rung: (s + v1«●») * /ls2 -> v1")
        );
    }

    #[test]
    fn active_steps_are_shown_where_they_are_declared() {
        let tank = Tank::new(LADDER, SPEC, SCENARIO);
        let situation = |step: usize| {
            let moment = tank.moment(step);
            let all = Span::new(0, SPEC.len());
            let text = shown(SPEC, &situation_in_spec(&tank.spec, &moment, all));
            text.lines().next().map(str::to_owned)
        };
        assert_eq!(
            situation(1).as_deref(),
            Some("Step X0, Xv1«● active» for v1")
        );
        assert_eq!(
            situation(2).as_deref(),
            Some("Step X0«● active», Xv1 for v1")
        );
    }
}
