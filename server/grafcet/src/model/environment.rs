use logic::{Expr, Name};

/// A rule about what the plant can do: whenever the left side holds, the right
/// side holds.
///
/// Plain names are values of scan k: inputs as latched, outputs as the ladder
/// published them. A name marked by [`in_next_scan`] is the input of scan k+1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnvironmentRule {
    /// Its label.
    pub name: Name,
    /// What holds.
    pub left: Expr,
    /// What must hold then; names of the next scan are marked.
    pub right: Expr,
    /// Why it is so.
    pub comment: Option<Name>,
}

/// Something that must never hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its label.
    pub name: Name,
    /// What must never hold.
    pub condition: Expr,
    /// Why.
    pub comment: Option<Name>,
}

/// The sign that marks a name of the next scan. No variable can be called so:
/// the notation has `@` as an operator.
const NEXT: char = '@';

/// The name that stands for `name` in the next scan: `@tl`, in the rule as in
/// the model.
pub fn in_next_scan(name: &str) -> Name {
    format!("{NEXT}{name}").into()
}

/// The variable that a marked name speaks of in the next scan, if it is
/// marked.
pub fn is_in_next_scan(name: &str) -> Option<&str> {
    name.strip_prefix(NEXT)
}
