//! Whether every place that a reading names lies in the text.

use ladder::{Element, ElementKind, Operand, Reading, Rung};
use source::{Diagnostic, Span};

/// The first place that does not lie in `bytes`, or ends inside a character.
pub fn outside(bytes: &[u8], reading: &Reading) -> Option<String> {
    let text = std::str::from_utf8(bytes).ok();
    let is_inside = |span: Span| match text {
        Some(text) => text.get(span.range()).is_some(),
        None => span.range().end <= bytes.len(),
    };
    let program = &reading.program;
    let found = reading.diagnostics.iter().flat_map(of_diagnostic);
    let declared = program
        .declarations
        .iter()
        .map(|it| (it.span, format!("declaration of {}", it.name)));
    let routines = program
        .routines
        .iter()
        .map(|it| (it.span, format!("routine {}", it.scope)));
    let rungs = program
        .rungs()
        .map(|(_, it)| (it.span, format!("rung {}", it.number)));
    let elements = program
        .rungs()
        .flat_map(|(_, rung)| rung.network.elements().map(move |(_, it)| (rung, it)))
        .flat_map(|(rung, element)| of_element(rung, element));
    let charts = program.charts.iter().flat_map(|chart| {
        let steps = chart.steps.iter().map(|step| step.span);
        let transitions = chart.transitions.iter().map(|it| it.span);
        std::iter::once(chart.span)
            .chain(steps)
            .chain(transitions)
            .map(|span| (span, format!("chart {}", chart.scope)))
    });
    found
        .chain(declared)
        .chain(routines)
        .chain(rungs)
        .chain(elements)
        .chain(charts)
        .find(|(span, _)| !is_inside(*span))
        .map(|(span, what)| format!("{what} at {span:?}"))
}

/// The places that a finding names.
fn of_diagnostic(it: &Diagnostic) -> Vec<(Span, String)> {
    let related = it.related.iter().map(|related| related.span);
    let edits = it.fix.iter().flat_map(|fix| &fix.edits);
    std::iter::once(it.span)
        .chain(related)
        .chain(edits.map(|edit| edit.span))
        .map(|span| (span, format!("{} {:?}", it.code, it.message)))
        .collect()
}

fn of_element(rung: &Rung, element: &Element) -> Vec<(Span, String)> {
    let operands = operands(element).into_iter().map(|operand| {
        (
            rung.place(operand.within),
            format!("operand {}", operand.name),
        )
    });
    std::iter::once((rung.place(element.within), format!("{element:?}")))
        .chain(operands)
        .collect()
}

fn operands(element: &Element) -> Vec<&Operand> {
    let kind = &element.kind;
    let mut operands = kind.reads();
    operands.extend(kind.writes());
    match kind {
        ElementKind::Call(call) => operands.push(&call.routine),
        ElementKind::Jump(label) | ElementKind::Label(label) => operands.push(label),
        _ => {}
    }
    operands
}
