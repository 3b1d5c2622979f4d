//! What a spec looks at: its variables, and the constants that it compares them
//! with.

use grafcet::Spec;
use grafcet::evolution::{Effect, Net, Operand};
use logic::{Atom, Datum, Expr, Name};

use crate::rules::names_of;

/// The variables of a spec whose grafcet is this, as it calls them.
pub(crate) fn names(spec: &Spec, net: &Net) -> Vec<Name> {
    let mut names = net.variables.clone();
    let rules = spec.environment.iter();
    let expressions = rules.flat_map(|rule| [&rule.left, &rule.right]);
    let expressions = expressions.chain(spec.never.iter().map(|it| &it.condition));
    for name in expressions.flat_map(names_of) {
        let plain = grafcet::is_in_next_scan(&name).map(Name::from);
        names.push(plain.unwrap_or(name));
    }
    names
}

/// Each variable that a spec whose grafcet is this looks at as a number, with a
/// constant that it is compared with; without one where its very value counts.
pub(crate) fn numbers(spec: &Spec, net: &Net) -> Vec<(Name, Option<Datum>)> {
    let mut found = Vec::new();
    for transition in spec.grafcet.transitions() {
        of(&transition.receptivity, &mut found);
    }
    for action in spec.grafcet.actions() {
        action.condition.iter().for_each(|it| of(it, &mut found));
        if let grafcet::ActionKind::Stored {
            on: grafcet::Trigger::Event(event),
            ..
        } = &action.kind
        {
            of(event, &mut found);
        }
    }
    for action in &net.stored {
        if let Effect::Assign(term) = &action.effect {
            let read = term.operands().filter_map(|operand| match operand {
                Operand::Variable(at) => Some((net.variables[*at].clone(), None)),
                _ => None,
            });
            found.extend(read);
        }
    }
    for rule in &spec.environment {
        of(&rule.left, &mut found);
        of(&rule.right, &mut found);
    }
    spec.never
        .iter()
        .for_each(|it| of(&it.condition, &mut found));
    found
}

fn of(expr: &Expr, found: &mut Vec<(Name, Option<Datum>)>) {
    match expr {
        Expr::Constant(_) => {}
        Expr::Not(inner) => of(inner, found),
        Expr::And(parts) | Expr::Or(parts) => parts.iter().for_each(|part| of(part, found)),
        Expr::Atom(Atom::Rise(inner) | Atom::Fall(inner)) => of(inner, found),
        Expr::Atom(Atom::Comparison(it)) => {
            let sides = [(&it.left, &it.right), (&it.right, &it.left)];
            for (name, other) in sides {
                let name = grafcet::is_in_next_scan(name).unwrap_or(name);
                if Datum::constant(name).is_none() {
                    found.push((name.into(), Datum::constant(other)));
                }
            }
        }
        Expr::Atom(Atom::Variable(_) | Atom::Elapsed { .. }) => {}
    }
}
