use std::collections::BTreeSet;
use std::sync::Arc;

use biodivine_lib_bdd::{Bdd, BddNode, BddPointer, BddVariable};
use rustc_hash::FxHashMap;

use crate::{Atom, AtomId, Atoms, Budget, Expr, Stop};

mod decisions;
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
///
/// Clones share all they hold.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Function(Arc<Shared>);

/// What the clones of a function share.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Shared {
    /// Atoms the function depends on, ascending; the diagram's variable k is
    /// the k-th of them.
    support: Vec<AtomId>,
    /// Nodes in the order of a walk that goes down the high branches first and
    /// lists a node after all below it: the order that operations leave them
    /// in, by which equal functions are equal values.
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

/// As long as no more atoms are kept, to try all their values is quicker than
/// to quantify all others away.
const FEW_KEPT: usize = 4;

/// Diagrams of this library hold at most this many variables.
const MOST_VARIABLES: usize = u16::MAX as usize - 2;

impl Function {
    /// The function of `diagram` over `support`, all of which it depends on.
    fn over(support: Vec<AtomId>, diagram: Bdd) -> Self {
        Self(Arc::new(Shared { support, diagram }))
    }

    /// The function that is always `value`.
    pub fn constant(value: bool) -> Self {
        let nodes = constants(0);
        Self::over(
            Vec::new(),
            checked(if value { &nodes } else { &nodes[..1] }),
        )
    }

    /// The function that is `atom`, or its complement.
    pub fn literal(atom: AtomId, positive: bool) -> Self {
        let mut nodes = constants(1);
        let ends = [!positive, positive].map(BddPointer::from_bool);
        nodes.push(BddNode::mk_node(
            BddVariable::from_index(0),
            ends[0],
            ends[1],
        ));
        Self::over(vec![atom], checked(&nodes))
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
        &self.0.support
    }

    /// Its diagram, of which variable k is the k-th atom of the support.
    pub(crate) fn diagram(&self) -> &Bdd {
        &self.0.diagram
    }

    /// Whether the two are clones of one function: cheap to ask, and not
    /// always true of equal functions.
    pub fn is_clone_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// Whether the function depends on `atom`.
    pub fn depends_on(&self, atom: AtomId) -> bool {
        self.support().binary_search(&atom).is_ok()
    }

    /// Number of nodes of the diagram, terminals included.
    pub fn nodes(&self) -> usize {
        self.diagram().size()
    }

    /// Whether the function is always true.
    pub fn is_true(&self) -> bool {
        self.diagram().is_true()
    }

    /// Whether the function is never true.
    pub fn is_false(&self) -> bool {
        self.diagram().is_false()
    }

    /// The complement. It has as many nodes and needs no budget.
    #[must_use]
    pub fn not(&self) -> Self {
        Self::over(self.support().to_vec(), self.diagram().not())
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
        match self.support().binary_search(&atom) {
            Err(_) => self.clone(),
            Ok(at) => {
                let nodes = fixed(self.diagram(), BddVariable::from_index(at), value);
                Self::of_listed(self.support(), nodes)
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
        let support = self.support().iter().copied();
        let (kept, away): (Vec<AtomId>, Vec<AtomId>) =
            support.partition(|atom| keep.contains(atom));
        if !away.is_empty() && kept.len() <= FEW_KEPT {
            return self.projected(&kept, budget);
        }
        away.into_iter()
            .try_fold(self.clone(), |function, atom| function.exists(atom, budget))
    }

    /// The same for a few atoms, all that are kept of the support: it can be
    /// true for some of their values exactly if what these leave is not false.
    fn projected(&self, kept: &[AtomId], budget: &Budget) -> Result<Self, Stop> {
        let Some((&atom, rest)) = kept.split_first() else {
            return Ok(Self::constant(!self.is_false()));
        };
        let low = self.restrict(atom, false).projected(rest, budget)?;
        let high = self.restrict(atom, true).projected(rest, budget)?;
        if low == high {
            return Ok(low);
        }
        let low = low.and(&Self::literal(atom, false), budget)?;
        low.or(&high.and(&Self::atom(atom), budget)?, budget)
    }

    /// Whether raising `atom` from 0 to 1 never makes the function fall.
    pub fn grows_in(&self, atom: AtomId, budget: &Budget) -> Result<bool, Stop> {
        self.restrict(atom, false)
            .implies(&self.restrict(atom, true), budget)
    }

    /// The value where `value_of` says what each atom is.
    pub fn evaluate(&self, mut value_of: impl FnMut(AtomId) -> bool) -> bool {
        let mut node = self.diagram().root_pointer();
        while !node.is_terminal() {
            let variable = self.diagram().var_of(node).to_index();
            node = if value_of(self.support()[variable]) {
                self.diagram().high_link_of(node)
            } else {
                self.diagram().low_link_of(node)
            };
        }
        node.is_one()
    }

    /// The paths of the diagram to 1, each as its literals in ascending order:
    /// what the paper's Algorithm 5 collects. High branches come first. There
    /// may be exponentially many; the caller bounds how many it takes.
    pub fn paths(&self) -> impl Iterator<Item = Vec<Literal>> + '_ {
        self.diagram().sat_clauses().map(|clause| {
            clause
                .to_values()
                .into_iter()
                .map(|(variable, positive)| Literal {
                    atom: self.support()[variable.to_index()],
                    positive,
                })
                .collect()
        })
    }

    fn combine(
        &self,
        other: &Self,
        operation: fn(Option<bool>, Option<bool>) -> Option<bool>,
        budget: &Budget,
    ) -> Result<Self, Stop> {
        budget.check()?;
        let support = united(self.support(), other.support());
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
        if self.support().len() == support.len() {
            return self.diagram().clone();
        }
        let mut place = 0;
        let places = self.support().iter().map(|atom| {
            while support[place] != *atom {
                place += 1;
            }
            place
        });
        let places: Vec<usize> = places.collect();
        let mut nodes = self.diagram().clone().to_nodes();
        renumber(&mut nodes, &places, support.len());
        checked(&nodes)
    }

    /// A function of `diagram` over `support`, less the atoms that it does
    /// not depend on.
    fn shrunk(support: &[AtomId], diagram: Bdd) -> Self {
        let mut needed = vec![false; support.len()];
        for at in 2..diagram.size() {
            needed[diagram.var_of(BddPointer::from_index(at)).to_index()] = true;
        }
        if diagram.size() > 2 && needed.iter().all(|needed| *needed) {
            return Self::over(support.to_vec(), diagram);
        }
        Self::of_listed(support, diagram.to_nodes())
    }

    /// The same of the nodes of a diagram.
    fn of_listed(support: &[AtomId], mut nodes: Vec<BddNode>) -> Self {
        if nodes.len() <= 2 {
            return Self::constant(nodes.len() == 2);
        }
        let mut needed = vec![false; support.len()];
        for node in &nodes[2..] {
            needed[node.var.to_index()] = true;
        }
        let mut places = vec![0; support.len()];
        let mut kept = Vec::with_capacity(support.len());
        for (at, atom) in support.iter().enumerate() {
            if needed[at] {
                places[at] = kept.len();
                kept.push(*atom);
            }
        }
        renumber(&mut nodes, &places, kept.len());
        Self::over(kept, checked(&nodes))
    }

    /// The function of the last of `nodes`: each its atom and where its low
    /// and high branches lead, counted from 2 after the constants. They must
    /// stand in the order of a diagram.
    pub(crate) fn of_nodes(nodes: &[(AtomId, usize, usize)]) -> Result<Self, Stop> {
        let mut support: Vec<AtomId> = nodes.iter().map(|(atom, _, _)| *atom).collect();
        support.sort_unstable();
        support.dedup();
        if support.len() > MOST_VARIABLES {
            return Err(Stop::TooLarge);
        }
        let place = |atom: AtomId| support.partition_point(|other| *other < atom);
        let mut listed = constants(support.len());
        listed.extend(nodes.iter().map(|&(atom, low, high)| {
            BddNode::mk_node(
                BddVariable::from_index(place(atom)),
                BddPointer::from_index(low),
                BddPointer::from_index(high),
            )
        }));
        Ok(Self::over(support, checked(&listed)))
    }
}

/// The first two nodes of every diagram over `count` variables.
fn constants(count: usize) -> Vec<BddNode> {
    vec![
        BddNode::mk_zero(count as u16),
        BddNode::mk_one(count as u16),
    ]
}

/// The nodes of a diagram with a variable replaced by a constant, in the order
/// that operations leave nodes in: a walk that goes down the high branches
/// first and lists a node after all below it. (The library's own restriction
/// goes down the low branches first, so that equal functions would not be
/// equal values.)
fn fixed(diagram: &Bdd, variable: BddVariable, value: bool) -> Vec<BddNode> {
    let mut nodes = constants(diagram.num_vars().into());
    let mut known: FxHashMap<BddNode, BddPointer> = FxHashMap::default();
    let mut becomes: Vec<Option<BddPointer>> = vec![None; diagram.size()];
    for (constant, pointer) in becomes
        .iter_mut()
        .zip([BddPointer::zero(), BddPointer::one()])
    {
        *constant = Some(pointer);
    }
    let root = diagram.root_pointer();
    let mut open = vec![root];
    while let Some(&here) = open.last() {
        if becomes[here.to_index()].is_some() {
            open.pop();
            continue;
        }
        let mut low = diagram.low_link_of(here);
        let mut high = diagram.high_link_of(here);
        let own = diagram.var_of(here);
        if own == variable {
            (low, high) = if value { (high, high) } else { (low, low) };
        }
        match (becomes[low.to_index()], becomes[high.to_index()]) {
            (_, None) => open.push(high),
            (None, _) => open.push(low),
            (Some(low), Some(high)) => {
                let place = if low == high {
                    low
                } else {
                    let node = BddNode::mk_node(own, low, high);
                    *known.entry(node).or_insert_with(|| {
                        nodes.push(node);
                        BddPointer::from_index(nodes.len() - 1)
                    })
                };
                becomes[here.to_index()] = Some(place);
                open.pop();
            }
        }
    }
    if becomes[root.to_index()] == Some(BddPointer::zero()) {
        nodes.truncate(1);
    }
    nodes
}

/// Renames variable k of a diagram's nodes to `places[k]`, which must keep the
/// order, of `count` variables.
fn renumber(nodes: &mut [BddNode], places: &[usize], count: usize) {
    for node in nodes.iter_mut().skip(2) {
        node.var = BddVariable::from_index(places[node.var.to_index()]);
    }
    for (node, constant) in nodes.iter_mut().zip(constants(count)) {
        *node = constant;
    }
}

fn checked(nodes: &[BddNode]) -> Bdd {
    Bdd::from_nodes(nodes).expect("nodes that come from a diagram, in its order, make one")
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
