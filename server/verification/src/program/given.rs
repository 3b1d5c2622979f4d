//! What a program says before anything is followed.

use std::collections::{HashMap, HashSet};

use ladder::scan::Machine;
use ladder::{Class, ElementKind, Program};
use logic::{Datum, Name};

use super::Bounds;
use crate::refusal::Refusal;

/// What the program says before anything is followed.
#[derive(Debug, Default)]
pub(super) struct Given {
    /// Values before the first scan; all others are 0.
    pub(super) initial: HashMap<Name, Datum>,
    /// What is declared never to change.
    pub(super) constants: HashMap<Name, Datum>,
    /// Instances that timers or counters of different kinds share.
    pub(super) mixed: HashSet<Name>,
    /// How many bits whole numbers have by their type, and whether the highest is
    /// a sign.
    pub(super) widths: HashMap<Name, (u32, bool)>,
}

impl Given {
    /// What is said in the declarations, and which instances are shared.
    pub(super) fn of(
        program: &Program,
        machine: &Machine<'_>,
        bounds: &Bounds,
    ) -> Result<Self, Refusal> {
        let initial = machine.stored();
        let initial: HashMap<Name, Datum> =
            initial.map(|(name, value)| (name.clone(), value)).collect();
        bounds.is_wanted()?;
        let constants = program.declarations.iter().filter_map(|declaration| {
            let is_constant = declaration.class == Class::Constant;
            let value = initial.get(&declaration.name).filter(|_| is_constant)?;
            Some((declaration.name.clone(), *value))
        });
        let constants = constants.collect();
        let mut kinds = HashMap::new();
        let mut mixed = HashSet::new();
        for (_, rung) in program.rungs() {
            bounds.is_wanted()?;
            for (_, element) in rung.network.elements() {
                let (name, kind) = match &element.kind {
                    ElementKind::Timer(it) => (&it.instance.name, format!("{:?}", it.kind)),
                    ElementKind::Counter(it) => (&it.instance.name, format!("{:?}", it.kind)),
                    _ => continue,
                };
                let known = kinds.entry(name.clone()).or_insert_with(|| kind.clone());
                if *known != kind {
                    mixed.insert(name.clone());
                }
            }
        }
        let widths = program.declarations.iter().filter_map(|declaration| {
            let width = width_of(declaration.data_type.as_deref()?)?;
            Some((declaration.name.clone(), width))
        });
        Ok(Self {
            initial,
            constants,
            mixed,
            widths: widths.collect(),
        })
    }
}

/// How many bits a whole number of this type has, and whether the highest is a
/// sign.
fn width_of(data_type: &str) -> Option<(u32, bool)> {
    Some(match &*data_type.to_ascii_uppercase() {
        "SINT" => (8, true),
        "INT" => (16, true),
        "DINT" => (32, true),
        "USINT" | "BYTE" => (8, false),
        "UINT" | "WORD" => (16, false),
        "UDINT" | "DWORD" => (32, false),
        _ => return None,
    })
}
