//! Functions as sums of products.

mod cover;
mod table;

use crate::{AtomId, Atoms, Budget, Expr, Function, Literal, Stop};
use cover::Covering;

/// A product of literals, in ascending order of their atoms; the empty
/// product is 1.
pub type Product = Vec<Literal>;

impl Function {
    /// The function as an irredundant sum of products: no product and no
    /// literal can be left out. Smallest products first, then in the order of
    /// their atoms, so that the same function always gives the same sum.
    ///
    /// The method is Minato's recursion over the diagram (S. Minato, "Fast
    /// generation of irredundant sum-of-products forms from binary decision
    /// diagrams", 1992), which never enumerates paths.
    ///
    /// # Errors
    ///
    /// [`Stop::TooLarge`] if there are more products than the budget allows,
    /// or it takes too much to tell; [`Stop::Cancelled`] if somebody asked to
    /// stop.
    pub fn products(&self, budget: &Budget) -> Result<Vec<Product>, Stop> {
        self.products_within(self, budget)
    }

    /// Products that cover `self` and stay within `upper`, which `self` must
    /// imply: where `self` is false and `upper` true, the value is free. The
    /// freedom makes conditions shorter where the context already says part
    /// of them.
    pub fn products_within(&self, upper: &Self, budget: &Budget) -> Result<Vec<Product>, Stop> {
        let mut products = Covering::within(budget).products(self, upper)?;
        products.sort_by(|a, b| {
            let rank = |p: &Product| {
                let order: Vec<(AtomId, bool)> = p.iter().map(|l| (l.atom, !l.positive)).collect();
                (p.len(), order)
            };
            rank(a).cmp(&rank(b))
        });
        Ok(products)
    }

    /// A function between `self` and `upper`, which `self` must imply, with as
    /// short a sum of products as the method finds.
    pub fn simplified_within(&self, upper: &Self, budget: &Budget) -> Result<Self, Stop> {
        Covering::within(budget).covered(self, upper)
    }

    /// The function as an expression: its irredundant sum of products.
    pub fn to_expr(&self, atoms: &Atoms, budget: &Budget) -> Result<Expr, Stop> {
        Ok(sum(&self.products(budget)?, atoms))
    }

    /// Like [`Function::to_expr`], free to differ where `upper` holds and
    /// `self` does not; see [`Function::products_within`].
    pub fn to_expr_within(
        &self,
        upper: &Self,
        atoms: &Atoms,
        budget: &Budget,
    ) -> Result<Expr, Stop> {
        Ok(sum(&self.products_within(upper, budget)?, atoms))
    }
}

/// The sum of `products` as an expression.
fn sum(products: &[Product], atoms: &Atoms) -> Expr {
    let mut terms: Vec<Expr> = products
        .iter()
        .map(|product| {
            one_or(
                product.iter().map(|l| literal(*l, atoms)).collect(),
                Expr::And,
            )
        })
        .collect();
    match terms.len() {
        0 => Expr::Constant(false),
        1 => match terms.remove(0) {
            Expr::And(parts) if parts.is_empty() => Expr::Constant(true),
            term => term,
        },
        _ => Expr::Or(terms),
    }
}

fn one_or(mut parts: Vec<Expr>, many: fn(Vec<Expr>) -> Expr) -> Expr {
    if parts.len() == 1 {
        parts.remove(0)
    } else {
        many(parts)
    }
}

fn literal(literal: Literal, atoms: &Atoms) -> Expr {
    let atom = atoms.atom(literal.atom);
    let expr = Expr::Atom(atom.clone());
    if literal.positive {
        expr
    } else {
        expr.complement()
    }
}
