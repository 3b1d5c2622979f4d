//! Groups of rungs that depend on each other, and whether a group holds a
//! sequence.
//!
//! Most ladder is interlock and device logic: "no sequence here" is an answer,
//! and it comes with its reason.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use logic::{Atom, AtomId, Name};
use petgraph::Direction;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::unionfind::UnionFind;
use rustc_hash::FxHashMap;

use crate::conditions::Conditions;
use crate::registers::Register;
use crate::states::States;
use crate::successions::{Evidence, Succession};

/// Variables that depend on each other, and what they hold.
#[derive(Clone, Debug)]
pub struct Group {
    /// The states in the group, those of registers included, in order.
    pub states: Vec<Name>,
    /// Whether some of them follow each other.
    pub sequence: bool,
    /// Why, in a sentence without a full stop.
    pub reason: String,
    /// Sets of states that replace each other in any order, such as opened and
    /// closed.
    pub modes: Vec<Vec<Name>>,
}

/// The groups that hold at least one state, in the order of their first.
pub fn groups(
    conditions: &Conditions,
    states: &States,
    registers: &[Register],
    successions: &[Succession],
) -> Vec<Group> {
    let mut classes = dependent(conditions, registers);
    // What hands over depends on each other through the plant, if not through
    // a contact.
    for succession in successions {
        let atoms = (states.find(&succession.from), states.find(&succession.to));
        if let (Evidence::Handover, (Some(from), Some(to))) = (succession.evidence, atoms) {
            classes.join(from.atom, to.atom);
        }
    }
    let mut members: BTreeMap<usize, Vec<Name>> = BTreeMap::new();
    for state in &states.states {
        if let Some(class) = classes.class(state.atom) {
            members.entry(class).or_default().push(state.name.clone());
        }
    }
    for (at, register) in registers.iter().enumerate() {
        let class = classes.register_class(at);
        let names = register.states.iter().map(|s| register.state_name(s.value));
        members.entry(class).or_default().extend(names);
    }
    let mut group_of: HashMap<&Name, usize> = HashMap::new();
    for (class, names) in &members {
        group_of.extend(names.iter().map(|name| (name, *class)));
    }
    let mut arcs: BTreeMap<usize, Vec<&Succession>> = BTreeMap::new();
    for succession in successions {
        let certain = matches!(succession.evidence, Evidence::Written | Evidence::Handover);
        if certain && let Some(class) = group_of.get(&succession.from) {
            arcs.entry(*class).or_default().push(succession);
        }
    }
    let mut groups: Vec<Group> = members
        .iter()
        .map(|(class, names)| judged(names, arcs.get(class).map_or(&[], Vec::as_slice)))
        .collect();
    groups.sort_by(|a, b| b.sequence.cmp(&a.sequence).then(a.states.cmp(&b.states)));
    groups
}

/// Why a whole program holds no sequence, or that it does.
pub fn verdict(groups: &[Group]) -> (bool, String) {
    let with: Vec<&Group> = groups.iter().filter(|group| group.sequence).collect();
    if let [only] = &with[..] {
        return (true, only.reason.clone());
    }
    if !with.is_empty() {
        return (
            true,
            format!("{} groups of rungs hold a sequence each", with.len()),
        );
    }
    let reason = match groups {
        [] => "no coil seals in, no variable is both latched and unlatched, and no number counts \
               steps"
            .to_owned(),
        [only] => only.reason.clone(),
        many => {
            let modes: usize = many.iter().map(|group| group.modes.len()).sum();
            let states: usize = many.iter().map(|group| group.states.len()).sum();
            format!(
                "{states} states in {} independent groups of rungs, and in none does what ends \
                 one start another{}",
                many.len(),
                match modes {
                    0 => String::new(),
                    1 => ", but for one set of modes".to_owned(),
                    _ => format!(", but for {modes} sets of modes"),
                }
            )
        }
    };
    (false, reason)
}

/// A group with its judgement: a sequence has at least three states, or a
/// start and an end.
fn judged(names: &[Name], arcs: &[&Succession]) -> Group {
    let place: HashMap<&Name, NodeIndex> = names
        .iter()
        .enumerate()
        .map(|(at, name)| (name, NodeIndex::new(at)))
        .collect();
    let mut graph: DiGraph<(), ()> = DiGraph::new();
    for _ in names {
        graph.add_node(());
    }
    for arc in arcs {
        if let (Some(from), Some(to)) = (place.get(&arc.from), place.get(&arc.to)) {
            graph.update_edge(*from, *to, ());
        }
    }
    let modes: Vec<Vec<Name>> = mode_sets(&graph)
        .into_iter()
        .map(|set| {
            set.into_iter()
                .map(|at| names[at.index()].clone())
                .collect()
        })
        .collect();
    let in_modes: BTreeSet<&Name> = modes.iter().flatten().collect();
    let in_sequence = arcs
        .iter()
        .flat_map(|arc| [&arc.from, &arc.to])
        .filter(|name| !in_modes.contains(name))
        .collect::<BTreeSet<_>>()
        .len();
    let reason = if in_sequence > 0 {
        format!("{in_sequence} states hand over to each other")
    } else if !modes.is_empty() {
        let sets: Vec<String> = modes.iter().map(|set| set.join(", ")).collect();
        format!(
            "only modes that replace each other in any order: {}",
            sets.join("; ")
        )
    } else if let [only] = names {
        format!("a single state, {only}: nothing follows it")
    } else {
        format!(
            "{} states, and in none does what ends one start another",
            names.len()
        )
    };
    Group {
        states: names.to_vec(),
        sequence: in_sequence > 0,
        reason,
        modes,
    }
}

/// Sets of modes: states each of which hands over to every other of the set
/// and to nothing else, as opened and closed of a valve do, or the positions
/// of a selector. They follow each other in any order, so no sequence is in
/// them. States that take part in the same way, such as a command and the lamp
/// beside it, count as one.
fn mode_sets(graph: &DiGraph<(), ()>) -> Vec<Vec<NodeIndex>> {
    let neighbours = |node: NodeIndex, direction: Direction| {
        graph
            .neighbors_directed(node, direction)
            .collect::<BTreeSet<_>>()
    };
    let mut sets = Vec::new();
    for class in kosaraju_scc(graph) {
        let members: BTreeSet<NodeIndex> = class.into_iter().collect();
        let selects_all = members.iter().all(|node| {
            let next = neighbours(*node, Direction::Outgoing);
            let alike: BTreeSet<NodeIndex> = members.difference(&next).copied().collect();
            next.is_subset(&members)
                && next == neighbours(*node, Direction::Incoming)
                && alike
                    .iter()
                    .all(|other| neighbours(*other, Direction::Outgoing) == next)
        });
        if members.len() > 1 && selects_all {
            sets.push(members.into_iter().collect());
        }
    }
    sets.sort();
    sets
}

/// Classes of variables and registers that depend on each other.
struct Classes {
    union: UnionFind<usize>,
    /// The places of the variables, which come before the registers.
    places: FxHashMap<AtomId, usize>,
}

impl Classes {
    fn join(&mut self, a: AtomId, b: AtomId) {
        if let (Some(a), Some(b)) = (self.places.get(&a), self.places.get(&b)) {
            self.union.union(*a, *b);
        }
    }

    fn class(&mut self, atom: AtomId) -> Option<usize> {
        Some(self.union.find_mut(*self.places.get(&atom)?))
    }

    fn register_class(&mut self, register: usize) -> usize {
        self.union.find_mut(self.places.len() + register)
    }
}

/// Joins what a coil writes with the written variables that it reads. Inputs
/// join nothing: a stop button does not make two machines one.
fn dependent(conditions: &Conditions, registers: &[Register]) -> Classes {
    let variables = conditions.variables.len();
    let places = conditions.variables.iter().enumerate();
    let places: FxHashMap<AtomId, usize> = places.map(|(at, it)| (it.atom, at)).collect();
    let mut union = UnionFind::new(variables + registers.len());
    let place: HashMap<&Name, usize> = registers
        .iter()
        .enumerate()
        .map(|(at, register)| (&register.name, at))
        .collect();
    let mut join = |to: usize, atom: AtomId| {
        if let Some(place) = places.get(&atom) {
            union.union(to, *place);
        }
        if let Some(timer) = conditions.timers.get(&atom)
            && let Ok(input) = &timer.input
        {
            for place in input.support().iter().filter_map(|it| places.get(it)) {
                union.union(to, *place);
            }
        }
        if let Atom::Comparison(comparison) = conditions.atoms.atom(atom)
            && let Some(register) = place.get(&comparison.left)
        {
            union.union(to, variables + register);
        }
    };
    for (at, variable) in conditions.variables.iter().enumerate() {
        let Ok(next) = &variable.next else { continue };
        for atom in next.support() {
            join(at, *atom);
        }
    }
    for write in &conditions.register_writes {
        let Some(register) = place.get(&write.target) else {
            continue;
        };
        let Ok(guard) = &write.guard else { continue };
        for atom in guard.support() {
            join(variables + register, *atom);
        }
    }
    Classes { union, places }
}
