use logic::{Atom, Atoms, Budget, Expr, Function};

/// Expressions with more atoms than this are compared as they are written.
const MOST_ATOMS: usize = 256;

/// Whether two expressions denote the same function. Where finding out would
/// cost too much, only those count as the same that are written so.
pub(crate) fn means_the_same(left: &Expr, right: &Expr) -> bool {
    if left == right {
        return true;
    }
    let (left, right) = (normal(left), normal(right));
    if left == right {
        return true;
    }
    if atoms(&left).max(atoms(&right)) > MOST_ATOMS {
        return false;
    }
    let (mut atoms, budget) = (Atoms::new(), Budget::default());
    let function = Function::of(&left, &mut atoms, &budget);
    match (function, Function::of(&right, &mut atoms, &budget)) {
        (Ok(left), Ok(right)) => left == right,
        _ => false,
    }
}

fn atoms(expr: &Expr) -> usize {
    let mut count = 0;
    expr.each_atom(&mut |_| count += 1);
    count
}

/// The expression as reading its text gives it: no product or sum of fewer
/// than two, no double complement, comparisons in their one form.
pub(crate) fn normal(expr: &Expr) -> Expr {
    match expr {
        Expr::Constant(value) => Expr::Constant(*value),
        Expr::Not(inner) => normal(inner).complement(),
        Expr::And(parts) => many(parts, true, Expr::And),
        Expr::Or(parts) => many(parts, false, Expr::Or),
        Expr::Atom(Atom::Comparison(c)) => Expr::comparison(&c.left, c.relation, &c.right),
        Expr::Atom(Atom::Rise(inner)) => Expr::Atom(Atom::Rise(Box::new(normal(inner)))),
        Expr::Atom(Atom::Fall(inner)) => Expr::Atom(Atom::Fall(Box::new(normal(inner)))),
        Expr::Atom(atom) => Expr::Atom(atom.clone()),
    }
}

fn many(parts: &[Expr], empty: bool, make: fn(Vec<Expr>) -> Expr) -> Expr {
    match parts {
        [] => Expr::Constant(empty),
        [only] => normal(only),
        _ => make(parts.iter().map(normal).collect()),
    }
}
