//! A tank to try scenarios on.

use logic::Budget;
use recovery::simulation::Moment;

use super::{Run, Scenario};
use crate::navigate::Pair;
use crate::{Ladder, Spec};

pub(crate) const LADDER: &str = "\
input s
input ls2
output v1 %Q0
rung: (s + v1) * /ls2 -> v1
";

pub(crate) const SPEC: &str = "\
Step X0, Xv1 for v1
Transition t1, t2
Input s, ls2
Output v1
Marking X0
Transitions:
t1: X0*s*/ls2 |- @Xv1
t2: Xv1*ls2 |- @X0
Steps:
Xv1: |- v1
";

pub(crate) const SCENARIO: &str = "\
on s => on v1
off s, scan 3 => on v1
on ls2 => off v1
";

/// A ladder, its spec and a scenario; an empty text is not there.
pub(crate) struct Tank {
    pub(crate) ladder: Ladder,
    pub(crate) spec: Spec,
    pub(crate) scenario: Scenario,
}

impl Tank {
    pub(crate) fn new(ladder: &str, spec: &str, scenario: &str) -> Self {
        Self {
            ladder: Ladder::read(ladder.into(), &Budget::default()),
            spec: Spec::read(spec.into()),
            scenario: Scenario::read(scenario.into()),
        }
    }

    pub(crate) fn pair(&self) -> Pair<'_> {
        Pair {
            ladder: (!self.ladder.text.is_empty()).then_some(&self.ladder),
            spec: (!self.spec.text.is_empty()).then_some(&self.spec),
        }
    }

    pub(crate) fn run(&self) -> Run {
        Run::new(&self.scenario, self.pair(), &|| true)
    }

    /// What is in the tank after a step.
    #[track_caller]
    pub(crate) fn moment(&self, step: usize) -> Moment<'_> {
        let run = self.run();
        let scan = run.end_of(step).expect("a step that was done").scan;
        let moment = run.moment(&self.scenario, self.pair(), scan, &|| true);
        moment.expect("a step that was done")
    }
}
