//! Conditions laid out in lines.

/// Where text for people is broken, counted in characters.
const WIDTH: usize = 100;

/// `text`, the condition of a line, in several lines where it grows too long.
/// The lines after the first begin at column `indent`.
pub fn broken(text: &str, indent: usize) -> String {
    ide::broken(text, indent, WIDTH)
}
