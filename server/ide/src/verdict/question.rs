//! What a proof is about.

use std::sync::Arc;

use grafcet::Chart;
use ladder::{Declaration, Program, Routine};

use crate::{Ladder, Spec};

/// All of a ladder and a spec that can tell on whether the two do the same:
/// neither where things stand nor what comments and decisions say.
///
/// Two questions that are the same have the same answer, so that nobody need
/// prove anything again because a remark was written. What is typed inside a rung
/// counts as a change, blanks included: places in its network move.
#[derive(Clone, Debug)]
pub struct Question {
    program: Arc<Program>,
    spec: grafcet::Spec,
}

impl Question {
    /// The question about a ladder and the spec beside it.
    pub fn of(ladder: &Ladder, spec: &Spec) -> Self {
        Self {
            program: Arc::clone(&ladder.analysis.program),
            spec: bare(&spec.reading.spec),
        }
    }
}

impl PartialEq for Question {
    fn eq(&self, other: &Self) -> bool {
        same_program(&self.program, &other.program) && self.spec == other.spec
    }
}

/// A spec without what is for people only.
fn bare(spec: &grafcet::Spec) -> grafcet::Spec {
    let mut bare = spec.clone();
    bare.decisions.clear();
    let grafcet = &mut bare.grafcet;
    grafcet.name = None;
    let variables = [
        &mut grafcet.inputs,
        &mut grafcet.outputs,
        &mut grafcet.internals,
    ];
    for variable in variables.into_iter().flatten() {
        variable.comment = None;
    }
    let parts = grafcet.parts.iter_mut().map(|part| &mut part.chart);
    for chart in parts.chain([&mut grafcet.chart]) {
        strip(chart);
    }
    for instance in &mut grafcet.instances {
        instance.comment = None;
    }
    for rule in &mut bare.environment {
        rule.comment = None;
    }
    for property in &mut bare.never {
        property.comment = None;
    }
    bare
}

fn strip(chart: &mut Chart) {
    for step in &mut chart.steps {
        step.comment = None;
        step.state = None;
    }
    for transition in &mut chart.transitions {
        transition.comment = None;
    }
    for action in &mut chart.actions {
        action.comment = None;
    }
}

/// Whether two programs do the same, told by what they consist of.
fn same_program(a: &Arc<Program>, b: &Arc<Program>) -> bool {
    Arc::ptr_eq(a, b)
        || a.format == b.format
            && a.charts == b.charts
            && (a.declarations.is_moved(&b.declarations)
                || same(
                    a.declarations.iter(),
                    b.declarations.iter(),
                    declares_the_same,
                ))
            && same(a.routines.iter(), b.routines.iter(), same_routine)
}

fn same<'p, T: 'p>(
    mut a: impl ExactSizeIterator<Item = &'p T>,
    mut b: impl ExactSizeIterator<Item = &'p T>,
    same: impl Fn(&T, &T) -> bool,
) -> bool {
    a.len() == b.len() && a.by_ref().zip(b.by_ref()).all(|(a, b)| same(a, b))
}

fn declares_the_same(a: &Declaration, b: &Declaration) -> bool {
    a.name == b.name
        && a.address == b.address
        && a.class == b.class
        && a.data_type == b.data_type
        && a.initial == b.initial
}

fn same_routine(a: &Routine, b: &Routine) -> bool {
    a.scope == b.scope
        && a.unit == b.unit
        && a.name == b.name
        && a.role == b.role
        && same(a.rungs.iter(), b.rungs.iter(), |a, b| {
            Arc::ptr_eq(&a.network, &b.network) || a.network == b.network
        })
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;
    use crate::scenario::tests_of_runs::{LADDER, SPEC};

    fn question(ladder: &str, spec: &str) -> Question {
        let ladder = Ladder::read(ladder.into(), &Budget::default());
        Question::of(&ladder, &Spec::read(spec.into()))
    }

    #[test]
    fn remarks_blanks_and_decisions_ask_nothing_new() {
        let ladder = format!("// A tank\nprogram Tank\n{LADDER}")
            .replace("output v1 %Q0", "output  v1 %Q0 // Fill")
            .replace("rung:", "\n// Up to ls2\nrung:");
        let spec = format!("{SPEC}//! accept v1 -> v1\n").replace("@X0", "@X0 // It is full");
        assert!(question(&ladder, &spec) == question(&format!("program Tank\n{LADDER}"), SPEC));
    }

    #[test]
    fn whatever_can_tell_on_the_answer_asks_something_new() {
        let asked = question(LADDER, SPEC);
        for (old, new) in [
            ("/ls2 -> v1", "ls2 -> v1"),
            ("%Q0", "%Q1"),
            ("input s\n", "input s\ninput t\n"),
            ("-> v1\n", "-> v1\nrung: s -> v2\n"),
        ] {
            assert!(
                asked != question(&LADDER.replacen(old, new, 1), SPEC),
                "{new}"
            );
        }
        for (old, new) in [
            ("Marking X0", "Marking Xv1"),
            ("Xv1*ls2", "Xv1*/ls2"),
            ("|- v1", "ls2 |- v1"),
            ("Steps:", "Never:\nn1: v1\nSteps:"),
            ("Steps:", "Environment:\ne1: s |- ls2\nSteps:"),
        ] {
            assert!(
                asked != question(LADDER, &SPEC.replacen(old, new, 1)),
                "{new}"
            );
        }
    }
}
