//! Facts about a plant, in words and as environment rules.

use grafcet::{EnvironmentRule, in_next_scan, is_in_next_scan};
use logic::notation::quoted;
use logic::{Atom, Expr, Name};

/// A variable that is on, or off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Literal {
    pub(super) name: Name,
    pub(super) on: bool,
}

impl Literal {
    fn expr(&self) -> Expr {
        let variable = Expr::variable(self.name.clone());
        if self.on {
            variable
        } else {
            variable.complement()
        }
    }

    fn in_next_scan(&self) -> Expr {
        let name = in_next_scan(&self.name);
        Self { name, on: self.on }.expr()
    }

    pub(super) fn complement(&self) -> Self {
        Self {
            name: self.name.clone(),
            on: !self.on,
        }
    }

    fn word(&self) -> &'static str {
        if self.on { "on" } else { "off" }
    }
}

/// Something that a plant never does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fact {
    /// Two inputs are never so in one scan.
    NotTogether(Literal, Literal),
    /// An input stays as it is while an output is so.
    StaysWhile(Literal, Literal),
    /// An input stays as it is as long as another one is so.
    StaysAsLongAs(Literal, Literal),
    /// An input is never so in the scan after one in which an output is so.
    NotAfter(Literal, Literal),
}

impl Fact {
    /// Whether it speaks of two scans.
    pub(super) fn is_about_two(&self) -> bool {
        !matches!(self, Self::NotTogether(..))
    }

    /// The two variables that it speaks of.
    pub(super) fn names(&self) -> [&Name; 2] {
        match self {
            Self::NotTogether(a, b)
            | Self::StaysWhile(a, b)
            | Self::StaysAsLongAs(a, b)
            | Self::NotAfter(a, b) => [&a.name, &b.name],
        }
    }

    /// The output that it speaks of, if it does.
    pub(super) fn output(&self) -> Option<&Name> {
        match self {
            Self::NotTogether(..) | Self::StaysAsLongAs(..) => None,
            Self::StaysWhile(_, output) | Self::NotAfter(_, output) => Some(&output.name),
        }
    }

    /// Whether it speaks of one of these.
    pub(super) fn is_about_any(&self, names: &[Name]) -> bool {
        self.names().into_iter().any(|name| names.contains(name))
    }

    /// How little it says, and how likely people find it to be a fact: less is
    /// better. Sensors imply each other, inputs stay as they are; that two
    /// buttons exclude each other is rarer, and that one of two is always on rarer
    /// still.
    pub(super) fn strangeness(&self) -> usize {
        match self {
            Self::NotTogether(a, b) if a.on != b.on => 0,
            Self::NotTogether(a, _) if a.on => 4,
            Self::NotTogether(..) => 5,
            Self::StaysWhile(..) => 1,
            Self::StaysAsLongAs(..) => 2,
            Self::NotAfter(..) => 3,
        }
    }

    /// The rule of that label that says it.
    pub(super) fn rule(&self, label: &Name) -> EnvironmentRule {
        let (left, right) = match self {
            Self::NotTogether(a, b) => {
                // `ls2 |- ls1`, whichever of the two is on.
                let (a, b) = if a.on { (a, b) } else { (b, a) };
                (a.expr(), b.complement().expr())
            }
            Self::StaysWhile(input, output) => (
                Expr::And(vec![input.expr(), output.expr()]),
                input.in_next_scan(),
            ),
            Self::StaysAsLongAs(input, other) => (
                Expr::And(vec![input.expr(), other.expr()]),
                Expr::Or(vec![
                    input.in_next_scan(),
                    other.complement().in_next_scan(),
                ]),
            ),
            Self::NotAfter(input, output) => (output.expr(), input.complement().in_next_scan()),
        };
        EnvironmentRule {
            name: label.clone(),
            left,
            right,
            comment: Some(self.words().into()),
        }
    }

    /// The same in words: `ls1 is on whenever ls2 is`.
    pub(super) fn words(&self) -> String {
        match self {
            Self::NotTogether(a, b) => {
                let (a, b) = if a.on { (a, b) } else { (b, a) };
                let (one, other) = (quoted(&a.name), quoted(&b.name));
                match (a.on, b.on) {
                    (true, true) => format!("{one} and {other} are never on together"),
                    (true, false) => format!("{other} is on whenever {one} is"),
                    (false, _) => format!("{one} or {other} is always on"),
                }
            }
            Self::StaysWhile(input, output) => format!(
                "{} stays {} while {} is {}",
                quoted(&input.name),
                input.word(),
                quoted(&output.name),
                output.word()
            ),
            Self::StaysAsLongAs(input, other) => format!(
                "{} stays {} as long as {} is {}",
                quoted(&input.name),
                input.word(),
                quoted(&other.name),
                other.word()
            ),
            Self::NotAfter(input, output) => format!(
                "{} is {} in the scan after one with {} {}",
                quoted(&input.name),
                input.complement().word(),
                quoted(&output.name),
                output.word()
            ),
        }
    }
}

/// What a rule comes to in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Obeyed {
    /// Its left side does not hold, or a value is not known.
    Idle,
    /// Both sides hold.
    Kept,
    /// Only its left side does.
    Broken,
}

/// What is known of a variable in some scan.
pub(super) type Known<'k> = &'k dyn Fn(&str) -> Option<bool>;

/// What `rule` comes to in a scan, where `before` tells of the scan before.
pub(super) fn obeyed(rule: &EnvironmentRule, before: Known<'_>, now: Known<'_>) -> Obeyed {
    let mut speaks_of_next = false;
    rule.right.each_atom(&mut |atom| {
        if let Atom::Variable(name) = atom {
            speaks_of_next |= is_in_next_scan(name).is_some();
        }
    });
    let plain = if speaks_of_next { before } else { now };
    let value = |name: &str| match is_in_next_scan(name) {
        Some(marked) => now(marked),
        None => plain(name),
    };
    match (holds(&rule.left, &value), holds(&rule.right, &value)) {
        (Some(true), Some(true)) => Obeyed::Kept,
        (Some(true), Some(false)) => Obeyed::Broken,
        _ => Obeyed::Idle,
    }
}

/// Whether an expression holds, as far as its variables are known. Nothing is
/// told of comparisons, edges and times.
fn holds(expr: &Expr, value: Known<'_>) -> Option<bool> {
    match expr {
        Expr::Constant(on) => Some(*on),
        Expr::Not(inner) => holds(inner, value).map(|on| !on),
        Expr::And(parts) => {
            let parts: Option<Vec<bool>> = parts.iter().map(|it| holds(it, value)).collect();
            parts.map(|all| all.into_iter().all(|on| on))
        }
        Expr::Or(parts) => {
            let parts: Option<Vec<bool>> = parts.iter().map(|it| holds(it, value)).collect();
            parts.map(|all| all.into_iter().any(|on| on))
        }
        Expr::Atom(Atom::Variable(name)) => value(name),
        Expr::Atom(_) => None,
    }
}
