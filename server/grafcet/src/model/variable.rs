use logic::Name;

/// A variable that a grafcet reads or writes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Variable {
    /// Its name in rules.
    pub name: Name,
    /// Where it lives in the controller: `%I0`, `Local:1:I.Data.4`.
    pub address: Option<Name>,
    /// What it is for.
    pub comment: Option<Name>,
}

impl Variable {
    /// A variable with nothing but a name.
    pub fn new(name: impl Into<Name>) -> Self {
        Self {
            name: name.into(),
            address: None,
            comment: None,
        }
    }
}
