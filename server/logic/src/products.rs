use std::collections::HashMap;

use crate::{AtomId, Atoms, Budget, Expr, Function, Literal, Stop};

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
    pub fn products(&self, budget: &Budget) -> Result<Vec<Product>, Stop> {
        self.products_within(self, budget)
    }

    /// Products that cover `self` and stay within `upper`, which `self` must
    /// imply: where `self` is false and `upper` true, the value is free. The
    /// freedom makes conditions shorter where the context already says part
    /// of them.
    pub fn products_within(&self, upper: &Self, budget: &Budget) -> Result<Vec<Product>, Stop> {
        let (mut products, _) = Covering::within(budget).cover(self, upper)?;
        for product in &mut products {
            product.sort_unstable();
        }
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
        let (_, covered) = Covering::within(budget).cover(self, upper)?;
        Ok(covered)
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

/// Steps of the recursion allowed for each product allowed: a cover that
/// takes more has more products than anybody reads.
const STEPS_PER_PRODUCT: usize = 8;

/// One run of Minato's recursion.
struct Covering<'b> {
    budget: &'b Budget,
    /// Products that may still be added.
    room: usize,
    /// Steps that may still be taken.
    steps: usize,
    /// Covers found, by what they had to cover and stay within: diagrams share
    /// their parts, and the recursion meets the same part again and again.
    found: HashMap<(Function, Function), (Vec<Product>, Function)>,
}

impl<'b> Covering<'b> {
    fn within(budget: &'b Budget) -> Self {
        Self {
            budget,
            room: budget.products,
            steps: budget.products.saturating_mul(STEPS_PER_PRODUCT),
            found: HashMap::new(),
        }
    }

    /// A cover of everything in `lower` by products inside `upper`, and the
    /// function that it denotes.
    fn cover(
        &mut self,
        lower: &Function,
        upper: &Function,
    ) -> Result<(Vec<Product>, Function), Stop> {
        if lower.is_false() {
            return Ok((Vec::new(), Function::constant(false)));
        }
        if upper.is_true() {
            self.take_room(1)?;
            return Ok((vec![Product::new()], Function::constant(true)));
        }
        let key = (lower.clone(), upper.clone());
        if let Some(known) = self.found.get(&key).cloned() {
            self.take_room(known.0.len())?;
            return Ok(known);
        }
        self.steps = self.steps.checked_sub(1).ok_or(Stop::TooLarge)?;
        let Some(atom) = [lower.top(), upper.top()].into_iter().flatten().min() else {
            return Ok((Vec::new(), Function::constant(false)));
        };
        let found = self.split(atom, lower, upper)?;
        self.found.insert(key, found.clone());
        Ok(found)
    }

    fn take_room(&mut self, products: usize) -> Result<(), Stop> {
        self.room = self.room.checked_sub(products).ok_or(Stop::TooLarge)?;
        Ok(())
    }

    fn split(
        &mut self,
        atom: AtomId,
        lower: &Function,
        upper: &Function,
    ) -> Result<(Vec<Product>, Function), Stop> {
        let budget = self.budget;
        let (lower0, lower1) = (lower.restrict(atom, false), lower.restrict(atom, true));
        let (upper0, upper1) = (upper.restrict(atom, false), upper.restrict(atom, true));

        // What only the complement, or only the atom, can cover.
        let only0 = lower0.and_not(&upper1, budget)?;
        let only1 = lower1.and_not(&upper0, budget)?;
        let (products0, covered0) = self.cover(&only0, &upper0)?;
        let (products1, covered1) = self.cover(&only1, &upper1)?;

        // What is left can be covered without naming the atom.
        let rest = lower0
            .and_not(&covered0, budget)?
            .or(&lower1.and_not(&covered1, budget)?, budget)?;
        let both = upper0.and(&upper1, budget)?;
        let (shared, covered) = self.cover(&rest, &both)?;

        let with = |products: Vec<Product>, positive: bool| {
            products.into_iter().map(move |mut product| {
                product.push(Literal { atom, positive });
                product
            })
        };
        let products = with(products0, false)
            .chain(with(products1, true))
            .chain(shared)
            .collect();
        let total = covered0
            .and(&Function::literal(atom, false), budget)?
            .or(&covered1.and(&Function::atom(atom), budget)?, budget)?
            .or(&covered, budget)?;
        Ok((products, total))
    }
}
