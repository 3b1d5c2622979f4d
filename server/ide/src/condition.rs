use std::collections::HashMap;

use logic::{Budget, Function, notation};
use recovery::conditions::Conditions;

/// `function` in the notation; `None` past the budget.
pub fn said(function: &Function, conditions: &Conditions, budget: &Budget) -> Option<String> {
    let expr = conditions.expr(function, budget).ok()?;
    Some(notation::write(&expr))
}

/// Conditions in the notation, each worked out once: the power at a coil that
/// holds nothing is its value, what starts it and what keeps it.
pub(crate) struct Words<'a> {
    conditions: &'a Conditions,
    budget: &'a Budget,
    known: HashMap<Function, Option<String>>,
}

impl<'a> Words<'a> {
    pub(crate) fn new(conditions: &'a Conditions, budget: &'a Budget) -> Self {
        Self {
            conditions,
            budget,
            known: HashMap::new(),
        }
    }

    /// `function` in the notation; `None` past the budget.
    pub(crate) fn say(&mut self, function: &Function) -> Option<String> {
        if let Some(known) = self.known.get(function) {
            return known.clone();
        }
        let words = said(function, self.conditions, self.budget);
        self.known.insert(function.clone(), words.clone());
        words
    }
}

/// A diagram with more nodes than this has no sum that anybody reads, and one of
/// ten thousand keeps a computer busy for seconds.
const LEGIBLE_NODES: usize = 500;

/// The same of a sum with more products than this.
const LEGIBLE_PRODUCTS: usize = 40;

/// `function` in the notation; `None` where it would be too long to be read.
pub fn legible(function: &Function, conditions: &Conditions, budget: &Budget) -> Option<String> {
    if function.nodes() > LEGIBLE_NODES {
        return None;
    }
    let budget = Budget {
        products: LEGIBLE_PRODUCTS,
        ..budget.clone()
    };
    said(function, conditions, &budget)
}

/// `text`, a condition, in lines of at most `width` columns where that is
/// possible: broken before a product, and in a product that is too long behind a
/// factor. The lines after the first begin at column `indent`, as the first
/// does.
pub fn broken(text: &str, indent: usize, width: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    for (nth, product) in text.split(" + ").enumerate() {
        let length = product.chars().count() + SIGN;
        if nth > 0 && column + length > width {
            begin_line(&mut out, indent);
            out.push_str("+ ");
            column = indent + 2;
        } else if nth > 0 {
            out.push_str(" + ");
        }
        if column + length - SIGN <= width {
            out.push_str(product);
            column += length;
            continue;
        }
        // Lines of one product begin behind its sign.
        let inner = indent + 2;
        for (nth, factor) in factors(product).enumerate() {
            let length = factor.chars().count();
            if nth > 0 && column + length > width {
                begin_line(&mut out, inner);
                column = inner;
            }
            out.push_str(factor);
            column += length;
        }
        column += SIGN;
    }
    out
}

/// The columns of ` + `.
const SIGN: usize = 3;

fn begin_line(out: &mut String, indent: usize) {
    out.push('\n');
    out.push_str(&" ".repeat(indent));
}

/// The factors of a product with the signs behind them; a sign within quotes is
/// part of a name.
fn factors(product: &str) -> impl Iterator<Item = &str> {
    let mut quoted = false;
    product.split_inclusive(move |c| {
        quoted ^= c == '"';
        c == '*' && !quoted
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sum_is_broken_before_a_product() {
        let product = "abcdefghi".repeat(5);
        let sum = [&*product; 3].join(" + ");
        let expected = format!("{product} + {product}\n  + {product}");
        assert_eq!(broken(&sum, 2, 100), expected);
        assert_eq!(broken("a + b", 2, 100), "a + b");
    }

    #[test]
    fn a_long_product_is_broken_behind_a_factor() {
        assert_eq!(
            broken("first*second*/\"third * of them\"*fourth + fifth", 4, 24),
            "first*second*\n      /\"third * of them\"*\n      fourth + fifth"
        );
        assert_eq!(broken("a + bb*cc*dd", 0, 8), "a\n+ bb*cc*\n  dd");
        assert_eq!(broken("no_place_to_break_at", 0, 8), "no_place_to_break_at");
    }
}
