//! A ladder and its spec as one transition system, and what is asked of it.

use logic::{Cancel, Name};
use proof::{Netlist, Signal};

use crate::Timing;
use crate::chart::{self, Evolved};
use crate::frame::Frame;
use crate::inputs::Source;
use crate::program::{Bounds, Followed};
use crate::ready::Ready;
use crate::refusal::Refusal;
use crate::rules::{Atoms, Steps, names_of};
use crate::value::Value;

/// The first properties of a comparison, which are no outputs; no variable is
/// called so.
pub(crate) const UNSTABLE: &str = "(unstable)";
pub(crate) const RESTLESS: &str = "(restless)";
const NO_OUTPUTS: usize = 2;

/// The system that is asked about, and its questions.
pub(crate) struct System {
    pub(crate) evolved: Evolved,
    pub(crate) frame: Frame,
    /// The outputs that are compared.
    pub(crate) outputs: Vec<Name>,
    /// Outputs of the spec that the ladder does not know.
    pub(crate) missing: Vec<Name>,
    /// Outputs with numbers that are not followed.
    pub(crate) numbers: Vec<Name>,
    /// What the properties speak of, of the ladder and not compared.
    pub(crate) watched: Vec<Name>,
    /// By output that is compared, whether the two sides differ.
    pub(crate) differ: Vec<Signal>,
    /// By property of the spec, whether it is violated.
    pub(crate) never: Vec<Signal>,
}

/// The system of a ladder and a spec, through so many evolutions and scans.
pub(crate) fn system(
    followed: &Followed,
    ready: &Ready<'_>,
    timing: Timing,
    [evolutions, settling]: [usize; 2],
    bounds: &Bounds,
) -> Result<System, Refusal> {
    let spec = ready.spec;
    let mut evolved = chart::follow_ready(ready, Some(followed), evolutions, bounds)?;
    let (mut outputs, mut missing, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    let mut differ = Vec::new();
    for name in evolved.outputs().to_vec() {
        bounds.is_wanted()?;
        let own = followed.output(&name, &mut evolved.netlist);
        let Some(own) = own else {
            missing.push(name);
            continue;
        };
        let other = evolved.value(&name).cloned().unwrap_or(Value::Unknown(0));
        match own.equals(&other, &mut evolved.netlist) {
            Some(equal) => {
                differ.push(!equal);
                outputs.push(name);
            }
            None => numbers.push(name),
        }
    }
    let mut atoms = Atoms::new(followed, &mut evolved);
    spec.environment
        .iter()
        .try_for_each(|rule| atoms.look_up_rule(rule))?;
    spec.never
        .iter()
        .try_for_each(|it| atoms.look_up_property(it))?;
    let atoms = atoms.known();
    let mut frame = Frame::new(&mut evolved, timing, settling, bounds)?;
    let differ = differ.into_iter().map(|signal| frame.of(signal)).collect();
    let mut steps = Steps {
        frame: &mut frame,
        atoms,
    };
    let rules: Vec<Signal> = spec
        .environment
        .iter()
        .map(|rule| steps.rule(rule))
        .collect();
    let never = spec.never.iter().map(|it| steps.property(it)).collect();
    for rule in rules {
        frame.netlist.constrain(rule);
    }
    let mut watched: Vec<Name> = Vec::new();
    for name in spec.never.iter().flat_map(|it| names_of(&it.condition)) {
        let is_shown = outputs.contains(&name) || watched.contains(&name);
        if followed.writes(&name) && !is_shown {
            watched.push(name);
        }
    }
    Ok(System {
        evolved,
        frame,
        outputs,
        missing,
        numbers,
        watched,
        differ,
        never,
    })
}

impl System {
    /// The system with the comparison of outputs as its properties.
    pub(crate) fn comparison(&self) -> Netlist {
        let mut asked = self.frame.netlist.clone();
        asked.never(UNSTABLE, self.frame.unstable);
        asked.never(RESTLESS, self.frame.restless);
        for (name, differ) in self.outputs.iter().zip(&self.differ) {
            asked.never(name.clone(), *differ);
        }
        asked
    }

    /// What is left free and can tell on the outputs that are compared in this
    /// question; nothing where somebody asked to stop.
    pub(crate) fn free(&self, question: &Netlist, cancel: &Cancel) -> Vec<Source> {
        let outputs: Vec<usize> = (NO_OUTPUTS..NO_OUTPUTS + self.outputs.len()).collect();
        let inputs = question.cone(&outputs, cancel).map(|cone| cone.inputs);
        let sources = inputs
            .iter()
            .flatten()
            .filter_map(|at| self.evolved.inputs.sources.get(*at));
        sources.filter(|it| !it.is_given()).cloned().collect()
    }
}
