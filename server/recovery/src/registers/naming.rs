//! What the comments of a ladder call the steps of a register.

use ladder::{ElementKind, Program, Rung};
use logic::{Name, Relation};

/// A title longer than this is a description, of which the beginning serves.
const LONGEST: usize = 72;

/// The comment of the first rung that looks for exactly this value of the
/// register and for no other.
pub(super) fn title(program: &Program, register: &Name, value: i64) -> Option<Name> {
    program
        .rungs()
        .filter(|(_, rung)| compared_values(rung, register) == [value])
        .find_map(|(_, rung)| shortened(rung.comment.as_ref()?))
}

/// Values that a rung compares the register with for equality, each once.
fn compared_values(rung: &Rung, register: &Name) -> Vec<i64> {
    let mut values: Vec<i64> = rung
        .network
        .elements()
        .filter_map(|(_, element)| match &element.kind {
            ElementKind::Comparison(it) if it.relation == Relation::Equal => {
                let (left, right) = (&it.left.name, &it.right.name);
                if left == register {
                    right.parse().ok()
                } else if right == register {
                    left.parse().ok()
                } else {
                    None
                }
            }
            _ => None,
        })
        .collect();
    values.sort_unstable();
    values.dedup();
    values
}

/// The first line of a comment, cut at a word where it is long.
fn shortened(comment: &str) -> Option<Name> {
    let line = comment
        .lines()
        .map(str::trim)
        .find(|line| !line.is_empty())?;
    if line.chars().count() <= LONGEST {
        return Some(line.into());
    }
    let cut: String = line.chars().take(LONGEST).collect();
    let whole = cut.rsplit_once(' ').map_or(&*cut, |(words, _)| words);
    Some(format!("{whole} ...").into())
}
