//! Conditions laid out in lines.

/// Where text for people is broken, counted in characters.
const WIDTH: usize = 100;

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
