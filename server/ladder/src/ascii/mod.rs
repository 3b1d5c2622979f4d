//! Ladders drawn with characters.
//!
//! ```text
//! (* a comment *)        { a pragma, for other tools }
//!
//! |  Start     Stop  Run          names stand above their element
//! +--[ ]--+----[/]---( )--        `|` and `+` in the first column: the rail
//! |  Run  |                       `+` joins wires, `|` alone crosses them
//! +--[ ]--+           %T1
//! |                  +-----+
//! |  Level           | TON |      a box: type, then pins
//! +--[>]-->>Drain +--|IN  Q|--    `>>` jumps to a label
//! |  50        500ms-|PT ET|      the second side of a comparison below it
//! Drain:             +-----+
//! ```
//!
//! Contacts are `[ ]`, `[/]`, `[P]`, `[N]`, comparisons `[>]`, `[<>]` and so
//! on; coils `( )`, `(/)`, `(S)`, `(R)`, `(P)`, `(N)`; `<RETURN>` leaves the
//! routine. Contacts drawn `-| |-` are read too. Wires are traced, so a
//! drawing means what it shows: everything that a wire joins is one point.
//!
//! What is joined by wires, the rail aside, belongs to one rung; so does what
//! shares rows with it, since elements are solved row by row, each after those
//! that feed it. A text that holds such drawings between prose is not read.

mod boxes;
mod element;
mod grid;
mod notes;
mod rungs;
mod symbols;
mod wires;

use source::{Diagnostic, Span, codes};

use crate::reading::{Reading, Source};
use crate::{Format, Program, Role, Routine};

/// Whether a left rail is drawn, with labels at most above it: lines begin with
/// `|` or `+`, and one of them leads a wire to an element. A rail by itself is
/// an empty ladder; a table of some other text is none.
pub(crate) fn looks_like_it(text: &str) -> bool {
    let is_rail = |line: &String| line.starts_with(['|', '+']);
    let leads_somewhere = |line: &str| {
        line.starts_with("+-") || line.starts_with("|-") && line.contains(['[', '(', '>', '/'])
    };
    // The first line drawn tells most other texts, however long they are.
    if let Some(first) = drawn(beginning(text)).first()
        && !is_rail(first)
    {
        return false;
    }
    let drawn = drawn(text);
    if !drawn.first().is_some_and(is_rail) {
        return false;
    }
    drawn.iter().any(|line| leads_somewhere(line)) || drawn.iter().all(|line| line == "|")
}

/// The lines of a text from the first that is no label on, without notes and
/// blanks around them.
fn drawn(text: &str) -> Vec<String> {
    let source = Source { text, base: 0 };
    let (notes, _) = notes::notes(source);
    let grid = grid::Grid::new(source, &notes);
    let lines = grid.rows().filter_map(|row| row.text_from_first_mark());
    let drawn = lines.skip_while(|line| symbols::label(line).is_some());
    drawn.collect()
}

/// The first lines of a text, whole ones.
fn beginning(text: &str) -> &str {
    const LENGTH: usize = 4096;
    let piece = text.as_bytes().get(..LENGTH).unwrap_or_default();
    let end = memchr::memrchr(b'\n', piece).map_or(0, |at| at + 1);
    text.get(..end).unwrap_or_default()
}

/// Reads the drawing.
pub(crate) fn read(source: Source<'_>) -> Reading {
    let (notes, mut diagnostics) = notes::notes(source);
    let grid = grid::Grid::new(source, &notes);
    diagnostics.extend(grid.cut.map(too_large));
    let boxes = boxes::find(&grid);
    let drawing = symbols::drawing(&grid, boxes, &mut diagnostics);
    let wires = wires::trace(&drawing);
    let rungs = rungs::rungs(&grid, drawing, wires, &notes, &mut diagnostics);
    let mut program = Program::empty(Format::Ascii);
    program.routines.push(Routine {
        scope: "main".into(),
        unit: "main".into(),
        name: "main".into(),
        role: Role::Main,
        rungs,
        span: source.span(0, source.text.len()),
    });
    Reading {
        program: program.into(),
        diagnostics,
    }
}

fn too_large(cut: usize) -> Diagnostic {
    let message = format!(
        "the drawing has more than {} columns in all its rows",
        grid::MOST_COLUMNS
    );
    Diagnostic::new(codes::TOO_LARGE_FILE, Span::at(cut), message)
        .help("divide it into several files; what stands before this place is read")
}

#[cfg(test)]
mod tests {
    use super::looks_like_it;

    #[test]
    fn a_rail_with_a_wire_to_an_element_is_a_drawing() {
        for text in [
            "|\n",
            "+--[ ]--( )--\n",
            "(* note *)\n{ pragma }\nmain:\n|  a\n+--( )--\n",
            "|  a\n|--| |---( )---|\n",
        ] {
            assert!(looks_like_it(text), "{text}");
        }
    }

    #[test]
    fn tables_and_other_texts_are_no_drawings() {
        for text in [
            "",
            "(* only a comment *)",
            "| a | b |\n|---|---|\n| 1 | 2 |\n",
            "program X\nrung: a -> b\n",
            "main:\nrung: a -> b\n",
            "t1: p1*m |- @p2\n",
            "+1\n",
        ] {
            assert!(!looks_like_it(text), "{text}");
        }
    }
}
