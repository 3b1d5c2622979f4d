use std::collections::HashMap;
use std::convert::Infallible;
use std::sync::Arc;

use logic::{Datum, Name};

use super::compile::compile;
use super::firing::{self, Fired};
use super::net::{Net, State};
use super::{Unstable, hierarchy, publishing, storing};
use crate::Grafcet;

/// So many evolutions of one scan, and one more for each step, are taken for
/// the way to a stable situation: a stored action may count on in a loop that
/// ends.
const MOST_EVOLUTIONS: usize = 1_000;

/// Only a scan that takes more evolutions than this is watched for a cycle.
const COMMON_EVOLUTIONS: usize = 8;

/// A grafcet that runs: its situation, its variables, its clock.
///
/// Clones share what does not change, so that a search may take many.
///
/// ```
/// use grafcet::evolution::Machine;
///
/// let text = "\
/// Step X0, Xrun
/// Transition t1, t2
/// Input start, stop
/// Output motor
/// Marking X0
/// Transitions:
/// t1: X0*start |- @Xrun
/// t2: Xrun*(stop + 10s/Xrun) |- @X0
/// Steps:
/// Xrun: |- motor
/// ";
/// let mut machine = Machine::new(&grafcet::read(text).spec.grafcet);
/// machine.set_input("start", true);
/// machine.scan(10)?;
/// assert!(machine.is_on("motor"));
/// machine.set_input("start", false);
/// machine.scan(10_000)?;
/// assert!(!machine.is_on("motor"));
/// # Ok::<(), grafcet::evolution::Unstable>(())
/// ```
#[derive(Clone, Debug)]
pub struct Machine {
    net: Arc<Net>,
    state: State,
    now: u64,
    scans: u64,
    evolutions: Vec<Vec<usize>>,
}

/// One evolution of the last scan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evolution<'m> {
    /// The transitions that were cleared, all at once, in the order of the
    /// text. None where only forcing orders changed the situation.
    pub transitions: Vec<&'m Name>,
}

impl Machine {
    /// The grafcet in its initial situation, before its first scan; all
    /// variables are 0.
    pub fn new(grafcet: &Grafcet) -> Self {
        let Ok(machine) = Self::try_new(grafcet, || Ok::<(), Infallible>(()));
        machine
    }

    /// The same, stopped by an error of `look`, which is called again and again
    /// meanwhile.
    pub fn try_new<E>(grafcet: &Grafcet, look: impl FnMut() -> Result<(), E>) -> Result<Self, E> {
        let net = compile(grafcet, look)?;
        let mut state = State {
            active: vec![false; net.steps.len()],
            since: vec![0; net.steps.len()],
            values: vec![Datum::default(); net.variables.len()],
            kept: vec![false; net.variables.len()],
            looked_at: vec![false; net.edges.len()],
            obeyed: vec![None; net.parts.len()],
        };
        hierarchy::begin(&net, &mut state);
        Ok(Self {
            net: Arc::new(net),
            state,
            now: 0,
            scans: 0,
            evolutions: Vec::new(),
        })
    }

    /// What the machine runs.
    pub fn net(&self) -> &Net {
        &self.net
    }

    /// Gives a variable a value between two scans, by its name or address. Any
    /// variable may be given one, not only inputs. Whether there is such a
    /// variable; a step's is not given values.
    pub fn set_input(&mut self, name: &str, value: impl Into<Datum>) -> bool {
        let Some(at) = self.net.variable(name) else {
            return false;
        };
        self.state.values[at] = value.into();
        true
    }

    /// Evolves to the next stable situation, `elapsed_ms` milliseconds after
    /// the last scan, and publishes the outputs.
    ///
    /// On an error there is no stable situation. The machine is then as it was
    /// before the scan, but for the time that has passed.
    pub fn scan(&mut self, elapsed_ms: u64) -> Result<(), Unstable> {
        self.now = self.now.saturating_add(elapsed_ms);
        let before = self.state.clone();
        let edges = self.begin_scan();
        match self.stabilise(&edges) {
            Ok(()) => {
                publishing::publish(&self.net, &mut self.state, self.now);
                self.scans += 1;
                Ok(())
            }
            Err(unstable) => {
                self.state = before;
                self.evolutions.clear();
                Err(unstable)
            }
        }
    }

    /// What happens before anything is cleared: edges are sampled, events
    /// cause their actions, orders begin and end. Gives the edges that occur.
    fn begin_scan(&mut self) -> Vec<bool> {
        let (net, state, now) = (&*self.net, &mut self.state, self.now);
        self.evolutions.clear();
        if self.scans == 0 {
            state.since.fill(now);
        }
        let mut edges = vec![false; net.edges.len()];
        firing::sample(net, state, 0..net.sampled_first, &mut edges, now);
        storing::on_events(net, state, &edges, now);
        // The initial situation is activated by the first scan.
        let active = match self.scans {
            0 => vec![false; state.active.len()],
            _ => state.active.clone(),
        };
        let situation = state.active.clone();
        hierarchy::settle(net, state, &situation, &edges, now);
        let is_forced = state.active != situation;
        firing::tell(net, state, &active, &edges, now);
        if is_forced {
            self.evolutions.push(Vec::new());
        }
        edges
    }

    fn stabilise(&mut self, edges: &[bool]) -> Result<(), Unstable> {
        let net = Arc::clone(&self.net);
        let most = MOST_EVOLUTIONS + net.steps.len();
        let mut passed = Passed::default();
        for nth in 0.. {
            // Edges are true in the first evolution only.
            let edges = if nth == 0 { edges } else { &[] };
            let fired = firing::evolve(&net, &mut self.state, edges, self.now);
            // What changes nothing once will change nothing again.
            let is_stable = match nth {
                0 => fired.transitions.is_empty() && !fired.has_effect,
                _ => !fired.has_effect,
            };
            if is_stable {
                break;
            }
            self.evolutions.push(fired.transitions.clone());
            if nth < COMMON_EVOLUTIONS {
                continue;
            }
            let cycle = passed.add(&self.state, fired);
            if let Some(from) = cycle.or((nth == most).then(|| passed.last_return())) {
                return Err(passed.unstable(&net, from));
            }
        }
        Ok(())
    }

    /// The active steps, in the order they are declared. A macro-step is
    /// active while a step of its expansion is.
    pub fn active(&self) -> impl Iterator<Item = &Name> {
        let steps = self.net.steps.iter().zip(&self.state.active);
        steps.filter_map(|(step, is_active)| is_active.then_some(&step.name))
    }

    /// Whether the step called `name` is active.
    pub fn is_active(&self, name: &str) -> bool {
        let step = self.net.step_names.get(name);
        step.is_some_and(|step| self.state.active[*step])
    }

    /// How many milliseconds the step called `name` has been active, by the last
    /// scan; 0 if it is not.
    pub fn active_ms(&self, name: &str) -> u64 {
        let step = self.net.step_names.get(name);
        let active = step.filter(|step| self.state.active[**step]);
        active.map_or(0, |step| self.now.saturating_sub(self.state.since[*step]))
    }

    /// What is published: the outputs in the order they are declared, then
    /// what actions write that nothing declares.
    pub fn outputs(&self) -> impl Iterator<Item = (&Name, Datum)> {
        let outputs = self.net.outputs.iter();
        outputs.map(|at| (&self.net.variables[*at], self.state.values[*at]))
    }

    /// The variables that are not the grafcet's own: inputs, and whatever else
    /// somebody must give a value, in the order they are declared.
    pub fn free(&self) -> impl Iterator<Item = &Name> {
        let names = self.net.variables.iter().enumerate();
        names
            .filter(|(at, _)| !self.net.is_own[*at])
            .map(|(_, name)| name)
    }

    /// The value of a variable, or of a step's variable; 0 for an unknown
    /// name.
    pub fn value(&self, name: &str) -> Datum {
        match self.net.variable(name) {
            Some(at) => self.state.values[at],
            None => self.is_active(name).into(),
        }
    }

    /// Whether a variable, or a step's variable, is on.
    pub fn is_on(&self, name: &str) -> bool {
        self.value(name).is_on()
    }

    /// Whether `name` is a step's, or a variable's that is the grafcet's own: some
    /// action writes it, or it is declared as an output.
    pub fn decides(&self, name: &str) -> bool {
        let own = self.net.variable(name).map(|at| self.net.is_own[at]);
        own.unwrap_or_else(|| self.net.step_names.contains_key(name))
    }

    /// Whether `name` is a step or variable of the grafcet.
    pub fn knows(&self, name: &str) -> bool {
        self.net.step_names.contains_key(name) || self.net.variable(name).is_some()
    }

    /// Number of scans that found a stable situation.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// How the last scan came to its stable situation, an evolution at a time;
    /// empty if it began in one.
    pub fn evolutions(&self) -> impl Iterator<Item = Evolution<'_>> {
        let name = |at: &usize| &self.net.transitions[*at].name;
        self.evolutions.iter().map(move |fired| Evolution {
            transitions: fired.iter().map(name).collect(),
        })
    }

    /// Whether the situation and all values are as in `other`, an earlier
    /// moment of the same grafcet.
    pub fn is_as_in(&self, other: &Self) -> bool {
        self.state.active == other.state.active && self.state.has_values_of(&other.state)
    }
}

/// What a scan has passed through, to know when it comes back.
#[derive(Default)]
struct Passed {
    trace: Vec<(State, Fired)>,
    /// Where in the trace a state like this was, by its bits.
    places: HashMap<Vec<u64>, usize>,
}

impl Passed {
    /// Notes an evolution and what came of it. If that was there before, the
    /// place in the trace since when.
    fn add(&mut self, state: &State, fired: Fired) -> Option<usize> {
        let at = self.trace.len();
        self.trace.push((state.clone(), fired));
        self.places.insert(state.key(), at)
    }

    /// Where the situation of the last evolution was met last, whatever the
    /// values were.
    fn last_return(&self) -> usize {
        let Some(((last, _), earlier)) = self.trace.split_last() else {
            return 0;
        };
        let met = |(state, _): &(State, Fired)| state.active == last.active;
        earlier.iter().rposition(met).unwrap_or(0)
    }

    fn unstable(&self, net: &Net, from: usize) -> Unstable {
        let name = |at: &usize| net.transitions[*at].name.clone();
        let mut cycle: Vec<&[usize]> = self
            .trace
            .iter()
            .skip(from + 1)
            .map(|(_, fired)| &*fired.transitions)
            .collect();
        // A circle has no beginning: it is told from what comes first in the text.
        let first = (0..cycle.len()).min_by_key(|at| cycle[*at]);
        cycle.rotate_left(first.unwrap_or(0));
        let mut takes_part = vec![false; net.steps.len()];
        let situations = self.trace.get(from..).unwrap_or_default();
        for pair in situations.windows(2) {
            let [(before, _), (after, _)] = pair else {
                continue;
            };
            for (at, changes) in takes_part.iter_mut().enumerate() {
                *changes |= before.active[at] != after.active[at];
            }
        }
        let steps = net.steps.iter().zip(takes_part);
        Unstable {
            cycle: cycle
                .iter()
                .map(|fired| fired.iter().map(name).collect())
                .collect(),
            steps: steps
                .filter(|(_, changes)| *changes)
                .map(|(step, _)| step.name.clone())
                .collect(),
        }
    }
}
