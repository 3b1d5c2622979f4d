use std::collections::HashMap;

use crate::{Atom, Name};

/// Identifies an atom in its [`Atoms`] table. The order of the numbers is the
/// order of the variables in every diagram and every printed product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct AtomId(pub u32);

/// All atoms of a program or a spec, in the order of their diagrams.
///
/// Atoms get their place when they are first added, so add them in the order
/// wanted: for a ladder, coils by address, then inputs by address, the order
/// that the paper's Table 5 is printed in.
#[derive(Clone, Debug, Default)]
pub struct Atoms {
    atoms: Vec<Atom>,
    places: HashMap<Atom, AtomId>,
}

impl Atoms {
    /// An empty table.
    pub fn new() -> Self {
        Self::default()
    }

    /// The place of `atom`, added at the end if it is new.
    pub fn add(&mut self, atom: Atom) -> AtomId {
        if let Some(&id) = self.places.get(&atom) {
            return id;
        }
        let id = AtomId(self.atoms.len() as u32);
        self.atoms.push(atom.clone());
        self.places.insert(atom, id);
        id
    }

    /// The place of the variable called `name`, added if it is new.
    pub fn add_variable(&mut self, name: &Name) -> AtomId {
        self.add(Atom::Variable(name.clone()))
    }

    /// The place of `atom`, if it is in the table.
    pub fn find(&self, atom: &Atom) -> Option<AtomId> {
        self.places.get(atom).copied()
    }

    /// The place of the variable called `name`, if it is in the table.
    pub fn find_variable(&self, name: &Name) -> Option<AtomId> {
        self.find(&Atom::Variable(name.clone()))
    }

    /// The atom at a place of this table.
    pub fn atom(&self, id: AtomId) -> &Atom {
        &self.atoms[id.0 as usize]
    }

    /// All atoms with their places, in order.
    pub fn iter(&self) -> impl Iterator<Item = (AtomId, &Atom)> {
        self.atoms
            .iter()
            .enumerate()
            .map(|(at, atom)| (AtomId(at as u32), atom))
    }

    /// Number of atoms.
    pub fn len(&self) -> usize {
        self.atoms.len()
    }

    /// Whether the table is empty.
    pub fn is_empty(&self) -> bool {
        self.atoms.is_empty()
    }
}
