use std::fmt::{self, Display, Formatter};

use logic::Name;
use logic::notation::quoted;

/// Why a scan had no result: transitions are cleared over and over, and no
/// stable situation is reached.
///
/// The standard calls this a total instability. Either the grafcet comes back
/// to where it was, or a stored action counts on without end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unstable {
    /// What is cleared over and over: the transitions of each evolution of the
    /// cycle, in their order. Empty for one in which only forcing orders act.
    pub cycle: Vec<Vec<Name>>,
    /// The steps that take part: activated or deactivated within the cycle, in
    /// the order they are declared.
    pub steps: Vec<Name>,
}

impl Display for Unstable {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let names = |names: &[Name], joint: &str| {
            let names: Vec<_> = names.iter().map(|name| quoted(name)).collect();
            names.join(joint)
        };
        let cycle: Vec<String> = self
            .cycle
            .iter()
            .map(|fired| match fired.is_empty() {
                true => "forcing".to_owned(),
                false => names(fired, " & "),
            })
            .collect();
        write!(f, "never becomes stable: {}", cycle.join(", "))?;
        f.write_str(", over and over")?;
        if !self.steps.is_empty() {
            write!(f, " (steps {})", names(&self.steps, ", "))?;
        }
        Ok(())
    }
}

impl std::error::Error for Unstable {}
