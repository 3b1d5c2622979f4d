use std::collections::BTreeSet;

use biodivine_lib_bdd::{Bdd, BddNode, BddVariable, BddVariableSet};

use crate::{Atom, AtomId, Atoms, Budget, Expr, Stop};

mod literals;

/// A Boolean function over atoms: what an expression means.
///
/// A function knows the atoms it depends on, its *support*, and holds a
/// reduced ordered BDD over just these. A program of ten thousand rungs thus
/// has ten thousand small diagrams, none of which pays for the others'
/// variables, and there is no limit on the number of atoms in a program.
/// Operations bring two functions over their united supports first, which
/// keeps the order and is linear in their nodes.
///
/// Two functions are equal, as values, exactly when they denote the same
/// Boolean function: the diagrams are canonical and the support holds no atom
/// that the function does not depend on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Function {
    /// Atoms the function depends on, ascending; the diagram's variable k is
    /// the k-th of them.
    support: Vec<AtomId>,
    diagram: Bdd,
}

/// An atom or its complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Literal {
    /// Which atom.
    pub atom: AtomId,
    /// Whether it is the atom (true) or its complement (false).
    pub positive: bool,
}

/// Diagrams of this library hold at most this many variables.
const MOST_VARIABLES: usize = u16::MAX as usize - 2;

impl Function {
    /// The function that is always `value`.
    pub fn constant(value: bool) -> Self {
        let none = BddVariableSet::new_anonymous(0);
        Self {
            support: Vec::new(),
            diagram: if value {
                none.mk_true()
            } else {
                none.mk_false()
            },
        }
    }

    /// The function that is `atom`, or its complement.
    pub fn literal(atom: AtomId, positive: bool) -> Self {
        let one = BddVariableSet::new_anonymous(1);
        Self {
            support: vec![atom],
            diagram: one.mk_literal(BddVariable::from_index(0), positive),
        }
    }

    /// The function that is `atom`.
    pub fn atom(atom: AtomId) -> Self {
        Self::literal(atom, true)
    }

    /// What `expr` means; atoms not yet in `atoms` are added at its end.
    pub fn of(expr: &Expr, atoms: &mut Atoms, budget: &Budget) -> Result<Self, Stop> {
        Self::build(
            expr,
            &mut |atom| Self::atom(atoms.add(atom.clone())),
            budget,
        )
    }

    /// What `expr` means, where `leaf` says what each atom means.
    pub fn build(
        expr: &Expr,
        leaf: &mut impl FnMut(&Atom) -> Self,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        match expr {
            Expr::Constant(value) => Ok(Self::constant(*value)),
            Expr::Atom(atom) => Ok(leaf(atom)),
            Expr::Not(inner) => Ok(Self::build(inner, leaf, budget)?.not()),
            Expr::And(parts) => parts.iter().try_fold(Self::constant(true), |all, part| {
                all.and(&Self::build(part, leaf, budget)?, budget)
            }),
            Expr::Or(parts) => parts.iter().try_fold(Self::constant(false), |any, part| {
                any.or(&Self::build(part, leaf, budget)?, budget)
            }),
        }
    }

    /// The atoms that the function depends on, ascending.
    pub fn support(&self) -> &[AtomId] {
        &self.support
    }

    /// Whether the function depends on `atom`.
    pub fn depends_on(&self, atom: AtomId) -> bool {
        self.support.binary_search(&atom).is_ok()
    }

    /// Number of nodes of the diagram, terminals included.
    pub fn nodes(&self) -> usize {
        self.diagram.size()
    }

    /// Whether the function is always true.
    pub fn is_true(&self) -> bool {
        self.diagram.is_true()
    }

    /// Whether the function is never true.
    pub fn is_false(&self) -> bool {
        self.diagram.is_false()
    }

    /// The complement. It has as many nodes and needs no budget.
    #[must_use]
    pub fn not(&self) -> Self {
        Self {
            support: self.support.clone(),
            diagram: self.diagram.not(),
        }
    }

    /// `self * other`
    pub fn and(&self, other: &Self, budget: &Budget) -> Result<Self, Stop> {
        if self.is_true() || other.is_false() {
            return Ok(other.clone());
        }
        if other.is_true() || self.is_false() {
            return Ok(self.clone());
        }
        self.combine(other, biodivine_lib_bdd::op_function::and, budget)
    }

    /// `self + other`
    pub fn or(&self, other: &Self, budget: &Budget) -> Result<Self, Stop> {
        if self.is_false() || other.is_true() {
            return Ok(other.clone());
        }
        if other.is_false() || self.is_true() {
            return Ok(self.clone());
        }
        self.combine(other, biodivine_lib_bdd::op_function::or, budget)
    }

    /// `self * /other`
    pub fn and_not(&self, other: &Self, budget: &Budget) -> Result<Self, Stop> {
        if self.is_false() || other.is_false() {
            return Ok(self.clone());
        }
        if other.is_true() {
            return Ok(Self::constant(false));
        }
        if self.is_true() {
            return Ok(other.not());
        }
        self.combine(other, biodivine_lib_bdd::op_function::and_not, budget)
    }

    /// True where exactly one of the two is.
    pub fn xor(&self, other: &Self, budget: &Budget) -> Result<Self, Stop> {
        self.combine(other, biodivine_lib_bdd::op_function::xor, budget)
    }

    /// Whether `other` holds wherever `self` does.
    pub fn implies(&self, other: &Self, budget: &Budget) -> Result<bool, Stop> {
        Ok(self.and_not(other, budget)?.is_false())
    }

    /// Whether both can be true together.
    pub fn meets(&self, other: &Self, budget: &Budget) -> Result<bool, Stop> {
        Ok(!self.and(other, budget)?.is_false())
    }

    /// The function with `atom` replaced by a constant: `g[Q:=0]`.
    #[must_use]
    pub fn restrict(&self, atom: AtomId, value: bool) -> Self {
        match self.support.binary_search(&atom) {
            Err(_) => self.clone(),
            Ok(at) => {
                let variable = BddVariable::from_index(at);
                let diagram = self.diagram.var_restrict(variable, value);
                Self::shrunk(&self.support, diagram)
            }
        }
    }

    /// The function with `atom` replaced by another function.
    pub fn substitute(&self, atom: AtomId, by: &Self, budget: &Budget) -> Result<Self, Stop> {
        if !self.depends_on(atom) || *by == Self::atom(atom) {
            return Ok(self.clone());
        }
        let high = self.restrict(atom, true).and(by, budget)?;
        let low = self.restrict(atom, false).and_not(by, budget)?;
        high.or(&low, budget)
    }

    /// Whether some value of `atom` makes it true: `g[Q:=0] + g[Q:=1]`.
    pub fn exists(&self, atom: AtomId, budget: &Budget) -> Result<Self, Stop> {
        self.restrict(atom, false)
            .or(&self.restrict(atom, true), budget)
    }

    /// The function with every atom but those of `keep` quantified away: what
    /// the function says about `keep` alone.
    pub fn project(&self, keep: &BTreeSet<AtomId>, budget: &Budget) -> Result<Self, Stop> {
        let (kept, away): (Vec<AtomId>, Vec<AtomId>) =
            self.support.iter().partition(|atom| keep.contains(atom));
        let is_split_cheaper = 1_usize
            .checked_shl(kept.len() as u32)
            .is_some_and(|parts| parts <= away.len());
        if is_split_cheaper {
            return self.split(&kept, budget);
        }
        away.into_iter()
            .try_fold(self.clone(), |function, atom| function.exists(atom, budget))
    }

    /// The projection on `kept`, one value of these after the other: what is
    /// left of the function then can hold or cannot.
    fn split(&self, kept: &[AtomId], budget: &Budget) -> Result<Self, Stop> {
        let Some((&atom, rest)) = kept.split_first() else {
            return Ok(Self::constant(!self.is_false()));
        };
        let low = self.restrict(atom, false).split(rest, budget)?;
        let high = self.restrict(atom, true).split(rest, budget)?;
        let atom = Self::atom(atom);
        atom.and(&high, budget)?
            .or(&low.and_not(&atom, budget)?, budget)
    }

    /// Whether raising `atom` from 0 to 1 never makes the function fall.
    pub fn grows_in(&self, atom: AtomId, budget: &Budget) -> Result<bool, Stop> {
        self.restrict(atom, false)
            .implies(&self.restrict(atom, true), budget)
    }

    /// The value where `value_of` says what each atom is.
    pub fn evaluate(&self, mut value_of: impl FnMut(AtomId) -> bool) -> bool {
        let mut node = self.diagram.root_pointer();
        while !node.is_terminal() {
            let variable = self.diagram.var_of(node).to_index();
            node = if value_of(self.support[variable]) {
                self.diagram.high_link_of(node)
            } else {
                self.diagram.low_link_of(node)
            };
        }
        node.is_one()
    }

    /// The paths of the diagram to 1, each as its literals in ascending order:
    /// what the paper's Algorithm 5 collects. High branches come first. There
    /// may be exponentially many; the caller bounds how many it takes.
    pub fn paths(&self) -> impl Iterator<Item = Vec<Literal>> + '_ {
        self.diagram.sat_clauses().map(|clause| {
            clause
                .to_values()
                .into_iter()
                .map(|(variable, positive)| Literal {
                    atom: self.support[variable.to_index()],
                    positive,
                })
                .collect()
        })
    }

    /// The first atom of the support, the root of the diagram.
    pub(crate) fn top(&self) -> Option<AtomId> {
        self.support.first().copied()
    }

    fn combine(
        &self,
        other: &Self,
        operation: fn(Option<bool>, Option<bool>) -> Option<bool>,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        budget.check()?;
        let support = united(&self.support, &other.support);
        if support.len() > MOST_VARIABLES {
            return Err(Stop::TooLarge);
        }
        let left = self.lifted(&support);
        let right = other.lifted(&support);
        let diagram = Bdd::binary_op_with_limit(budget.nodes, &left, &right, operation)
            .ok_or(Stop::TooLarge)?;
        Ok(Self::shrunk(&support, diagram))
    }

    /// The diagram over `support`, which holds every atom of this function's.
    fn lifted(&self, support: &[AtomId]) -> Bdd {
        if self.support.len() == support.len() {
            return self.diagram.clone();
        }
        let mut place = 0;
        let places = self.support.iter().map(|atom| {
            while support[place] != *atom {
                place += 1;
            }
            place
        });
        renumbered(&self.diagram, &places.collect::<Vec<_>>(), support.len())
    }

    /// A function of `diagram` over `support`, less the atoms that it does
    /// not depend on.
    fn shrunk(support: &[AtomId], diagram: Bdd) -> Self {
        if diagram.is_true() || diagram.is_false() {
            return Self::constant(diagram.is_true());
        }
        let needed = diagram.support_set();
        if needed.len() == support.len() {
            return Self {
                support: support.to_vec(),
                diagram,
            };
        }
        let mut places = vec![0; support.len()];
        let mut kept = Vec::with_capacity(needed.len());
        for (at, atom) in support.iter().enumerate() {
            if needed.contains(&BddVariable::from_index(at)) {
                places[at] = kept.len();
                kept.push(*atom);
            }
        }
        Self {
            diagram: renumbered(&diagram, &places, kept.len()),
            support: kept,
        }
    }
}

/// The diagram with variable k renamed to `places[k]`, which must keep the
/// order, over `count` variables.
fn renumbered(diagram: &Bdd, places: &[usize], count: usize) -> Bdd {
    let count = count as u16;
    let nodes: Vec<BddNode> = diagram
        .clone()
        .to_nodes()
        .into_iter()
        .enumerate()
        .map(|(at, node)| match at {
            0 => BddNode::mk_zero(count),
            1 => BddNode::mk_one(count),
            _ => BddNode {
                var: BddVariable::from_index(places[node.var.to_index()]),
                ..node
            },
        })
        .collect();
    Bdd::from_nodes(&nodes).expect("renaming that keeps the order keeps a diagram valid")
}

fn united(a: &[AtomId], b: &[AtomId]) -> Vec<AtomId> {
    let mut all = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        all.push(a[i].min(b[j]));
        let (left, right) = (a[i], b[j]);
        i += usize::from(left <= right);
        j += usize::from(right <= left);
    }
    all.extend_from_slice(&a[i..]);
    all.extend_from_slice(&b[j..]);
    all
}
