//! A ladder program as a transition system.
//!
//! A scan is followed once, in the order of `ladder::flow`, with a signal where
//! the machine has a value: power is a signal, a variable is a [`Value`], an
//! edge's memory a latch. Names, numbers and terms are the machine's own
//! (`ladder::scan::Names`); what is different from the machine is how power and
//! order are followed, and the tests judge that, scan by scan.
//!
//! Which values an integer can have is not known at first. So the program is
//! followed again and again, each time with the values that were found before,
//! until no new one is found: a step register has as many as its rungs name.
//! What counts on without end is not followed; comparisons with it are inputs.

mod boxes;
mod flow;
mod given;
mod knowledge;
mod memory;
mod store;

use std::collections::{BTreeSet, HashMap};

use grafcet::Spec;
use ladder::flow::{Guard, GuardSet, Order, execution};
use ladder::scan::{Kind, Machine, Names, bit_of_word};
use ladder::{ElementKind, Program, Routine};
use logic::{Cancel, Datum, Name};
use petgraph::graph::NodeIndex;
use proof::{Gates, Netlist, Signal};
use source::codes;

use self::flow::{Power, Solved};
use self::given::Given;
use self::knowledge::Knowledge;
use self::memory::Memories;
use self::store::{Held, Store};
use crate::compared;
use crate::inputs::Inputs;
use crate::ranges::Ranges;
use crate::ready::Ready;
use crate::refusal::Refusal;
use crate::value::Value;

/// So often a program is followed to find the values of its numbers.
const MOST_PASSES: usize = 400;

/// A program that has been followed.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Its transition system.
    pub netlist: Netlist,
    /// What its inputs stand for.
    pub inputs: Inputs,
    names: Names,
    held: Held,
    /// What it writes.
    written: BTreeSet<Name>,
    /// What it declares and never looks at holds its initial value.
    untouched: HashMap<Name, Datum>,
    /// What it calls variables by their addresses.
    addresses: HashMap<String, Name>,
}

/// How much may be followed.
#[derive(Clone, Debug)]
pub struct Bounds {
    /// Most nodes of the transition system.
    pub gates: usize,
    /// Most nodes, and cases of numbers that are tried, of all passes together.
    pub work: usize,
    /// Obeyed between two elements of a rung, and between two transitions.
    pub cancel: Cancel,
}

impl Default for Bounds {
    fn default() -> Self {
        Self {
            gates: 4_000_000,
            work: 100_000_000,
            cancel: Cancel::default(),
        }
    }
}

impl Bounds {
    /// Stops if somebody asked to, or if more has been made than is allowed.
    pub(crate) fn look(&self, netlist: &Netlist) -> Result<(), Refusal> {
        self.is_wanted()?;
        match netlist.size() > self.gates {
            true => Err(Refusal::TooLarge),
            false => Ok(()),
        }
    }

    /// Stops if somebody asked to.
    pub(crate) fn is_wanted(&self) -> Result<(), Refusal> {
        match self.cancel.is_cancelled() {
            true => Err(Refusal::Cancelled),
            false => Ok(()),
        }
    }
}

/// Follows a program. Numbers that `spec` compares with constants are told
/// apart as it needs them.
pub fn follow(
    program: &Program,
    spec: Option<&Spec>,
    bounds: &Bounds,
) -> Result<Followed, Refusal> {
    let spec = spec.map(|spec| Ready::new(spec, bounds)).transpose()?;
    follow_beside(program, spec.as_ref(), bounds)
}

/// The same beside a spec whose grafcet is ready.
pub(crate) fn follow_beside(
    program: &Program,
    spec: Option<&Ready<'_>>,
    bounds: &Bounds,
) -> Result<Followed, Refusal> {
    let machine = Machine::try_new(program, || bounds.is_wanted())?;
    let given = Given::of(program, &machine, bounds)?;
    let (orders, first_scan) = (orders(program, &machine)?, machine.first_scan());
    let looks_at_first_scan = reads(program, first_scan);
    let mut knowledge = Knowledge::default();
    let looked_at = spec.map(|it| compared::numbers(it.spec, it.net()));
    for (name, constant) in looked_at.into_iter().flatten() {
        bounds.is_wanted()?;
        let name = machine.names().resolved(&name, &|_| None).into_owned();
        match constant {
            Some(constant) => knowledge.compares(&name.into(), constant, false),
            None => knowledge.computes_with(&name.into(), false),
        }
    }
    let names = spec.map(|it| compared::names(it.spec, it.net()));
    for name in names.into_iter().flatten() {
        bounds.is_wanted()?;
        // Of what both look at, the one may look at bits and the other at the whole.
        let name = machine.names().resolved(&name, &|_| None).into_owned();
        match bit_of_word(&name) {
            Some((word, _)) => knowledge.splits(&word.into(), false),
            None => knowledge.looks_at_whole(&name.into()),
        }
    }
    let mut work = 0;
    for _ in 0..MOST_PASSES {
        let _ = knowledge.take_learnt();
        let store = Store::new(machine.names(), &given, &mut knowledge);
        let mut pass = Pass {
            program,
            store,
            memories: Memories::default(),
            bounds,
        };
        if looks_at_first_scan {
            pass.begin(first_scan)?;
        }
        for order in &orders {
            pass.order(order)?;
        }
        let Pass {
            mut store,
            memories,
            ..
        } = pass;
        memories.end(&mut store);
        store.end(bounds)?;
        work += store.net.size() + store.tried;
        if work > bounds.work {
            return Err(Refusal::TooLarge);
        }
        let (netlist, inputs, held) = store.into_held();
        if !knowledge.take_learnt() {
            return Ok(Followed {
                netlist,
                inputs,
                names: machine.names().clone(),
                held,
                written: knowledge.written.into_keys().collect(),
                untouched: untouched(program, &given),
                addresses: addresses(program),
            });
        }
    }
    Err(Refusal::TooManyValues)
}

fn reads(program: &Program, name: &Name) -> bool {
    program.rungs().any(|(_, rung)| {
        let mut elements = rung.network.elements();
        elements.any(|(_, element)| element.kind.reads().iter().any(|it| it.name == *name))
    })
}

fn addresses(program: &Program) -> HashMap<String, Name> {
    let mut addresses = HashMap::new();
    for declaration in program.declarations.iter() {
        if let Some(address) = &declaration.address {
            let address = address.to_ascii_uppercase();
            addresses
                .entry(address)
                .or_insert_with(|| declaration.name.clone());
        }
    }
    addresses
}

fn untouched(program: &Program, given: &Given) -> HashMap<Name, Datum> {
    let declared = program.declarations.iter().map(|it| &it.name);
    let initial = |name: &Name| given.initial.get(name).copied().unwrap_or_default();
    declared.map(|name| (name.clone(), initial(name))).collect()
}

/// The orders that a scan follows, one after the other.
fn orders(program: &Program, machine: &Machine<'_>) -> Result<Vec<Order>, Refusal> {
    let execution = execution(program);
    let too_many = |it: &source::Diagnostic| {
        it.code == codes::CALL_NOT_FOLLOWED && it.message.contains("unfold into")
    };
    if execution.diagnostics.iter().any(too_many) {
        return Err(Refusal::TooManyVisits);
    }
    if !program.is_only_definitions() {
        return Ok(vec![execution.scan]);
    }
    let orders = execution.definitions;
    let units = orders.iter().map(|(unit, _)| unit);
    let mut in_order = machine
        .roots()
        .iter()
        .map(|at| &program.routines[*at].unit)
        .collect::<Vec<_>>();
    in_order.dedup();
    match units.eq(in_order) {
        true => Ok(orders.into_iter().map(|(_, order)| order).collect()),
        false => Err(Refusal::MixedDefinitions),
    }
}

/// One pass over a program.
struct Pass<'p> {
    program: &'p Program,
    store: Store<'p>,
    memories: Memories,
    bounds: &'p Bounds,
}

impl Pass<'_> {
    /// The first-scan bit.
    fn begin(&mut self, first_scan: &Name) -> Result<(), Refusal> {
        let first = self.store.net.latch("first scan", true);
        self.store.net.set_next(first, Signal::FALSE);
        self.store
            .write(first_scan, &Value::bit(first), Signal::TRUE)
    }

    fn order(&mut self, order: &Order) -> Result<(), Refusal> {
        // By visit: whether it is solved, and the power at its last element.
        let mut solved: Vec<Signal> = Vec::with_capacity(order.visits.len());
        let mut steered: Vec<Signal> = Vec::with_capacity(order.visits.len());
        let mut guarded: HashMap<GuardSet, (Signal, Signal)> =
            HashMap::from([(GuardSet::NONE, (Signal::TRUE, Signal::FALSE))]);
        let mut open: HashMap<(usize, usize), Power> = HashMap::new();
        for visit in &order.visits {
            self.bounds.look(&self.store.net)?;
            let routine = &self.program.routines[visit.routine];
            let past = (solved.as_slice(), steered.as_slice());
            let (when, is_off) = self.guards(visit.guards, routine, order, past, &mut guarded)?;
            let network = &routine.rungs[visit.rung].network;
            let place = (visit.routine, visit.rung);
            let mut power = match visit.elements.start {
                0 => Power::new(network),
                _ => open.remove(&place).unwrap_or_else(|| Power::new(network)),
            };
            let solving = Solved {
                routine: visit.routine,
                rung: visit.rung,
                when,
                is_off,
            };
            for at in visit.elements.clone().map(NodeIndex::new) {
                self.bounds.look(&self.store.net)?;
                let (store, memories) = (&mut self.store, &mut self.memories);
                flow::solve(network, at, solving, &mut power, store, memories)?;
            }
            solved.push(when);
            let last = NodeIndex::new(visit.elements.end.saturating_sub(1));
            steered.push(power.at(last));
            if visit.elements.end < network.len() {
                open.insert(place, power);
            }
        }
        Ok(())
    }

    /// Whether visits with these guards are solved, and whether their zone is
    /// switched off.
    fn guards(
        &mut self,
        set: GuardSet,
        routine: &Routine,
        order: &Order,
        (solved, steered): (&[Signal], &[Signal]),
        known: &mut HashMap<GuardSet, (Signal, Signal)>,
    ) -> Result<(Signal, Signal), Refusal> {
        let mut unknown = Vec::new();
        let mut at = set;
        let (mut when, mut is_off) = loop {
            if let Some(known) = known.get(&at) {
                break *known;
            }
            let Some((guard, outer)) = order.last_guard(at) else {
                break (Signal::TRUE, Signal::FALSE);
            };
            unknown.push((at, guard));
            at = outer;
        };
        let net = &mut self.store.net;
        for (set, guard) in unknown.into_iter().rev() {
            match guard {
                Guard::Skipped { by, solved_when } => {
                    let power = steered[by.visit];
                    when = net.and(when, if solved_when { power } else { !power });
                }
                Guard::Zone { begin } => {
                    let off = net.and(solved[begin.visit], !steered[begin.visit]);
                    is_off = net.or(is_off, off);
                }
                Guard::Repeated { rung, jump } => {
                    return Err(backward(routine, rung, jump));
                }
            }
            known.insert(set, (when, is_off));
        }
        Ok((when, is_off))
    }
}

fn backward(routine: &Routine, rung: usize, jump: NodeIndex) -> Refusal {
    let label = routine
        .rungs
        .get(rung)
        .and_then(|rung| match &rung.network.element(jump).kind {
            ElementKind::Jump(label) => Some(label.name.clone()),
            _ => None,
        });
    Refusal::BackwardJump(label.unwrap_or_else(|| routine.name.clone()))
}

/// The first number of bits of unknown words. A text that names such a bit depends
/// on its word, by whose number the ladder's texts are known.
const BITS: usize = 1 << 50;

fn bit_of_unknown(word: usize, bit: u32) -> usize {
    BITS | word << 6 | bit as usize & 63
}

fn word_of_unknown(number: usize) -> usize {
    match number {
        BITS.. => (number ^ BITS) >> 6,
        _ => number,
    }
}

impl Followed {
    /// The name that the ladder knows a variable by, which is called by its
    /// name or address.
    pub(crate) fn resolved(&self, name: &str) -> Name {
        let own = self.names.resolved(name, &|_| None);
        if self.held.values.contains_key(&*own) {
            return (*own).into();
        }
        match self.addresses.get(&name.to_ascii_uppercase()) {
            Some(name) => (*self.names.resolved(name, &|_| None)).into(),
            None => (*own).into(),
        }
    }

    /// The values that a variable can have when a scan has ended, and when. None
    /// if the ladder never looks at it, or if it is not followed.
    pub fn cases(&self, name: &str) -> &[(Datum, Signal)] {
        self.value(name).map_or(&[], Value::cases)
    }

    /// The bits of a whole number that is followed by its bits, from the lowest to
    /// the sign, when a scan has ended. None of all else.
    pub fn bits(&self, name: &str) -> &[Signal] {
        self.value(name).map_or(&[], Value::bits)
    }

    /// The variables that are followed or free, by name.
    pub fn variables(&self) -> impl Iterator<Item = &Name> {
        self.held.values.keys()
    }

    /// What a variable holds when the scan has ended, called by name or address.
    /// `None` if the ladder never looks at it.
    fn value(&self, name: &str) -> Option<&Value> {
        self.held.values.get(&self.resolved(name))
    }

    /// The same of a bit of a word that is looked at as a whole.
    fn bit(&self, name: &str) -> Option<(&Value, u32)> {
        let name = self.resolved(name);
        let (word, bit) = bit_of_word(&name)?;
        Some((self.held.values.get(word)?, bit))
    }

    /// Whether the ladder mentions or declares a variable.
    pub(crate) fn knows(&self, name: &str) -> bool {
        self.looks_at(name) || self.untouched.contains_key(&self.resolved(name))
    }

    /// Whether the ladder mentions a variable.
    pub(crate) fn looks_at(&self, name: &str) -> bool {
        self.value(name).is_some() || self.bit(name).is_some()
    }

    /// What an output holds when the scan has ended, bits of words and what the
    /// ladder declares and never looks at included.
    pub(crate) fn output(&self, name: &str, net: &mut Netlist) -> Option<Value> {
        if let Some(value) = self.value(name) {
            return Some(value.clone());
        }
        if let Some((word, bit)) = self.bit(name) {
            return Some(match (word.rounded(net), word) {
                (Some(word), _) => Value::bit(word.bit(bit)),
                (None, Value::Unknown(word)) => Value::Unknown(bit_of_unknown(*word, bit)),
                (None, _) => Value::Unknown(0),
            });
        }
        let value = self.untouched.get(&self.resolved(name))?;
        Some(Value::constant(*value))
    }

    /// Whether the ladder writes the variable.
    pub fn writes(&self, name: &str) -> bool {
        self.written.contains(&self.resolved(name))
    }

    /// What stands for a text that depends on these unknown numbers.
    pub(crate) fn free(&self, text: &str, unknowns: &[usize]) -> Option<Signal> {
        let of_ladder = unknowns.iter().map(|it| word_of_unknown(*it));
        let key = (text.to_owned(), of_ladder.collect());
        self.held.frees.get(&key).copied()
    }

    /// The ranges of numbers from the plant that are not followed.
    pub(crate) fn ranges(&self) -> &Ranges {
        &self.held.ranges
    }

    /// The declared type of a variable.
    pub(crate) fn kind(&self, name: &str) -> Option<Kind> {
        self.names.kind(&self.resolved(name))
    }
}
