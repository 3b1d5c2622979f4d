use ::ladder::{CoilKind, Element, ElementKind, Program, Routine, Rung};
use source::Span;

use super::{Symbol, SymbolKind, title};
use crate::navigate::{state_of, written};
use crate::routine::{routine_name, unit_name};
use crate::{Ladder, describe, kind_word};

/// Programs, their routines, the rungs of these, and what each rung drives.
pub fn symbols_of_ladder(ladder: &Ladder) -> Vec<Symbol> {
    View {
        program: ladder.program(),
        text: &ladder.text,
        analysed: Some(ladder),
    }
    .units()
}

/// The same names, of a program that was read from `text` and not analysed:
/// nothing tells states from other coils, or step registers from other numbers.
pub fn names_of_program(program: &Program, text: &str) -> Vec<Symbol> {
    View {
        program,
        text,
        analysed: None,
    }
    .units()
}

/// What is listed.
struct View<'v> {
    program: &'v Program,
    text: &'v str,
    /// What was recovered from it.
    analysed: Option<&'v Ladder>,
}

impl View<'_> {
    fn units(&self) -> Vec<Symbol> {
        let routines = &self.program.routines;
        let units = routines.chunk_by(|one, other| one.unit == other.unit);
        units.flat_map(|unit| self.unit(unit)).collect()
    }

    /// The program that holds these routines; they alone where it has no name.
    fn unit(&self, routines: &[Routine]) -> Vec<Symbol> {
        let [first, ..] = routines else {
            return Vec::new();
        };
        let alone = routines.len() == 1 && (first.name == first.unit || first.unit.is_empty());
        if alone {
            let kind = match first.unit.is_empty() {
                true => SymbolKind::Routine,
                false => SymbolKind::Program,
            };
            return vec![self.routine(first, kind)];
        }
        let children = routines
            .iter()
            .map(|it| self.routine(it, SymbolKind::Routine))
            .collect();
        if first.unit.is_empty() {
            return children;
        }
        let whole = routines
            .iter()
            .fold(first.span, |all, it| all.cover(it.span));
        let name = unit_name(self.program, self.text, first);
        let name = name.unwrap_or(Span::at(whole.range().start));
        vec![Symbol {
            children,
            ..Symbol::new(SymbolKind::Program, &*first.unit, whole, name)
        }]
    }

    fn routine(&self, routine: &Routine, kind: SymbolKind) -> Symbol {
        let name = routine_name(self.program, self.text, routine);
        let name = name.unwrap_or(Span::at(routine.span.range().start));
        Symbol {
            children: routine.rungs.iter().map(|it| self.rung(it)).collect(),
            ..Symbol::new(kind, &*routine.name, routine.span, name)
        }
    }

    fn rung(&self, rung: &Rung) -> Symbol {
        let name = match rung.comment.as_deref().map(title) {
            Some(title) if !title.is_empty() => format!("rung {}: {title}", rung.number),
            _ => format!("rung {}", rung.number),
        };
        let elements = rung.network.elements();
        let children = elements.filter_map(|(_, element)| self.driven(rung, element));
        Symbol {
            children: children.collect(),
            ..Symbol::new(SymbolKind::Rung, name, rung.span, rung.span)
        }
    }

    /// What an element drives; `None` of one that only passes power on.
    fn driven(&self, rung: &Rung, element: &Element) -> Option<Symbol> {
        let whole = rung.place(element.within);
        let text = || self.text.get(whole.range()).unwrap_or_default();
        let kind = match &element.kind {
            ElementKind::Coil(coil) => {
                let name = &coil.operand.name;
                let analysis = self.analysed.map(|it| &it.analysis);
                let is_state = analysis.is_some_and(|it| it.states().find(name).is_some());
                let mut words = Vec::new();
                if coil.kind != CoilKind::Plain {
                    words.push(kind_word(coil.kind).to_owned());
                }
                if is_state {
                    words.push("state".to_owned());
                }
                words.extend(analysis.and_then(|it| it.description(name).map(|it| title(&it))));
                let kind = match is_state {
                    true => SymbolKind::State,
                    false => SymbolKind::Coil,
                };
                let symbol = Symbol::new(kind, &**name, whole, rung.place(coil.operand.within));
                return Some(symbol.detailed(words.join(", ")));
            }
            kind @ ElementKind::Assign(_) => match self.analysed {
                Some(ladder) => match state_of(ladder, kind) {
                    Some(state) => {
                        let symbol = Symbol::new(SymbolKind::State, &*state, whole, whole);
                        return Some(symbol.detailed("state of a step register"));
                    }
                    None => SymbolKind::Box,
                },
                None => {
                    let (number, value) = written(kind)?;
                    let name = format!("{number}={value}");
                    return Some(Symbol::new(SymbolKind::Value, name, whole, whole));
                }
            },
            ElementKind::Label(_) => SymbolKind::Label,
            ElementKind::Timer(_)
            | ElementKind::Counter(_)
            | ElementKind::ResetBox(_)
            | ElementKind::Call(_)
            | ElementKind::Jump(_)
            | ElementKind::Block(_) => SymbolKind::Box,
            _ => return None,
        };
        let name = describe::name(&element.kind, text());
        let name = match name.is_empty() {
            true => title(text()),
            false => name,
        };
        let symbol = Symbol::new(kind, name, whole, whole);
        Some(symbol.detailed(describe::summary(&element.kind)))
    }
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::super::drawn;
    use super::*;

    fn outline(text: &str) -> String {
        let ladder = Ladder::read(text.into(), &Budget::default());
        drawn(&symbols_of_ladder(&ladder), text, 0)
    }

    #[test]
    fn a_program_has_rungs_and_these_have_coils() {
        let text = "\
program Tank
output v1 // Fill
rung \"Fill the tank\": (s + v1) * /ls2 -> v1
rung: v1 -> set lamp
rung: v1 -> TON(t1, 5s), call Doors

routine Doors
rung label again: a -> b
";
        assert_eq!(
            outline(text),
            "\
Program Tank | - | Tank
  Routine Tank | - | Tank
    Rung rung 0: Fill the tank | - | rung \"Fill the tank\": (s + v1) * /ls2 -> v1
      State v1 | state, Fill | v1
    Rung rung 1 | - | rung: v1 -> set lamp
      Coil lamp | set | lamp
    Rung rung 2 | - | rung: v1 -> TON(t1, 5s), call Doors
      Box t1 | on-delay timer, 5s; its output is `t1.Q` | TON(t1, 5s)
      Box Doors | runs the routine while powered | call Doors
  Routine Doors | - | Doors
    Rung rung 0 | - | rung label again: a -> b
      Label again | where jumps to it arrive | again
      Coil b | - | b
"
        );
    }

    #[test]
    fn what_has_no_name_has_only_rungs() {
        assert_eq!(
            outline("rung: a -> b"),
            "\
Routine main | - | 
  Rung rung 0 | - | rung: a -> b
    Coil b | - | b
"
        );
        assert_eq!(outline(""), "");
    }

    #[test]
    fn names_need_no_analysis() {
        let text = "\
program Tank
rung \"Fill\": (s + v1) * /ls2 -> v1
rung: Seq = 0 * go -> Seq := 10, n := n + 1
";
        let program = ::ladder::read(text.as_bytes()).program;
        assert_eq!(
            drawn(&names_of_program(&program, text), text, 0),
            "\
Program Tank | - | Tank
  Rung rung 0: Fill | - | rung \"Fill\": (s + v1) * /ls2 -> v1
    Coil v1 | - | v1
  Rung rung 1 | - | rung: Seq = 0 * go -> Seq := 10, n := n + 1
    Value Seq=10 | - | Seq := 10
"
        );
    }

    #[test]
    fn values_of_a_step_register_are_states() {
        let text = "\
rung: Seq = 0 * go -> Seq := 10
rung: Seq = 10 * done -> Seq := 20
rung: Seq = 20 * back -> Seq := 0, n := 5
";
        let outline = outline(text);
        assert!(
            outline.contains("State Seq=10 | state of a step register | Seq := 10\n"),
            "{outline}"
        );
        assert!(
            outline.contains("Box n | :=: becomes 5 | n := 5\n"),
            "{outline}"
        );
    }
}
