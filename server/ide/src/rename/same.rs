//! Whether a program says the same as another, up to the name of one variable.

use ::ladder::{
    Assignment, Declaration, ElementKind, Operand, Program, Reading, Routine, Rung, Value, Within,
};
use logic::Name;
use source::Span;

use super::written::renamed;
use crate::Ladder;

/// Compares what was read before a renaming with what is read after it. The
/// error is the first place that says something else.
pub(super) fn up_to_name(
    ladder: &Ladder,
    after: &Reading,
    old: &Name,
    new: &Name,
) -> Result<(), String> {
    let before = ladder.program();
    let program = &after.program;
    let renaming = Renaming { ladder, old, new };
    let codes = |all: &[source::Diagnostic]| {
        let mut codes: Vec<_> = all.iter().map(|it| it.code.to_string()).collect();
        codes.sort();
        codes
    };
    let heads = |it: &Program| {
        (
            it.format,
            it.name.clone(),
            it.charts.len(),
            it.declarations.len(),
        )
    };
    if heads(before) != heads(program) || before.routines.len() != program.routines.len() {
        return Err("the program as a whole".to_owned());
    }
    for (before, after) in before.declarations.iter().zip(program.declarations.iter()) {
        if renaming.declaration(before) != unplaced(after) {
            return Err(format!("the declaration of `{}`", before.name));
        }
    }
    for (before, after) in before.routines.iter().zip(&program.routines) {
        renaming.routine(before, after)?;
    }
    match codes(ladder.diagnostics()) == codes(&after.diagnostics) {
        true => Ok(()),
        false => Err("the findings about the text".to_owned()),
    }
}

struct Renaming<'l> {
    ladder: &'l Ladder,
    old: &'l str,
    new: &'l str,
}

impl Renaming<'_> {
    fn routine(&self, before: &Routine, after: &Routine) -> Result<(), String> {
        let head = |it: &Routine| {
            (
                it.scope.clone(),
                it.unit.clone(),
                it.name.clone(),
                it.role,
                it.rungs.len(),
            )
        };
        if head(before) != head(after) {
            return Err(format!("the routine `{}`", before.name));
        }
        for (one, other) in before.rungs.iter().zip(&after.rungs) {
            if !self.is_same_rung(one, other) {
                return Err(before.name_of(one));
            }
        }
        Ok(())
    }

    fn is_same_rung(&self, before: &Rung, after: &Rung) -> bool {
        let head = |it: &Rung| (it.number, it.comment.clone(), it.network.len());
        if head(before) != head(after) {
            return false;
        }
        let mut pairs = before.network.elements().zip(after.network.elements());
        pairs.all(|((at, one), (other_at, other))| {
            let wires = before.network.arriving(at) == after.network.arriving(other_at);
            let plain = mapped(
                &other.kind,
                &|it| Operand::new(it.name.clone(), NOWHERE),
                &Name::clone,
            );
            wires
                && mapped(&one.kind, &|it| self.operand(before, it), &|it| {
                    self.name(it)
                }) == plain
        })
    }

    fn declaration(&self, it: &Declaration) -> Declaration {
        let name = |name: &Name| self.name(name);
        Declaration {
            name: name(&it.name),
            initial: it.initial.as_ref().map(name),
            ..unplaced(it)
        }
    }

    fn operand(&self, rung: &Rung, it: &Operand) -> Operand {
        let format = self.ladder.program().format;
        let written = self.ladder.text.get(rung.place(it.within).range());
        Operand::new(
            renamed(format, &it.name, written, self.old, self.new),
            NOWHERE,
        )
    }

    /// A name without a place, called as it is after the renaming.
    fn name(&self, name: &Name) -> Name {
        let format = self.ladder.program().format;
        renamed(format, name, None, self.old, self.new).into()
    }
}

const NOWHERE: Span = Span { start: 0, end: 0 };

/// An element with each of its operands and other names replaced.
fn mapped(
    kind: &ElementKind,
    operand: &dyn Fn(&Operand) -> Operand,
    name: &dyn Fn(&Name) -> Name,
) -> ElementKind {
    let mut kind = kind.clone();
    for variable in kind.variables_mut() {
        *variable = operand(variable);
    }
    // Routines and labels have names of their own.
    if let Some(destination) = kind.destination_mut() {
        destination.within = Within::default();
    }
    match &mut kind {
        ElementKind::Timer(timer) => timer.output = name(&timer.output),
        ElementKind::Counter(counter) => counter.output = name(&counter.output),
        // A term is its text and what it reads; of the two, only the second
        // tells names from other words.
        ElementKind::Assign(Assignment {
            value: Value::Term { text, .. },
            ..
        }) => *text = "".into(),
        _ => {}
    }
    kind
}

fn unplaced(it: &Declaration) -> Declaration {
    Declaration {
        span: Span::default(),
        ..it.clone()
    }
}
