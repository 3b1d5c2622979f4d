use ladder::TimerKind;
use logic::{Budget, Function, Stop};

/// What is known of a timer's output without knowing the time (semantics,
/// section 6): the output of an on-delay implies its input, the input of an
/// off-delay implies its output.
#[derive(Clone, Debug)]
pub struct TimerLaw {
    /// Which law.
    pub kind: TimerKind,
    /// The condition under which the timer is enabled.
    pub input: Result<Function, Stop>,
}

impl TimerLaw {
    /// What `output`, the atom of the timer's output, says in full: for an
    /// on-delay the atom and the input together.
    pub fn applied(&self, output: Function, budget: &Budget) -> Result<Function, Stop> {
        match (self.kind, &self.input) {
            (TimerKind::OnDelay, Ok(input)) => output.and(input, budget),
            _ => Ok(output),
        }
    }
}
