use grafcet::{Chart, Step, Transition};

use super::Plan;
use crate::Analysis;
use crate::conversion::naming::Names;
use crate::conversion::wording::Wording;

impl Plan {
    /// Draws the plan into `chart`.
    pub(in crate::conversion) fn draw(
        &self,
        analysis: &Analysis,
        names: &mut Names,
        wording: &Wording<'_>,
        chart: &mut Chart,
    ) {
        for step in &self.steps {
            let state = step.state.and_then(|atom| analysis.states().state(atom));
            chart.steps.push(Step {
                initial: step.initial,
                state: state.map(|state| state.name.clone()),
                comment: match state {
                    Some(state) => analysis.description(&state.name),
                    None => step.comment.clone(),
                },
                ..Step::new(step.name.clone())
            });
        }
        for arc in &self.arcs {
            let name = names.transition(&arc.label);
            let receptivity = wording.say_or_name(&arc.condition, &name);
            chart.transitions.push(Transition {
                name,
                from: arc.from.clone(),
                to: arc.to.clone(),
                receptivity,
                comment: None,
            });
        }
    }
}
