//! What a program reads that the machine does not compute.

use std::collections::BTreeSet;

use logic::Name;

use super::atom::{own_atom, pin_atom};
use super::state::State;
use crate::{Block, ElementKind, Network, Operand, PinDirection, Port, Program, Role, Value};

/// Names whose values nothing in the machine produces, though the program
/// would: outputs of boxes that are not modelled, terms that cannot be
/// computed, presets that the source does not give, arguments of calls.
pub(super) fn unknown(program: &Program, state: &State) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    let routines = program.routines.iter();
    let all = program.is_only_definitions();
    for routine in routines.filter(|it| all || it.role != Role::Definition) {
        for rung in &routine.rungs {
            of_network(&rung.network, state, &mut names);
        }
    }
    names
}

fn of_network(network: &Network, state: &State, names: &mut BTreeSet<Name>) {
    let term = |names: &mut BTreeSet<Name>, text: &Name| {
        if state.compute(text).is_none() {
            names.insert(text.clone());
        }
    };
    for (at, element) in network.elements() {
        match &element.kind {
            ElementKind::Comparison(comparison) => {
                term(names, &comparison.left.name);
                term(names, &comparison.right.name);
            }
            ElementKind::Assign(assignment) => match &assignment.value {
                Value::Copy(operand) => term(names, &operand.name),
                Value::Term { text, .. } => term(names, text),
                Value::Constant(_) | Value::Increment(_) => {}
            },
            ElementKind::Timer(timer) => match &timer.preset_from {
                Some(variable) => term(names, &variable.name),
                None => preset(&timer.instance, state, names),
            },
            ElementKind::Counter(counter) => match &counter.preset_from {
                Some(variable) => term(names, &variable.name),
                None => preset(&counter.instance, state, names),
            },
            ElementKind::Call(call) => {
                names.extend(call.arguments.iter().map(|operand| operand.name.clone()));
            }
            ElementKind::Block(block) => {
                outputs(block, names);
                if block.shapes_power {
                    names.insert(own_atom(network, at));
                }
                for (_, wire) in network.leaving(at) {
                    if let Port::Pin(pin) = &wire.from {
                        names.insert(pin_atom(network, at, pin));
                    }
                }
            }
            _ => {}
        }
    }
}

/// A preset that neither the source nor a declaration gives.
fn preset(instance: &Operand, state: &State, names: &mut BTreeSet<Name>) {
    let name = format!("{}.PRE", instance.name);
    if !state.holds(&name) {
        names.insert(name.into());
    }
}

fn outputs(block: &Block, names: &mut BTreeSet<Name>) {
    let written = block
        .pins
        .iter()
        .filter(|pin| pin.direction != PinDirection::Input)
        .filter_map(|pin| pin.operand.as_ref());
    names.extend(written.map(|operand| operand.name.clone()));
}
