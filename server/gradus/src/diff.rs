//! What a new layout would change, as a unified diff that `patch` takes.

use similar::{ChangeTag, TextDiff};

use crate::colour::Paint;

/// The difference between the old and the new text of the file called `name`.
pub fn unified(name: &str, old: &str, new: &str, paint: Paint) -> String {
    let diff = TextDiff::from_lines(old, new);
    let mut out = paint.bold(&format!("--- {name}")) + "\n";
    out += &paint.bold(&format!("+++ {name}"));
    out.push('\n');
    for hunk in diff.unified_diff().context_radius(3).iter_hunks() {
        out += &paint.faint(&hunk.header().to_string());
        out.push('\n');
        for change in hunk.iter_changes() {
            let line = change.value().trim_end_matches('\n');
            out += &match change.tag() {
                ChangeTag::Equal => format!(" {line}"),
                ChangeTag::Delete => paint.removed(&format!("-{line}")),
                ChangeTag::Insert => paint.added(&format!("+{line}")),
            };
            out.push('\n');
            if change.missing_newline() {
                out += "\\ No newline at end of file\n";
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_line_is_shown_old_and_new() {
        let diff = unified(
            "tank.ladder",
            "a\nrung:s->v\n",
            "a\nrung: s -> v\n",
            Paint::PLAIN,
        );
        let expected = "\
--- tank.ladder
+++ tank.ladder
@@ -1,2 +1,2 @@
 a
-rung:s->v
+rung: s -> v
";
        assert_eq!(diff, expected);
    }

    #[test]
    fn a_missing_line_end_is_told() {
        let diff = unified("a", "x", "x\n", Paint::PLAIN);
        assert!(
            diff.contains("-x\n\\ No newline at end of file\n+x\n"),
            "{diff}"
        );
    }
}
