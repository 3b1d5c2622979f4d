//! Findings as text for people.
//!
//! The first line of each is `path:line:column: severity[code]: message`, which
//! editors and terminals turn into a link; the source and the advice follow.

use std::fmt::Write;
use std::path::Path;

use source::{Diagnostic, LineColumn, Span};

use super::excerpt::excerpt;
use super::{Findings, printable};
use crate::colour::Paint;
use crate::input;

/// All findings of a file, each followed by an empty line.
pub fn text(findings: &Findings, paint: Paint) -> String {
    let name = printable(&input::name(&findings.path));
    let mut out = String::new();
    for diagnostic in &findings.diagnostics {
        let label = label(diagnostic, paint);
        let message = paint.bold(&printable(&diagnostic.message));
        head(
            &mut out,
            &name,
            findings.start(diagnostic.span),
            &label,
            &message,
        );
        let mark = |marks: &str| paint.severity(diagnostic.severity, marks);
        let margin = source(&mut out, findings, diagnostic.span, paint, mark);
        if let Some(help) = &diagnostic.help {
            advice(&mut out, margin, "help", help, paint);
        }
        for related in &diagnostic.related {
            let message = printable(&related.message);
            let start = findings.start(related.span);
            head(&mut out, &name, start, &paint.bold("note"), &message);
            source(&mut out, findings, related.span, paint, |marks| {
                paint.bold(marks)
            });
        }
        out.push('\n');
    }
    out
}

/// A finding about a file whose text could not be had.
pub fn unreadable(path: &Path, diagnostic: &Diagnostic, paint: Paint) -> String {
    let name = printable(&input::name(path));
    let label = label(diagnostic, paint);
    let message = paint.bold(&printable(&diagnostic.message));
    let mut out = format!("{name}: {label}: {message}\n");
    if let Some(help) = &diagnostic.help {
        advice(&mut out, 0, "help", help, paint);
    }
    out
}

/// `error[G1101]`.
fn label(diagnostic: &Diagnostic, paint: Paint) -> String {
    let plain = format!("{}[{}]", diagnostic.severity.word(), diagnostic.code);
    paint.severity(diagnostic.severity, &plain)
}

fn head(out: &mut String, name: &str, start: LineColumn, label: &str, message: &str) {
    let LineColumn { line, column } = start;
    out.push_str(&format!("{name}:{line}:{column}: {label}: {message}\n"));
}

/// The line on which `span` begins and the marks under it; gives the width of
/// the margin.
fn source(
    out: &mut String,
    findings: &Findings,
    span: Span,
    paint: Paint,
    mark: impl Fn(&str) -> String,
) -> usize {
    let found = excerpt(&findings.text, span);
    let number = format!(" {}", findings.start(span).line);
    let last = findings.end(span).line;
    let margin = " ".repeat(number.len());
    let bar = paint.faint("|");
    let number = paint.faint(&number);
    let line = format!("{number} {bar} {}", found.line);
    let indent = " ".repeat(found.indent);
    let marks = mark(&"^".repeat(found.marks));
    let reach = if last > findings.start(span).line {
        format!(" to line {last}")
    } else {
        String::new()
    };
    // Writing into a string cannot fail.
    let _ = writeln!(out, "{}", line.trim_end());
    let _ = writeln!(out, "{margin} {bar} {indent}{marks}{reach}");
    margin.len()
}

fn advice(out: &mut String, margin: usize, kind: &str, text: &str, paint: Paint) {
    let margin = " ".repeat(margin);
    let kind = paint.bold(kind);
    out.push_str(&format!("{margin} = {kind}: {}\n", printable(text)));
}

#[cfg(test)]
mod tests {
    use source::codes;

    use super::*;

    fn show(text_of_file: &str, diagnostic: Diagnostic, paint: Paint) -> String {
        let bytes = text_of_file.as_bytes().to_vec();
        let findings = Findings::new("tank.ladder".into(), bytes, vec![diagnostic]);
        text(&findings, paint)
    }

    #[test]
    fn a_finding_shows_its_place_its_help_and_the_other_places() {
        let diagnostic = Diagnostic::new(
            codes::DECLARED_TWICE,
            Span::new(16, 18),
            "`v1` is declared twice",
        )
        .help("remove one of the two")
        .related(Span::new(7, 9), "first declared here");
        let expected = "\
tank.ladder:2:7: error[G1102]: `v1` is declared twice
 2 | input v1
   |       ^^
   = help: remove one of the two
tank.ladder:1:8: note: first declared here
 1 | output v1
   |        ^^

";
        let shown = show("output v1\ninput v1\n", diagnostic, Paint::PLAIN);
        assert_eq!(shown, expected);
    }

    #[test]
    fn a_finding_about_several_lines_says_how_far_it_reaches() {
        let diagnostic = Diagnostic::new(codes::UNREACHABLE_RUNG, Span::new(0, 9), "never solved");
        let shown = show("rung: a\n -> b\n", diagnostic, Paint::PLAIN);
        assert!(
            shown.contains(" 1 | rung: a\n   | ^^^^^^^ to line 2\n"),
            "{shown}"
        );
    }

    #[test]
    fn a_message_cannot_command_the_terminal() {
        let diagnostic = Diagnostic::new(codes::UNKNOWN_BOX, Span::at(0), "box `\x1b[2J`");
        let shown = show("x", diagnostic, Paint::PLAIN);
        assert!(!shown.contains('\x1b'), "{shown}");
    }
}
