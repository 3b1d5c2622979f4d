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
/// factor, or before a sum within it. The lines after the first begin at column
/// `indent`, as the first does, and deeper within products and parentheses.
pub fn broken(text: &str, indent: usize, width: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    for (nth, product) in products(text).into_iter().enumerate() {
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
        for (nth, (depth, part)) in parts(product).into_iter().enumerate() {
            let length = part.chars().count();
            if nth > 0 && column + length > width {
                // Lines of one product begin behind its sign.
                let inner = indent + 2 + 2 * depth;
                begin_line(&mut out, inner);
                out.push_str(part.trim_start());
                column = inner + part.trim_start().chars().count();
            } else {
                out.push_str(part);
                column += length;
            }
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

/// The products of a sum, without the signs between them.
fn products(text: &str) -> Vec<&str> {
    let mut all = Vec::new();
    let mut start = 0;
    for (at, depth, _) in signs(text).filter(|(_, _, sign)| *sign == '+') {
        if depth == 0 {
            all.push(text[start..at].trim_end());
            start = at + 2;
        }
    }
    all.push(text.get(start..).unwrap_or_default());
    all
}

/// What a product is made of, each part with the parentheses around it: factors
/// with the signs behind them, and sums in parentheses product by product.
fn parts(product: &str) -> Vec<(usize, &str)> {
    let mut all = Vec::new();
    let (mut start, mut around) = (0, 0);
    for (at, depth, sign) in signs(product) {
        // A blank belongs to the sign behind it.
        let end = match sign {
            '*' => at + 1,
            _ => at.saturating_sub(1),
        };
        all.push((around, &product[start..end]));
        (start, around) = (end, depth);
    }
    all.push((around, &product[start..]));
    all
}

/// The signs `*` and ` + ` of a condition that are no part of a name: where they
/// are, and how many parentheses are around them.
fn signs(text: &str) -> impl Iterator<Item = (usize, usize, char)> {
    let (mut quoted, mut depth) = (false, 0_usize);
    let sign = move |(at, c): (usize, char)| {
        match c {
            '"' => quoted = !quoted,
            _ if quoted => {}
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            '*' => return Some((at, depth, c)),
            '+' if text[..at].ends_with(' ') && text[at + 1..].starts_with(' ') => {
                return Some((at, depth, c));
            }
            _ => {}
        }
        None
    };
    text.char_indices().filter_map(sign)
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

    #[test]
    fn a_sum_in_a_product_stays_in_it() {
        assert_eq!(
            broken("a*rise(first*second + third)*b + last", 0, 20),
            "a*rise(first*second\n    + third)*b\n+ last"
        );
        assert_eq!(
            broken("rise(a + b) + \"c + d\"", 0, 12),
            "rise(a + b)\n+ \"c + d\""
        );
    }
}
