//! A simulation for people: a line for each scan, and what was wrong below it.

use logic::notation::time;
use recovery::simulation::{Row, Simulation, Subject};
use scenario::Scenario;

use crate::colour::Paint;
use crate::report::{on, printable};

/// Blanks between two columns.
const GAP: usize = 2;

/// The table, with its head.
pub fn table(
    scenario: &Scenario,
    simulation: &Simulation,
    subject: Subject<'_>,
    line_of: impl Fn(usize) -> Option<usize>,
    paint: Paint,
) -> String {
    let shows_differences = subject.ladder.is_some() && subject.grafcet.is_some();
    let columns: Vec<Column> = [
        (true, "scan", Column::scan as fn(&Context<'_>) -> String),
        (true, "time", Column::time),
        (true, "done", Column::done),
        (subject.ladder.is_some(), "ladder", Column::ladder),
        (subject.grafcet.is_some(), "active steps", Column::active),
        (subject.grafcet.is_some(), "spec", Column::spec),
        (shows_differences, "differ", Column::differ),
    ]
    .into_iter()
    .filter(|(is_shown, ..)| *is_shown)
    .map(|(_, head, cell)| Column { head, cell })
    .collect();
    let contexts = simulation.rows.iter().enumerate().map(|(at, row)| Context {
        scenario,
        simulation,
        row,
        is_first: at.checked_sub(1).is_none_or(|at| {
            let before = &simulation.rows[at];
            before.step != row.step || before.is_last
        }),
    });
    let rows: Vec<(Vec<String>, &Row)> = contexts
        .map(|context| {
            let cells = columns.iter().map(|column| (column.cell)(&context));
            (cells.collect(), context.row)
        })
        .collect();
    let widths: Vec<usize> = columns
        .iter()
        .enumerate()
        .map(|(at, column)| {
            let cells = rows.iter().map(|(cells, _)| width(&cells[at]));
            cells.max().unwrap_or(0).max(width(column.head))
        })
        .collect();
    let heads: Vec<String> = columns.iter().map(|it| it.head.to_owned()).collect();
    let mut out = paint.bold(&line(&heads, &widths)) + "\n";
    for (cells, row) in &rows {
        let text = line(cells, &widths);
        let is_wrong = !row.differences.is_empty();
        out += &if is_wrong { paint.error(&text) } else { text };
        out.push('\n');
        for failure in &row.failures {
            let sentence = printable(&failure.sentence());
            let place = match line_of(row.step) {
                Some(line) => format!("line {line}: {sentence}"),
                None => sentence,
            };
            let indent = " ".repeat(widths[0] + GAP);
            out += &format!("{indent}{}\n", paint.error(&place));
        }
    }
    out
}

struct Column {
    head: &'static str,
    cell: fn(&Context<'_>) -> String,
}

/// What a cell is made of.
struct Context<'c> {
    scenario: &'c Scenario,
    simulation: &'c Simulation,
    row: &'c Row,
    /// Whether it is the first row of its step.
    is_first: bool,
}

impl Column {
    fn scan(context: &Context<'_>) -> String {
        context.row.scan.to_string()
    }

    fn time(context: &Context<'_>) -> String {
        time(context.row.time_ms)
    }

    fn done(context: &Context<'_>) -> String {
        let step = context.scenario.steps.get(context.row.step);
        let step = step.filter(|_| context.is_first);
        step.map_or_else(String::new, |step| printable(&scenario::done(step)))
    }

    fn ladder(context: &Context<'_>) -> String {
        on(context
            .simulation
            .ladder
            .iter()
            .zip(&context.row.values.ladder))
    }

    fn active(context: &Context<'_>) -> String {
        printable(&context.row.values.active.join(" "))
    }

    fn spec(context: &Context<'_>) -> String {
        on(context
            .simulation
            .grafcet
            .iter()
            .zip(&context.row.values.grafcet))
    }

    fn differ(context: &Context<'_>) -> String {
        printable(&context.row.differences.join(" "))
    }
}

fn width(text: &str) -> usize {
    unicode_width::UnicodeWidthStr::width(text)
}

fn line(cells: &[String], widths: &[usize]) -> String {
    let mut out = String::new();
    for (cell, column) in cells.iter().zip(widths) {
        out += cell;
        out += &" ".repeat(column + GAP - width(cell));
    }
    out.trim_end().to_owned()
}
