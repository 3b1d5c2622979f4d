//! Values of tags in the list notation that L5K and L5X share:
//! `[-1,2000,0]` is a timer with a preset of two seconds.

use super::operand;

/// The preset in the value of a `TIMER` or `COUNTER`, or those in an array of
/// them, each with its path: `("[2]", 2000)`. A timer is written as its status
/// word, its preset and its accumulated value.
pub(super) fn presets(data_type: &str, value: &str) -> Vec<(String, i64)> {
    let name = data_type.split('[').next().unwrap_or_default().trim();
    if !is_timer_or_counter(name) {
        return Vec::new();
    }
    let Some(inside) = list(value) else {
        return Vec::new();
    };
    let items = items(inside);
    if items.iter().any(|item| list(item).is_some()) {
        let elements = items.iter().enumerate();
        return elements
            .filter_map(|(place, item)| Some((format!("[{place}]"), preset(list(item)?)?)))
            .collect();
    }
    preset(inside)
        .map(|value| (String::new(), value))
        .into_iter()
        .collect()
}

/// Whether a type keeps a preset that an instruction leaves out as `?`.
pub(super) fn is_timer_or_counter(data_type: &str) -> bool {
    data_type.eq_ignore_ascii_case("TIMER") || data_type.eq_ignore_ascii_case("COUNTER")
}

fn preset(inside: &str) -> Option<i64> {
    items(inside).get(1).and_then(|item| operand::integer(item))
}

/// What is inside `[...]`.
fn list(value: &str) -> Option<&str> {
    value.trim().strip_prefix('[')?.strip_suffix(']')
}

/// The items of a list, lists inside kept whole.
fn items(inside: &str) -> Vec<&str> {
    let mut items = Vec::new();
    let mut depth = 0_usize;
    let mut start = 0;
    for (at, character) in inside.char_indices() {
        match character {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                items.push(inside[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    items.push(inside[start..].trim());
    items
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_of_timers_and_arrays_of_them() {
        let single = |value| presets("TIMER", value);
        assert_eq!(single("[-1,2000,0]"), [(String::new(), 2000)]);
        assert_eq!(single("0"), []);
        assert_eq!(
            presets("COUNTER[2]", "[[0,5,0],[0,7,1]]"),
            [("[0]".to_owned(), 5), ("[1]".to_owned(), 7)]
        );
        assert_eq!(presets("DINT[2]", "[1,2]"), []);
    }
}
