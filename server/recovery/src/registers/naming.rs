//! What the comments of a ladder call the steps of a register.

use ladder::{ElementKind, Program, Rung};
use logic::{Name, Relation};

/// A title longer than this is a description, of which the beginning serves.
const LONGEST: usize = 72;

/// The comment of a rung that looks for exactly this value of the register and
/// for no other: of the first whose comment mentions the number, else of the
/// first.
pub(super) fn title(program: &Program, register: &Name, value: i64) -> Option<Name> {
    let comments: Vec<&Name> = program
        .rungs()
        .filter(|(_, rung)| compared_values(rung, register) == [value])
        .filter_map(|(_, rung)| rung.comment.as_ref())
        .collect();
    let mentions = |comment: &&&Name| {
        let mut words = comment.split(|c: char| !c.is_alphanumeric());
        words.any(|word| word.parse() == Ok(value))
    };
    let best = comments.iter().find(mentions).or(comments.first())?;
    shortened(best)
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

/// A comment in one line, cut at a word where it is long.
fn shortened(comment: &str) -> Option<Name> {
    let line = comment.split_whitespace().collect::<Vec<_>>().join(" ");
    if line.is_empty() {
        return None;
    }
    if line.chars().count() <= LONGEST {
        return Some(line.into());
    }
    let cut: String = line.chars().take(LONGEST).collect();
    let whole = cut.rsplit_once(' ').map_or(&*cut, |(words, _)| words);
    Some(format!("{whole} ...").into())
}
