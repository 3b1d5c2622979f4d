//! A grafcet as a transition system.
//!
//! The grafcet is the machine's own (`grafcet::evolution::Net`), with numbers in
//! place of names; a scan is followed by the rules of `docs/evolution.md`, with a
//! signal where the machine has a value. How many evolutions a scan takes is not
//! known at first: so many are followed as are asked for, and a signal says
//! whether one more would still change the situation. As long as that can
//! happen, somebody must ask for more, or see that it never ends.
//!
//! What no action writes and is declared as no output, and its ladder knows, it
//! reads from the ladder, after the ladder's scan. All else of that kind is an
//! input.

mod evolution;
mod hierarchy;
mod reading;
mod state;
mod storing;

use std::collections::BTreeMap;

use grafcet::Spec;
use grafcet::evolution::Net;
use logic::{Datum, Name};
use proof::{Netlist, Signal};

use self::state::State;
use crate::compared;
use crate::domain::Domain;
use crate::inputs::Inputs;
use crate::program::{Bounds, Followed};
use crate::ranges::Ranges;
use crate::ready::Ready;
use crate::refusal::Refusal;
use crate::value::Value;

/// So often a grafcet is followed to find the values of its variables.
const MOST_PASSES: usize = 400;

/// A grafcet that has been followed, and the ladder beside it.
#[derive(Clone, Debug)]
pub struct Evolved {
    /// The transition system of both.
    pub netlist: Netlist,
    /// What its inputs stand for.
    pub inputs: Inputs,
    /// By step, in the order in which they are declared: its name, and whether
    /// it is active in the stable situation.
    pub active: Vec<(Name, Signal)>,
    /// Whether one more evolution would still change the situation.
    pub unstable: Signal,
    outputs: Vec<Name>,
    names: BTreeMap<Name, usize>,
    values: Vec<Value>,
}

/// The values that each variable can have when a scan begins.
type Domains = Vec<Domain>;

/// Follows the grafcet of a spec, beside a ladder if there is one, through so
/// many evolutions a scan.
pub fn follow(
    spec: &Spec,
    ladder: Option<&Followed>,
    evolutions: usize,
    bounds: &Bounds,
) -> Result<Evolved, Refusal> {
    follow_ready(&Ready::new(spec, bounds)?, ladder, evolutions, bounds)
}

/// The same of a grafcet that is ready.
pub(crate) fn follow_ready(
    ready: &Ready<'_>,
    ladder: Option<&Followed>,
    evolutions: usize,
    bounds: &Bounds,
) -> Result<Evolved, Refusal> {
    bounds.is_wanted()?;
    let (spec, start, net) = (ready.spec, &ready.machine, ready.net());
    let initial: Vec<bool> = net
        .steps
        .iter()
        .map(|step| start.is_active(&step.name))
        .collect();
    let mut numbers: BTreeMap<Name, Vec<Option<Datum>>> = BTreeMap::new();
    for (name, constant) in compared::numbers(spec, net) {
        numbers.entry(name).or_default().push(constant);
    }
    let mut domains: Domains = vec![Domain::Values(vec![Datum::default()]); net.variables.len()];
    for _ in 0..MOST_PASSES {
        bounds.is_wanted()?;
        let mut pass = Pass {
            net,
            ladder,
            netlist: ladder.map_or_else(Netlist::default, |it| it.netlist.clone()),
            inputs: ladder.map_or_else(Inputs::default, |it| it.inputs.clone()),
            edges: vec![Signal::FALSE; net.edges.len()],
            elapsed: BTreeMap::new(),
            numbers: &numbers,
            ranges: ladder.map_or_else(Ranges::default, |it| it.ranges().clone()),
            unknowns: FIRST_UNKNOWN,
            bounds,
        };
        let (mut state, latches) = pass.begin(&initial, &domains)?;
        let unstable = pass.scan(&mut state, &latches, evolutions)?;
        pass.look()?;
        pass.end(&state, &latches);
        pass.look()?;
        if !learn(&mut domains, &state, net) {
            return Ok(Evolved {
                netlist: pass.netlist,
                inputs: pass.inputs,
                active: net
                    .steps
                    .iter()
                    .map(|step| step.name.clone())
                    .zip(state.active)
                    .collect(),
                unstable,
                outputs: net
                    .outputs
                    .iter()
                    .map(|at| net.variables[*at].clone())
                    .collect(),
                names: net.variables.iter().cloned().zip(0..).collect(),
                values: state.values,
            });
        }
    }
    Err(Refusal::TooManyValues)
}

/// The numbers of unknowns that a ladder beside does not use.
const FIRST_UNKNOWN: usize = 1 << 40;

/// Adds the values that variables have at the end of a scan. Whether any is
/// new.
fn learn(domains: &mut Domains, state: &State, net: &Net) -> bool {
    let mut has_learnt = false;
    for (at, domain) in domains.iter_mut().enumerate() {
        if !net.is_own[at] || *domain == Domain::Unknown {
            continue;
        }
        let before = domain.clone();
        match &state.values[at] {
            Value::Known(cases) => {
                for (value, _) in cases {
                    domain.add(*value);
                }
            }
            Value::Word(word) => domain.widen(word),
            Value::Unknown(_) => *domain = Domain::Unknown,
        }
        has_learnt |= *domain != before;
    }
    has_learnt
}

/// One pass over a grafcet.
struct Pass<'g> {
    net: &'g Net,
    ladder: Option<&'g Followed>,
    netlist: Netlist,
    inputs: Inputs,
    /// The edges that occur at this moment.
    edges: Vec<Signal>,
    /// By step and milliseconds: whether the time has passed, as far as the
    /// step has been active all the time.
    elapsed: BTreeMap<(usize, u64), Signal>,
    /// What numbers are compared with; nothing where their very value counts.
    numbers: &'g BTreeMap<Name, Vec<Option<Datum>>>,
    ranges: Ranges,
    unknowns: usize,
    bounds: &'g Bounds,
}

impl Pass<'_> {
    /// Stops where there is no more time or room.
    fn look(&self) -> Result<(), Refusal> {
        self.bounds.look(&self.netlist)
    }
}

impl Evolved {
    /// The names of what is published, in the order of the text.
    pub fn outputs(&self) -> &[Name] {
        &self.outputs
    }

    /// The values that a variable can have when a scan has ended, and when. None
    /// if there is no such variable, or if it is not followed.
    pub fn cases(&self, name: &str) -> &[(Datum, Signal)] {
        self.value(name).map_or(&[], Value::cases)
    }

    /// The bits of a whole number that is followed by its bits, from the lowest to
    /// the sign, when a scan has ended. None of all else.
    pub fn bits(&self, name: &str) -> &[Signal] {
        self.value(name).map_or(&[], Value::bits)
    }

    /// What a variable holds when a scan has ended.
    pub(crate) fn value(&self, name: &str) -> Option<&Value> {
        self.values.get(*self.names.get(name)?)
    }
}
