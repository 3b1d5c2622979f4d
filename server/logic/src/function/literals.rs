//! By which literals a function depends on its atoms.

use std::collections::HashSet;

use biodivine_lib_bdd::{Bdd, BddPointer};

use super::{Function, Literal};

impl Function {
    /// The literals by which the function depends on its atoms, in ascending
    /// order of these: the complement of an atom where lowering it can raise
    /// the function, the atom where raising it can.
    ///
    /// A function grows in an atom exactly if at every node that tests it the
    /// low branch implies the high one, so that one look at the nodes tells
    /// about all atoms. What does not hold is soon refuted, so that this takes
    /// little more time than there are nodes; at worst the cube of that.
    pub fn literals(&self) -> Vec<Literal> {
        // Of each atom: whether its complement is a literal, whether itself is.
        let mut found = vec![[false; 2]; self.support().len()];
        let mut implications = Implications::of(self.diagram());
        for node in self.diagram().pointers().skip(2) {
            let [falls, rises] = &mut found[self.diagram().var_of(node).to_index()];
            let low = self.diagram().low_link_of(node);
            let high = self.diagram().high_link_of(node);
            *falls = *falls || !implications.hold(low, high);
            *rises = *rises || !implications.hold(high, low);
        }
        let literals = self.support().iter().zip(found).flat_map(|(atom, found)| {
            let of_atom = [false, true].map(|positive| Literal {
                atom: *atom,
                positive,
            });
            of_atom.into_iter().zip(found)
        });
        literals
            .filter_map(|(literal, is_found)| is_found.then_some(literal))
            .collect()
    }
}

/// Implications between the nodes of one diagram.
struct Implications<'d> {
    diagram: &'d Bdd,
    /// Pairs of which the first is known to imply the second.
    known: HashSet<[BddPointer; 2]>,
}

impl<'d> Implications<'d> {
    fn of(diagram: &'d Bdd) -> Self {
        Self {
            diagram,
            known: HashSet::new(),
        }
    }

    /// Whether `first` implies `second`: whether no way through both, taken
    /// side by side, leads the first to 1 and the second to 0.
    fn hold(&mut self, first: BddPointer, second: BddPointer) -> bool {
        let mut seen = Vec::new();
        let mut open = vec![[first, second]];
        while let Some(pair) = open.pop() {
            let [first, second] = pair;
            if first == second || first.is_zero() || second.is_one() {
                continue;
            }
            if first.is_one() || second.is_zero() {
                // What was seen on the way may be wrong as well.
                for pair in seen {
                    self.known.remove(&pair);
                }
                return false;
            }
            if self.known.insert(pair) {
                seen.push(pair);
                let (low, high) = self.below(pair);
                open.extend([low, high]);
            }
        }
        true
    }

    /// Where a pair leads when the first atom that any of the two tests is 0,
    /// and when it is 1.
    fn below(&self, pair: [BddPointer; 2]) -> ([BddPointer; 2], [BddPointer; 2]) {
        let tested = pair.map(|node| self.diagram.var_of(node));
        let atom = tested[0].min(tested[1]);
        let step = |link: fn(&Bdd, BddPointer) -> BddPointer| {
            pair.map(|node| match self.diagram.var_of(node) == atom {
                true => link(self.diagram, node),
                false => node,
            })
        };
        (step(Bdd::low_link_of), step(Bdd::high_link_of))
    }
}
