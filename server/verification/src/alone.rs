//! One side by itself, as a netlist for other tools.

use grafcet::Spec;
use ladder::{Class, Program, Role};
use logic::{Datum, Name};
use proof::{Limits, Netlist, Signal, Verdict, check};

use crate::chart;
use crate::program::{self, Bounds};
use crate::refusal::Refusal;

/// Evolutions of a scan that are followed at most.
const MOST_EVOLUTIONS: usize = 256;

/// A ladder as a netlist. Its outputs are the variables that are declared so, or,
/// where none is, all that the ladder writes; of a number there is an output for
/// each value, or for each bit where its bits are followed.
pub fn of_ladder(program: &Program, limits: &Limits) -> Result<Netlist, Refusal> {
    let followed = program::follow(program, None, &bounds(limits))?;
    let declared = program
        .declarations
        .iter()
        .filter(|it| it.class == Class::Output);
    let declared = declared
        .map(|it| it.name.clone())
        .filter(|name| followed.writes(name));
    let mut names: Vec<Name> = declared.collect();
    if names.is_empty() {
        names = written(program);
    }
    let mut netlist = followed.netlist.clone();
    for name in names {
        show(
            &mut netlist,
            &name,
            followed.cases(&name),
            followed.bits(&name),
        );
    }
    Ok(netlist)
}

/// A spec as a netlist. As many evolutions of a scan are followed as it takes;
/// a grafcet that may find no stable situation is refused.
pub fn of_spec(spec: &Spec, limits: &Limits) -> Result<Netlist, Refusal> {
    let mut evolutions = 2;
    loop {
        let evolved = chart::follow(spec, None, evolutions, &bounds(limits))?;
        let mut asked = evolved.netlist.clone();
        asked.never("unstable", evolved.unstable);
        match check(&asked, limits).verdict {
            Verdict::Equivalent => {
                let mut netlist = evolved.netlist.clone();
                for name in evolved.outputs() {
                    show(&mut netlist, name, evolved.cases(name), evolved.bits(name));
                }
                return Ok(netlist);
            }
            Verdict::Different(_) if evolutions < MOST_EVOLUTIONS => evolutions *= 2,
            _ => return Err(Refusal::NotStable),
        }
    }
}

fn bounds(limits: &Limits) -> Bounds {
    Bounds {
        gates: limits.gates,
        cancel: limits.cancel.clone(),
        ..Bounds::default()
    }
}

/// What the routines of a program write that run by themselves or are called.
fn written(program: &Program) -> Vec<Name> {
    let is_all = program.is_only_definitions();
    let mut names = Vec::new();
    for (routine, rung) in program.rungs() {
        if is_all || routine.role != Role::Definition {
            let elements = rung.network.elements();
            let written = elements.flat_map(|(_, element)| element.kind.writes());
            names.extend(written.map(|operand| operand.name.clone()));
        }
    }
    let mut seen = std::collections::HashSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

/// Names the values of a variable as outputs, or its bits where these are followed.
fn show(netlist: &mut Netlist, name: &Name, cases: &[(Datum, Signal)], bits: &[Signal]) {
    for (at, bit) in bits.iter().enumerate() {
        netlist.output(format!("{name}.{at}"), *bit);
    }
    let is_bit = cases
        .iter()
        .all(|(value, _)| matches!(value, Datum::Bool(_)));
    match is_bit && !cases.is_empty() {
        true => {
            let on = cases.iter().find(|(value, _)| value.is_on());
            netlist.output(name.clone(), on.map_or(Signal::FALSE, |(_, when)| *when));
        }
        false => {
            for (value, when) in cases {
                netlist.output(format!("{name}={value}"), *when);
            }
        }
    }
}
