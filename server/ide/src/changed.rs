use similar::{DiffOp, TextDiff};
use source::{Edit, Span};

/// The edits that make `new` of `old`, in the order of the text: only lines
/// that differ, and of those only what differs, so that carets, marks and folds
/// of an editor stay where they are.
pub fn changed(old: &str, new: &str) -> Vec<Edit> {
    let diff = TextDiff::from_lines(old, new);
    let olds = Lines::of(diff.iter_old_slices());
    let news = Lines::of(diff.iter_new_slices());
    let mut edits = Vec::new();
    for op in diff.ops() {
        if matches!(op, DiffOp::Equal { .. }) {
            continue;
        }
        let (removed, added) = (op.old_range(), op.new_range());
        if removed.len() == added.len() {
            for (removed, added) in removed.zip(added) {
                let (from, to) = (
                    olds.range(removed..removed + 1),
                    news.range(added..added + 1),
                );
                edits.push(narrowed(old, from, &new[to]));
            }
        } else {
            let (from, to) = (olds.range(removed), news.range(added));
            edits.push(narrowed(old, from, &new[to]));
        }
    }
    edits
}

/// Where lines begin, and where the last ends.
struct Lines(Vec<usize>);

impl Lines {
    fn of<'l>(lines: impl Iterator<Item = &'l str>) -> Self {
        let mut starts = vec![0];
        let mut end = 0;
        for line in lines {
            end += line.len();
            starts.push(end);
        }
        Self(starts)
    }

    fn range(&self, lines: std::ops::Range<usize>) -> std::ops::Range<usize> {
        self.0[lines.start]..self.0[lines.end]
    }
}

/// The edit that puts `new` in the place `at` of `text`, without what stays.
pub(crate) fn narrowed(text: &str, at: std::ops::Range<usize>, new: &str) -> Edit {
    let old = &text[at.clone()];
    let same = |(a, b): &(char, char)| a == b;
    let bytes = |(c, _): (char, char)| c.len_utf8();
    let mut before: usize = old
        .chars()
        .zip(new.chars())
        .take_while(same)
        .map(bytes)
        .sum();
    // A line end of two characters is one to an editor.
    if old[..before].ends_with('\r') {
        before -= 1;
    }
    let (old_rest, new_rest) = (&old[before..], &new[before..]);
    let backwards = old_rest.chars().rev().zip(new_rest.chars().rev());
    let mut behind: usize = backwards.take_while(same).map(bytes).sum();
    let splits = |rest: &str| rest[..rest.len() - behind].ends_with('\r');
    if behind > 0 && (splits(old_rest) || splits(new_rest)) {
        behind -= 1;
    }
    Edit {
        span: Span::new(at.start + before, at.end - behind),
        text: new_rest[..new_rest.len() - behind].to_owned(),
    }
}

/// `text` after `edits`, none overlapping another.
pub fn edited(text: &str, edits: &[Edit]) -> String {
    let mut in_order: Vec<&Edit> = edits.iter().collect();
    in_order.sort_by_key(|edit| edit.span);
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for edit in in_order {
        let range = edit.span.range();
        out.push_str(text.get(done..range.start).unwrap_or_default());
        out.push_str(&edit.text);
        done = done.max(range.end);
    }
    out.push_str(text.get(done..).unwrap_or_default());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What each edit takes away and puts there.
    #[track_caller]
    fn check(old: &str, new: &str, expected: &[(&str, &str)]) {
        let edits = changed(old, new);
        let found: Vec<_> = edits
            .iter()
            .map(|it| (&old[it.span.range()], &*it.text))
            .collect();
        assert_eq!(found, expected);
        assert_eq!(edited(old, &edits), new);
    }

    #[test]
    fn only_what_differs_is_replaced() {
        check("a\nb\nc\n", "a\nb\nc\n", &[]);
        check("a\nrung:b->c\nd\n", "a\nrung: b->c\nd\n", &[("", " ")]);
        check("a\nb\nc\n", "a\nc\n", &[("b\n", "")]);
        check("a\nc\n", "a\nb\nc\n", &[("", "b\n")]);
        check("\u{e4}1\n", "\u{e4}2\n", &[("1", "2")]);
    }

    #[test]
    fn each_line_is_an_edit_of_its_own() {
        check(
            "x=1\ny=1\n",
            "x = 1\ny = 1\n",
            &[("=", " = "), ("=", " = ")],
        );
    }

    #[test]
    fn line_ends_are_replaced_whole() {
        check("a\r\nb", "a\nb", &[("\r\n", "\n")]);
        check("a\nb", "a\r\nb", &[("\n", "\r\n")]);
        check("a", "a\r\n", &[("", "\r\n")]);
    }
}
