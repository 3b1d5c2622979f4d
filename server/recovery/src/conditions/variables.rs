use std::sync::Arc;

use imbl::OrdMap;
use logic::AtomId;

use super::Variable;

/// Variables that a coil writes, in the order of their atoms.
///
/// Clones share what they hold, and when one of them is changed, all that did
/// not change.
#[derive(Clone, Debug, Default)]
pub struct Variables(OrdMap<AtomId, Arc<Variable>>);

impl Variables {
    /// All of them, in the order of their atoms.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Arc<Variable>> {
        self.0.values()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The variable that `atom` is.
    pub(super) fn get(&self, atom: AtomId) -> Option<&Arc<Variable>> {
        self.0.get(&atom)
    }

    /// Lets a variable be this one, or none.
    pub(super) fn put(&mut self, atom: AtomId, variable: Option<Arc<Variable>>) {
        match variable {
            Some(variable) => self.0.insert(atom, variable),
            None => self.0.remove(&atom),
        };
    }
}

impl FromIterator<Arc<Variable>> for Variables {
    fn from_iter<I: IntoIterator<Item = Arc<Variable>>>(variables: I) -> Self {
        Self(variables.into_iter().map(|it| (it.atom, it)).collect())
    }
}

impl<'v> IntoIterator for &'v Variables {
    type Item = &'v Arc<Variable>;
    type IntoIter =
        imbl::ordmap::Values<'v, AtomId, Arc<Variable>, imbl::shared_ptr::DefaultSharedPtr>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.values()
    }
}
