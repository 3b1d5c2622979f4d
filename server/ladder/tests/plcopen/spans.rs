//! Spans point at what they say they do.

use std::path::Path;

use ladder::{ElementKind, Operand, Program, Value};
use source::Span;

use crate::picture::element;
use crate::places::{corpus, repository, xml_files};

#[test]
fn every_element_is_a_tag_and_every_operand_is_written_in_full() {
    let mut files = xml_files(&repository("fixtures/plcopen"));
    files.extend(xml_files(&repository("fixtures/neutralization")));
    files.extend(corpus().unwrap_or_default());
    let mut operands = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a file in UTF-8");
        let reading = ladder::read(text.as_bytes());
        operands += check(&file, &text, &reading.program);
    }
    assert!(operands > 100, "only {operands} operands looked at");
}

/// The number of operands that were looked at.
fn check(file: &Path, text: &str, program: &Program) -> usize {
    let at = |span: Span| {
        text.get(span.range())
            .unwrap_or_else(|| panic!("{span:?} is no part of {}", file.display()))
    };
    let mut looked_at = 0;
    for (_, rung) in program.rungs() {
        for (_, found) in rung.network.elements() {
            let what = element(&found.kind);
            let written = at(rung.place(found.within));
            if matches!(found.kind, ElementKind::Rail) {
                continue;
            }
            assert!(
                written.starts_with('<') && written.ends_with('>'),
                "{what} of {} stands at {written:?}",
                file.display()
            );
            assert!(
                rung.span.cover(rung.place(found.within)) == rung.span,
                "{what}"
            );
            for operand in operands(&found.kind) {
                looked_at += 1;
                let declared = program.declarations.find(&operand.name);
                let addressed = declared.is_some_and(|found| found.address.is_some());
                assert!(
                    addressed || names(at(rung.place(operand.within)), &operand.name),
                    "`{}` of {what} in {} stands at {:?}",
                    operand.name,
                    file.display(),
                    at(rung.place(operand.within))
                );
            }
        }
    }
    for declaration in program.declarations.iter() {
        let written = at(declaration.span);
        assert!(written.starts_with('<'), "{written}");
    }
    for chart in &program.charts {
        for step in &chart.steps {
            assert!(at(step.span).contains(&*step.name));
        }
        for transition in &chart.transitions {
            assert!(at(transition.span).starts_with("<transition"));
        }
    }
    looked_at
}

fn operands(kind: &ElementKind) -> Vec<&Operand> {
    match kind {
        ElementKind::Contact(contact) => vec![&contact.operand],
        ElementKind::Coil(coil) => vec![&coil.operand],
        ElementKind::Timer(timer) => vec![&timer.instance],
        ElementKind::Counter(counter) => vec![&counter.instance],
        ElementKind::Assign(assignment) => match &assignment.value {
            Value::Copy(operand) => vec![&assignment.target, operand],
            _ => vec![&assignment.target],
        },
        _ => Vec::new(),
    }
}

/// Whether the bytes write the name: in any case, perhaps without its scope
/// or, for a pin, as the instance alone; a made-up name or a term stands at
/// its element; a global one with its list. What has an address may go by that or by another name.
fn names(written: &str, name: &str) -> bool {
    let upper = |text: &str| {
        let text = text.trim().to_uppercase();
        text.split('[').next().unwrap_or_default().to_owned()
    };
    let (written, name) = (upper(written), upper(name));
    let instance = name.rsplit_once('.').map_or("", |(instance, _)| instance);
    name.ends_with(&written)
        || written.ends_with(&format!(".{name}"))
        || instance.ends_with(&written) && !instance.is_empty()
        || written.starts_with('<')
}
