//! The constants that a spec compares variables with.

use grafcet::Spec;
use logic::{Atom, Datum, Expr, Name};

/// Each variable with a constant that it is compared with.
pub(crate) fn constants(spec: &Spec) -> Vec<(Name, Datum)> {
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
    for rule in &spec.environment {
        of(&rule.left, &mut found);
        of(&rule.right, &mut found);
    }
    spec.never
        .iter()
        .for_each(|it| of(&it.condition, &mut found));
    found
}

fn of(expr: &Expr, found: &mut Vec<(Name, Datum)>) {
    match expr {
        Expr::Constant(_) => {}
        Expr::Not(inner) => of(inner, found),
        Expr::And(parts) | Expr::Or(parts) => parts.iter().for_each(|part| of(part, found)),
        Expr::Atom(Atom::Rise(inner) | Atom::Fall(inner)) => of(inner, found),
        Expr::Atom(Atom::Comparison(it)) => {
            let sides = [(&it.left, &it.right), (&it.right, &it.left)];
            for (name, constant) in sides {
                let name = grafcet::is_in_next_scan(name).unwrap_or(name);
                if let (None, Some(constant)) = (Datum::constant(name), Datum::constant(constant)) {
                    found.push((name.into(), constant));
                }
            }
        }
        Expr::Atom(Atom::Variable(_) | Atom::Elapsed { .. }) => {}
    }
}
