//! The two that run, each behind the names of the scenario.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use grafcet::Grafcet;
use grafcet::evolution::{self, Unstable};
use ladder::scan;
use ladder::{Class, ElementKind, Program, Role};
use logic::notation::quoted;
use logic::{Datum, Name};

/// The names of a ladder.
#[derive(Debug)]
pub(super) struct Names<'p> {
    known: HashSet<&'p str>,
    by_address: HashMap<String, &'p Name>,
    /// What is shown of it.
    pub(super) outputs: Vec<Name>,
}

impl<'p> Names<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        let mut known = HashSet::new();
        let mut by_address = HashMap::new();
        for declaration in program.declarations.iter() {
            known.insert(&*declaration.name);
            if let Some(address) = &declaration.address {
                let address = address.to_ascii_uppercase();
                by_address.entry(address).or_insert(&declaration.name);
            }
        }
        let mut written: Vec<&Name> = Vec::new();
        let is_all = program.is_only_definitions();
        for (routine, rung) in program.rungs() {
            for (_, element) in rung.network.elements() {
                let reads = element.kind.reads().into_iter();
                let writes = element.kind.writes();
                known.extend(reads.chain(writes.clone()).map(|operand| &*operand.name));
                let shows = matches!(element.kind, ElementKind::Coil(_) | ElementKind::Assign(_));
                if shows && (is_all || routine.role != Role::Definition) {
                    written.extend(writes.into_iter().map(|operand| &operand.name));
                }
            }
        }
        let mut seen = HashSet::new();
        written.retain(|name| seen.insert(*name));
        let places: HashMap<&Name, usize> = program
            .declarations
            .iter()
            .enumerate()
            .map(|(at, declaration)| (&declaration.name, at))
            .collect();
        written.sort_by_key(|name| places.get(name).copied().unwrap_or(usize::MAX));
        if written.iter().any(|name| goes_to_plant(program, name)) {
            written.retain(|name| goes_to_plant(program, name));
        }
        Self {
            known,
            by_address,
            outputs: written.into_iter().cloned().collect(),
        }
    }

    /// What the ladder calls a variable that is called by name or address.
    pub(super) fn resolved<'n>(&'n self, name: &'n str) -> &'n str {
        if self.known.contains(name) {
            return name;
        }
        let addressed = self.by_address.get(&name.to_ascii_uppercase());
        addressed.map_or(name, |name| name)
    }

    /// Whether the ladder mentions the variable, or one that this is a member
    /// or bit of.
    pub(super) fn knows(&self, name: &str) -> bool {
        let name = self.resolved(name);
        let mut whole = Some(name);
        while let Some(part) = whole {
            if self.known.contains(part) {
                return true;
            }
            whole = part.rfind(['.', '[']).and_then(|at| part.get(..at));
        }
        false
    }
}

fn goes_to_plant(program: &Program, name: &Name) -> bool {
    let outside = |address: &str| {
        address.starts_with("%Q") || address.contains(":O.") || address.contains(":O:")
    };
    let declared = program.declarations.find(name);
    outside(name)
        || declared.is_some_and(|it| {
            it.class == Class::Output || it.address.as_deref().is_some_and(outside)
        })
}

/// A ladder that runs.
#[derive(Clone, Debug)]
pub(super) struct Ladder<'p> {
    pub(super) names: Arc<Names<'p>>,
    machine: scan::Machine<'p>,
}

/// The power in each rung that a scan solved, by routine and rung.
pub(super) type Powers = HashMap<(usize, usize), scan::Power>;

impl<'p> Ladder<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        Self {
            names: Arc::new(Names::new(program)),
            machine: scan::Machine::new(program),
        }
    }

    pub(super) fn set_input(&mut self, name: &str, value: Datum) {
        self.machine.set_input(self.names.resolved(name), value);
    }

    pub(super) fn scan(&mut self, elapsed_ms: u64) {
        self.machine.scan(elapsed_ms);
    }

    /// The same, and what power was in its rungs.
    pub(super) fn scan_for_powers(&mut self, elapsed_ms: u64) -> Powers {
        let mut powers = Powers::new();
        self.machine
            .scan_observed(elapsed_ms, &mut |routine, rung, power| {
                powers.insert((routine, rung), power.clone());
            });
        powers
    }

    /// The value of a variable that the ladder knows, or of a term.
    pub(super) fn value(&self, name: &str) -> Option<Datum> {
        let is_term = name.contains(['+', '-', '*', '/', '(']) && quoted(name) != name;
        if self.names.knows(name) {
            Some(self.machine.value(self.names.resolved(name)))
        } else {
            is_term.then(|| self.machine.compute(name)).flatten()
        }
    }

    /// The value of a variable by the name that the ladder itself has for it.
    pub(super) fn shown(&self, name: &str) -> Datum {
        self.machine.value(name)
    }

    pub(super) fn is_as_in(&self, other: &Self) -> bool {
        self.machine.is_as_in(&other.machine)
    }
}

/// A grafcet that runs.
#[derive(Clone, Debug)]
pub(super) struct Spec {
    pub(super) machine: evolution::Machine,
    /// What it reads and does not write.
    free: Vec<Name>,
}

impl Spec {
    pub(super) fn new(grafcet: &Grafcet) -> Self {
        let machine = evolution::Machine::new(grafcet);
        let free = machine.free().cloned().collect();
        Self { machine, free }
    }

    /// A scan, after that of the ladder beside it.
    pub(super) fn scan(
        &mut self,
        elapsed_ms: u64,
        ladder: Option<&Ladder<'_>>,
    ) -> Result<(), Unstable> {
        if let Some(ladder) = ladder {
            for name in &self.free {
                if let Some(value) = ladder.value(name) {
                    self.machine.set_input(name, value);
                }
            }
        }
        self.machine.scan(elapsed_ms)
    }
}
