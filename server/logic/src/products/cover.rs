use rustc_hash::FxHashMap;

use super::Product;
use super::table::{Operation, Part, Table};
use crate::{AtomId, Budget, Function, Literal, Stop};

/// Steps of the recursion allowed for each product allowed: a cover that
/// takes more has more products than anybody reads.
const STEPS_PER_PRODUCT: usize = 8;

/// One run of Minato's recursion.
///
/// A cover of what lies between two functions, `lower` and `upper`, is made of
/// three: products with the complement of the first atom, products with the
/// atom, and products without it for what is left. Each of the three is the
/// same task for functions of fewer atoms. Products are spelt only when all is
/// done; until then a cover holds its three parts.
pub(super) struct Covering<'b> {
    table: Table<'b>,
    /// Products that may still be added.
    room: usize,
    /// Steps that may still be taken.
    steps: usize,
    /// Covers found, by what they had to cover and stay within: diagrams share
    /// their parts, and the recursion meets the same part again and again.
    found: FxHashMap<(Part, Part), Cover>,
    sums: Vec<Sum>,
}

/// Products, and the function that they denote.
#[derive(Clone, Copy, Debug)]
struct Cover {
    sum: SumId,
    products: usize,
    covered: Part,
}

#[derive(Clone, Copy, Debug)]
struct SumId(usize);

/// A sum of products, by its parts.
#[derive(Clone, Copy, Debug)]
enum Sum {
    /// No product.
    Zero,
    /// The product without a literal.
    One,
    /// `/atom*low + atom*high + without`
    Split {
        atom: AtomId,
        low: SumId,
        high: SumId,
        without: SumId,
    },
}

const ZERO: Cover = Cover {
    sum: SumId(0),
    products: 0,
    covered: Part::FALSE,
};

const ONE: Cover = Cover {
    sum: SumId(1),
    products: 1,
    covered: Part::TRUE,
};

/// A step of the recursion under way.
struct Step {
    task: (Part, Part),
    atom: AtomId,
    lower: (Part, Part),
    upper: (Part, Part),
    /// Covers of the complement's side and the atom's, as far as they are
    /// there.
    low: Option<Cover>,
    high: Option<Cover>,
}

impl<'b> Covering<'b> {
    pub(super) fn within(budget: &'b Budget) -> Self {
        Self {
            table: Table::new(budget),
            room: budget.products,
            steps: budget.products.saturating_mul(STEPS_PER_PRODUCT),
            found: FxHashMap::default(),
            sums: vec![Sum::Zero, Sum::One],
        }
    }

    /// Products that cover `lower` and stay within `upper`.
    pub(super) fn products(
        mut self,
        lower: &Function,
        upper: &Function,
    ) -> Result<Vec<Product>, Stop> {
        let cover = self.cover(lower, upper)?;
        Ok(self.spelt(cover))
    }

    /// The function that such products denote.
    pub(super) fn covered(mut self, lower: &Function, upper: &Function) -> Result<Function, Stop> {
        let cover = self.cover(lower, upper)?;
        self.table.function(cover.covered)
    }

    fn cover(&mut self, lower: &Function, upper: &Function) -> Result<Cover, Stop> {
        let task = (self.table.add(lower), self.table.add(upper));
        // Steps lie within steps as deep as a function has atoms, which is
        // more than calls may lie within calls.
        let mut open: Vec<Step> = Vec::new();
        let mut done = self.begin(task, &mut open)?;
        while let Some(step) = open.last_mut() {
            let next = match done.take() {
                None => self.only_low(step)?,
                Some(low) if step.low.is_none() => {
                    step.low = Some(low);
                    self.only_high(step)?
                }
                Some(high) if step.high.is_none() => {
                    step.high = Some(high);
                    self.rest(step)?
                }
                Some(without) => {
                    done = Some(self.joined(step, without)?);
                    open.pop();
                    continue;
                }
            };
            done = self.begin(next, &mut open)?;
        }
        Ok(done.unwrap_or(ZERO))
    }

    /// The cover that a task needs, if that can be said at once, else the
    /// first step towards it.
    fn begin(
        &mut self,
        task @ (lower, upper): (Part, Part),
        open: &mut Vec<Step>,
    ) -> Result<Option<Cover>, Stop> {
        let at_once = match (lower, upper) {
            (Part::FALSE, _) => Some(ZERO),
            (_, Part::TRUE) => Some(ONE),
            _ => self.found.get(&task).copied(),
        };
        if let Some(cover) = at_once {
            self.room = (self.room.checked_sub(cover.products)).ok_or(Stop::TooLarge)?;
            return Ok(Some(cover));
        }
        self.table.budget().check()?;
        self.steps = self.steps.checked_sub(1).ok_or(Stop::TooLarge)?;
        let atom = self.table.first_atom(lower, upper);
        open.push(Step {
            task,
            atom,
            lower: self.table.cofactors(lower, atom),
            upper: self.table.cofactors(upper, atom),
            low: None,
            high: None,
        });
        Ok(None)
    }

    /// What only products with the complement of the atom can cover.
    fn only_low(&mut self, step: &Step) -> Result<(Part, Part), Stop> {
        let only = (self.table).apply(Operation::AndNot, step.lower.0, step.upper.1)?;
        Ok((only, step.upper.0))
    }

    /// What only products with the atom can cover.
    fn only_high(&mut self, step: &Step) -> Result<(Part, Part), Stop> {
        let only = (self.table).apply(Operation::AndNot, step.lower.1, step.upper.0)?;
        Ok((only, step.upper.1))
    }

    /// What is left can be covered without naming the atom.
    fn rest(&mut self, step: &Step) -> Result<(Part, Part), Stop> {
        let covered = |cover: Option<Cover>| cover.unwrap_or(ZERO).covered;
        let (low, high) = (covered(step.low), covered(step.high));
        let table = &mut self.table;
        let low = table.apply(Operation::AndNot, step.lower.0, low)?;
        let high = table.apply(Operation::AndNot, step.lower.1, high)?;
        Ok((
            table.apply(Operation::Or, low, high)?,
            table.apply(Operation::And, step.upper.0, step.upper.1)?,
        ))
    }

    fn joined(&mut self, step: &Step, without: Cover) -> Result<Cover, Stop> {
        let (low, high) = (step.low.unwrap_or(ZERO), step.high.unwrap_or(ZERO));
        let table = &mut self.table;
        let covered_low = table.apply(Operation::Or, low.covered, without.covered)?;
        let covered_high = table.apply(Operation::Or, high.covered, without.covered)?;
        let cover = Cover {
            sum: SumId(self.sums.len()),
            products: low.products + high.products + without.products,
            covered: table.choice(step.atom, covered_low, covered_high)?,
        };
        self.sums.push(Sum::Split {
            atom: step.atom,
            low: low.sum,
            high: high.sum,
            without: without.sum,
        });
        self.found.insert(step.task, cover);
        Ok(cover)
    }

    /// The products of a cover, literals in ascending order.
    fn spelt(&self, cover: Cover) -> Vec<Product> {
        let mut products = Vec::with_capacity(cover.products);
        let mut open = vec![(cover.sum, Product::new())];
        while let Some((sum, product)) = open.pop() {
            match self.sums[sum.0] {
                Sum::Zero => {}
                Sum::One => products.push(product),
                Sum::Split {
                    atom,
                    low,
                    high,
                    without,
                } => {
                    for (sum, positive) in [(low, false), (high, true)] {
                        let mut with = product.clone();
                        with.push(Literal { atom, positive });
                        open.push((sum, with));
                    }
                    open.push((without, product));
                }
            }
        }
        products
    }
}
