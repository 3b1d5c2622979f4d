//! Judges the powers of one network: every function against
//! [`ladder::scan::power`] under the same valuation.
//!
//! The two name the memory of an edge differently. Conditions have the atom
//! `rise(e)`, conjoined with the power `e`; the interpreter asks for a bit that
//! remembers the power of the last scan. So a valuation gives values to the
//! atoms of the conditions, and the bit of a rising edge is off exactly where
//! `rise(e)` is on, that of a falling edge on exactly where `fall(e)` is.

use std::collections::{BTreeMap, HashSet};

use ladder::scan::{memory_atom, pin_atom, power, wire_memory_atom};
use ladder::{Edge, ElementKind, Network, Port};
use logic::{Atom, AtomId, Atoms, Budget, Function, Name, Stop};
use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;
use recovery::conditions::{Powers, Walk, powers};

/// Networks with at most this many atoms are judged under every valuation.
const EXHAUSTIVE: usize = 10;

/// What judging came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Networks judged.
    pub networks: usize,
    /// Networks judged under every valuation there is.
    pub exhaustively: usize,
    /// Valuations under which all elements agreed.
    pub valuations: usize,
    /// Valuations that give one bit two values: an edge remembers in a bit
    /// that is looked at elsewhere on the rung.
    pub contradictory: usize,
    /// Elements whose function is past the budget.
    pub too_large: usize,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.networks += other.networks;
        self.exhaustively += other.exhaustively;
        self.valuations += other.valuations;
        self.contradictory += other.contradictory;
        self.too_large += other.too_large;
    }
}

/// A bit that an edge compares with, and the atom that says the edge.
struct Memory {
    bit: Name,
    edge: Edge,
    atom: AtomId,
}

/// A network with its powers as conditions have them.
struct Judged<'n> {
    network: &'n Network,
    atoms: Atoms,
    powers: Powers,
    memories: Vec<Memory>,
}

/// Compares power at and behind every element of `network`: under every
/// valuation where there are few atoms, else under `samples` pseudo-random
/// ones.
///
/// # Panics
///
/// If they differ anywhere, or an atom of one is unknown to the other.
pub fn judge(network: &Network, samples: usize, budget: &Budget) -> Tally {
    let judged = Judged::new(network, budget);
    let count = judged.atoms.len();
    let mut tally = Tally {
        networks: 1,
        too_large: judged.too_large(),
        ..Tally::default()
    };
    let mut values = vec![false; count];
    if count <= EXHAUSTIVE {
        tally.exhaustively = 1;
        for number in 0..1_u32 << count {
            for (bit, value) in values.iter_mut().enumerate() {
                *value = number >> bit & 1 == 1;
            }
            judged.compare(&values, &mut tally);
        }
        return tally;
    }
    let mut random = Random(count as u64);
    for _ in 0..samples {
        values.fill_with(|| random.bit());
        judged.compare(&values, &mut tally);
    }
    tally
}

impl<'n> Judged<'n> {
    fn new(network: &'n Network, budget: &Budget) -> Self {
        let mut atoms = Atoms::new();
        let mut opaque = HashSet::new();
        let mut walk = Walk {
            atoms: &mut atoms,
            opaque: &mut opaque,
            budget,
        };
        let powers = powers(network, &mut walk);
        let memories = memories(network, &powers, &atoms, budget);
        Self {
            network,
            atoms,
            powers,
            memories,
        }
    }

    fn functions(&self, at: NodeIndex) -> [(&'static str, Result<&Function, Stop>); 2] {
        [
            ("at", self.powers.at(at)),
            ("behind", self.powers.after(at)),
        ]
    }

    fn too_large(&self) -> usize {
        let elements = self.network.elements();
        elements
            .filter(|(at, _)| self.functions(*at).iter().any(|(_, it)| it.is_err()))
            .count()
    }

    /// Compares under one valuation, if the interpreter can have it.
    fn compare(&self, values: &[bool], tally: &mut Tally) {
        let Some(bits) = self.bits(values) else {
            tally.contradictory += 1;
            return;
        };
        let seen = power(self.network, |atom| self.value(atom, &bits, values));
        for (at, element) in self.network.elements() {
            let interpreted = [seen.at(at), seen.after(at)];
            for ((place, function), interpreted) in self.functions(at).iter().zip(interpreted) {
                let Ok(function) = function else { continue };
                let computed = function.evaluate(|atom| values[self.atoms.place(atom)]);
                assert_eq!(
                    computed,
                    interpreted,
                    "power {place} element {at:?}, {element:?}, is {} where {}",
                    said(function, &self.atoms),
                    self.shown(values)
                );
            }
        }
        tally.valuations += 1;
    }

    /// The bits that edges remember in, unless one would need two values.
    fn bits(&self, values: &[bool]) -> Option<BTreeMap<&Name, bool>> {
        let mut bits = BTreeMap::new();
        for memory in &self.memories {
            let says = values[self.atoms.place(memory.atom)];
            let bit = match memory.edge {
                Edge::Rising => !says,
                Edge::Falling => says,
            };
            let elsewhere = self.atoms.find_variable(&memory.bit);
            let looked_at = elsewhere.is_none_or(|atom| values[self.atoms.place(atom)] == bit);
            if !looked_at || *bits.entry(&memory.bit).or_insert(bit) != bit {
                return None;
            }
        }
        Some(bits)
    }

    fn value(&self, atom: &Atom, bits: &BTreeMap<&Name, bool>, values: &[bool]) -> bool {
        if let Some(id) = self.atoms.find(atom) {
            return values[self.atoms.place(id)];
        }
        let Atom::Variable(name) = atom else {
            panic!("the conditions do not know {atom}");
        };
        match (bits.get(name), &*name.to_ascii_lowercase()) {
            (Some(bit), _) => *bit,
            (None, "1" | "true") => true,
            (None, "0" | "false") => false,
            (None, _) => panic!("the conditions do not know {name}"),
        }
    }

    fn shown(&self, values: &[bool]) -> String {
        let literals: Vec<String> = self
            .atoms
            .iter()
            .map(|(id, atom)| {
                format!(
                    "{}{atom}",
                    if values[self.atoms.place(id)] {
                        ""
                    } else {
                        "/"
                    }
                )
            })
            .collect();
        literals.join(" ")
    }
}

/// The memories of a network: of one shots, and of edge pins at the ends of
/// wires.
fn memories(network: &Network, powers: &Powers, atoms: &Atoms, budget: &Budget) -> Vec<Memory> {
    let one_shots = network.elements().filter_map(|(at, element)| {
        let ElementKind::OneShot(shot) = &element.kind else {
            return None;
        };
        let power = powers.at(at).ok()?.clone();
        Some((memory_atom(network, at), shot.edge, power))
    });
    let pins = network.graph().edge_references().filter_map(|wire| {
        let edge = wire.weight().edge?;
        let source = match &wire.weight().from {
            Port::Power => powers.after(wire.source()).ok()?.clone(),
            Port::Pin(pin) => {
                let name = pin_atom(network, wire.source(), pin);
                Function::atom(atoms.find_variable(&name)?)
            }
        };
        let signal = if wire.weight().negated {
            source.not()
        } else {
            source
        };
        Some((wire_memory_atom(network, wire.id()), edge, signal))
    });
    one_shots
        .chain(pins)
        .filter_map(|(bit, edge, power)| {
            let power = Box::new(power.to_expr(atoms, budget).ok()?);
            let atom = match edge {
                Edge::Rising => Atom::Rise(power),
                Edge::Falling => Atom::Fall(power),
            };
            let atom = atoms.find(&atom).expect("every edge is an atom");
            Some(Memory { bit, edge, atom })
        })
        .collect()
}

fn said(function: &Function, atoms: &Atoms) -> String {
    match function.to_expr(atoms, &Budget::default()) {
        Ok(expr) => expr.to_string(),
        Err(_) => "too long to say".to_owned(),
    }
}

/// Numbers that look random and are the same in every run (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn number(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    /// The next bit.
    pub fn bit(&mut self) -> bool {
        self.number() & 1 == 1
    }
}
