//! Charts of step registers: one step a value, one transition an arc.

use grafcet::{Chart, Step, Transition};

use super::decisions::Accepted;
use super::naming::{Names, short};
use super::wording::Wording;
use crate::Analysis;

/// Names the steps of every register: `Index_10` for value 10 of
/// `Milling_1.Index`.
pub(super) fn name_steps(analysis: &Analysis, names: &mut Names, wording: &mut Wording<'_>) {
    for register in &analysis.registers {
        for state in &register.states {
            let step = names.step(&format!("{}_{}", short(&register.name), state.value));
            wording.stands_for_value(register, state.value, step);
        }
    }
}

/// Draws the registers' charts. Their arcs are exact and wait for no
/// decision; one that was rejected is left out.
pub(super) fn draw(
    analysis: &Analysis,
    accepted: &Accepted,
    names: &mut Names,
    wording: &Wording<'_>,
    chart: &mut Chart,
) {
    for register in &analysis.registers {
        let steps = wording.steps_of_register(&register.name);
        let step_of = |value: i64| {
            let found = steps.iter().find(|(v, _)| *v == value);
            found.map(|(_, name)| name.clone())
        };
        for state in &register.states {
            let Some(name) = step_of(state.value) else {
                continue;
            };
            chart.steps.push(Step {
                initial: state.value == register.start,
                state: Some(register.state_name(state.value)),
                comment: state.title.clone(),
                ..Step::new(name)
            });
        }
        for arc in &register.arcs {
            let pair = (register.state_name(arc.from), register.state_name(arc.to));
            let (Some(from), Some(to)) = (step_of(arc.from), step_of(arc.to)) else {
                continue;
            };
            if accepted.rejected.contains(&pair) {
                continue;
            }
            let name = names.transition(&format!("{from}_to_{}", arc.to));
            let receptivity = wording.say_or_name(&arc.condition, &name);
            chart
                .transitions
                .push(Transition::new(name, from, to, receptivity));
        }
    }
}
