//! The nodes of a function's diagram, for those who build it elsewhere.

use biodivine_lib_bdd::BddPointer;

use super::Function;

impl Function {
    /// The nodes of the diagram, each after those that it leads to: the place
    /// in the [support](Function::support) of the atom that it tests, and the
    /// nodes that its low and its high branch lead to. Nodes are numbered as
    /// they come from 2 on; 0 and 1 are the constants. The last is the
    /// function; a constant has none.
    pub fn decisions(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        (2..self.diagram().size()).map(|at| {
            let node = BddPointer::from_index(at);
            (
                self.diagram().var_of(node).to_index(),
                self.diagram().low_link_of(node).to_index(),
                self.diagram().high_link_of(node).to_index(),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::{Atoms, Budget, Function, notation};

    #[test]
    fn a_node_comes_after_those_it_leads_to() {
        let expr = notation::parse("a*b + /a*c").expect("an expression");
        let mut atoms = Atoms::default();
        let function = Function::of(&expr, &mut atoms, &Budget::default()).expect("small");
        let decisions: Vec<_> = function.decisions().collect();
        // b and c, then a: what leads to a constant first.
        assert_eq!(decisions, [(1, 0, 1), (2, 0, 1), (0, 3, 2)]);
        assert_eq!(Function::constant(true).decisions().count(), 0);
        assert_eq!(Function::constant(false).decisions().count(), 0);
    }
}
