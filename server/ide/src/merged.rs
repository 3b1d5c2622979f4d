//! A spec made to say something else, with every line in its place.
//!
//! The rule text has one layout for what the ladder gives, and the text at hand
//! is that, with what people did to it. So what is new between the layout before
//! and the layout after a change is put into the text, as one merges two changes
//! of one file. What a decision brings stands where it belongs, and taking the
//! decision back leaves the text as it was, byte for byte. Where both have
//! changed the same lines, the text is [rewritten](grafcet::rewrite), which asks
//! for no layout and puts what is new behind all else.

use grafcet::Spec;
use logic::Budget;
use recovery::Analysis;
use recovery::conversion::update;
use similar::{Algorithm, DiffOp, capture_diff_slices};

/// The text that says what `target` says, made from `text`, which was read as
/// `existing`. `target` is what a conversion of the ladder wants to write.
pub fn merged_spec(
    analysis: &Analysis,
    text: &str,
    existing: &Spec,
    target: &Spec,
    budget: &Budget,
) -> String {
    let before = update(analysis, existing, &existing.decisions, budget).spec;
    let line_end = match text.contains("\r\n") {
        true => "\r\n",
        false => "\n",
    };
    let laid_out = |spec| grafcet::write(spec).replace('\n', line_end);
    let mark = match text.starts_with(MARK) {
        true => MARK,
        false => "",
    };
    let body = &text[mark.len()..];
    let after = laid_out(target);
    // A decision that was written by hand is in the text already, and what it
    // brings is not; then the text is what it says, laid out.
    [&before, existing]
        .into_iter()
        .filter_map(|before| merged(&laid_out(before), body, &after))
        .map(|body| format!("{mark}{body}"))
        .find(|text| grafcet::read(text).spec.says_the_same(target))
        .unwrap_or_else(|| grafcet::rewrite(text, target))
}

/// A byte order mark.
const MARK: &str = "\u{feff}";

/// `mine` with all changes that lead from `old` to `new`; `None` where both have
/// changed the same lines of `old`, or put lines at the same place.
fn merged(old: &str, mine: &str, new: &str) -> Option<String> {
    let [olds, mines, news] =
        [old, mine, new].map(|text| text.split_inclusive('\n').collect::<Vec<_>>());
    let changes = |to: &[&str]| {
        let mut ops = capture_diff_slices(Algorithm::Myers, &olds, to);
        ops.retain(|op| !matches!(op, DiffOp::Equal { .. }));
        ops
    };
    let (ours, theirs) = (changes(&mines), changes(&news));
    let mut ours = ours.iter().peekable();
    let mut out = String::with_capacity(mine.len() + new.len());
    // The next line of each text.
    let (mut at, mut at_mine) = (0, 0);
    for op in &theirs {
        let range = op.old_range();
        // Of lines that are put or taken away right beside lines of ours nobody
        // could tell which come first.
        let is_one_sided = range.is_empty() || op.new_range().is_empty();
        let clashes = |our: &DiffOp, at: usize| {
            is_one_sided && our.old_range().is_empty() && our.old_range().start == at
        };
        // What is ours before it.
        while let Some(our) = ours.next_if(|it| it.old_range().end <= range.start) {
            if clashes(our, range.start) {
                return None;
            }
            at = our.old_range().end;
            out.extend(mines.get(at_mine..our.new_range().end)?.iter().copied());
            at_mine = our.new_range().end;
        }
        if let Some(our) = ours.peek()
            && (our.old_range().start < range.end || clashes(our, range.end))
        {
            return None;
        }
        // Lines that nobody has changed.
        let same = range.start.checked_sub(at)?;
        out.extend(mines.get(at_mine..at_mine + same)?.iter().copied());
        at_mine += same + range.len();
        at = range.end;
        out.extend(news.get(op.new_range())?.iter().copied());
    }
    out.extend(mines.get(at_mine..)?.iter().copied());
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(old: &str, mine: &str, new: &str, expected: Option<&str>) {
        assert_eq!(merged(old, mine, new).as_deref(), expected);
        // What is put in can be taken out again.
        if let Some(both) = expected {
            assert_eq!(merged(new, both, old).as_deref(), Some(mine));
        }
    }

    #[test]
    fn changes_of_other_lines_are_made_in_their_places() {
        let old = "a\nb\nc\nd\n";
        check(old, old, "a\nc\nd\ne\n", Some("a\nc\nd\ne\n"));
        check(
            old,
            "a\nb\nc\n// mine\nd\n",
            "a\nx\nc\nd\n",
            Some("a\nx\nc\n// mine\nd\n"),
        );
        check(
            old,
            "a\nB\nc\nd\n",
            "a\nb\nc\nd\ne\n",
            Some("a\nB\nc\nd\ne\n"),
        );
        check(
            old,
            "// mine\na\nb\nc\nd\n",
            "a\nb\nd\n",
            Some("// mine\na\nb\nd\n"),
        );
        check("", "", "a\n", Some("a\n"));
    }

    #[test]
    fn changes_of_the_same_lines_are_nobodys() {
        let old = "a\nb\nc\n";
        check(old, "a\nB\nc\n", "a\nx\nc\n", None);
        check(old, "a\nc\n", "a\nx\nc\n", None);
        check(old, "a\n// mine\nb\nc\n", "a\nx\nb\nc\n", None);
        check(old, "a\nb\nc\n// mine\n", "a\nb\nc\nx\n", None);
    }
}
