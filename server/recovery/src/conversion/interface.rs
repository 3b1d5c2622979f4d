//! The variables that a spec reads and writes, declared.

use std::collections::BTreeSet;

use grafcet::{Grafcet, Variable};
use logic::{Atom, Expr, Name};

use crate::Analysis;

/// Declares every variable that the chart mentions: what its actions write as
/// outputs or internal variables, everything else as inputs.
pub(super) fn declare(analysis: &Analysis, grafcet: &mut Grafcet) {
    let steps: BTreeSet<&Name> = grafcet.chart.steps.iter().map(|step| &step.name).collect();
    let mut mentioned: BTreeSet<Name> = BTreeSet::new();
    let mut mention = |expr: &Expr| names_in(expr, &mut mentioned);
    for transition in &grafcet.chart.transitions {
        mention(&transition.receptivity);
    }
    for action in &grafcet.chart.actions {
        action.condition.iter().for_each(&mut mention);
    }
    mentioned.retain(|name| !steps.contains(name));
    let written: BTreeSet<Name> = grafcet
        .chart
        .actions
        .iter()
        .map(|action| action.output.clone())
        .collect();

    let declared = |name: &Name| Variable {
        name: name.clone(),
        address: analysis
            .program
            .declarations
            .find(name)
            .and_then(|declaration| declaration.address.clone()),
        comment: if analysis.conditions.atoms.find_variable(name).is_some() {
            analysis.description(name)
        } else if written.contains(name) {
            None
        } else {
            Some("too large to be written out".into())
        },
    };
    let atoms = &analysis.conditions.atoms;
    let place = |name: &&Name| {
        let atom = atoms.find_variable(name);
        (atom.is_none(), atom, Name::clone(name))
    };
    let mut outputs: Vec<&Name> = written.iter().collect();
    outputs.sort_by_cached_key(place);
    for name in outputs {
        let is_output = analysis
            .conditions
            .find(name)
            .is_some_and(|variable| analysis.is_output(variable));
        if is_output {
            grafcet.outputs.push(declared(name));
        } else {
            grafcet.internals.push(declared(name));
        }
    }
    let mut inputs: Vec<&Name> = mentioned.difference(&written).collect();
    inputs.sort_by_cached_key(place);
    grafcet.inputs = inputs.into_iter().map(declared).collect();
}

/// The variables that an expression mentions, numbers left out.
fn names_in(expr: &Expr, names: &mut BTreeSet<Name>) {
    expr.each_atom(&mut |atom| match atom {
        Atom::Variable(name) => {
            names.insert(name.clone());
        }
        Atom::Comparison(comparison) => {
            for side in [&comparison.left, &comparison.right] {
                if !side.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
                    names.insert(side.clone());
                }
            }
        }
        Atom::Rise(inner) | Atom::Fall(inner) => names_in(inner, names),
        Atom::Elapsed { step, .. } => {
            names.insert(step.clone());
        }
    });
}
