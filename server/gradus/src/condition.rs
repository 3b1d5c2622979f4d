//! Conditions as text.

use logic::{Budget, Function, notation};
use recovery::conditions::Conditions;

/// Where text for people is broken, counted in characters.
const WIDTH: usize = 100;

/// `function` in the notation; `None` past the budget.
pub fn said(function: &Function, conditions: &Conditions, budget: &Budget) -> Option<String> {
    let expr = conditions.expr(function, budget).ok()?;
    Some(notation::write(&expr))
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

/// `text`, the condition of a line, broken between its products where it grows
/// too long. The lines after the first begin at column `indent`.
pub fn broken(text: &str, indent: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    for (nth, product) in text.split(" + ").enumerate() {
        let length = product.chars().count() + 3;
        if nth > 0 && column + length > WIDTH {
            out.push('\n');
            out.push_str(&" ".repeat(indent));
            out.push_str("+ ");
            column = indent + 2;
        } else if nth > 0 {
            out.push_str(" + ");
        }
        out.push_str(product);
        column += length;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_sum_is_broken_before_a_product() {
        let product = "abcdefghi".repeat(5);
        let sum = [&*product; 3].join(" + ");
        let expected = format!("{product} + {product}\n  + {product}");
        assert_eq!(broken(&sum, 2), expected);
        assert_eq!(broken("a + b", 2), "a + b");
    }
}
