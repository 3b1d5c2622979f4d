use std::cell::Cell;

use biodivine_lib_bdd::{Bdd, BddPointer, BddVariable, BddVariableSet, op_function};

use logic::Cancel;

use crate::limits::{Meter, Why};

/// The most variables that are tried: what has more does not end in practice.
const MOST_VARIABLES: usize = 4_000;

/// Operations on decision diagrams that keep within limits.
///
/// The library can limit the nodes of a result, but an operation may visit many
/// more pairs of nodes than it makes nodes, and cannot be interrupted. But it
/// asks for the operation's value at each pair; there the pairs are counted, and
/// when enough is enough every further answer is 0, so that it ends at once and
/// what came out is thrown away.
pub(crate) struct Diagrams {
    variables: BddVariableSet,
    count: usize,
}

/// How often a cancel is looked for, in pairs of nodes.
const LOOK: usize = 1024;

type Operation = fn(Option<bool>, Option<bool>) -> Option<bool>;

impl Diagrams {
    /// Whether so many variables are not tried.
    pub fn are_too_many(variables: usize) -> bool {
        variables > MOST_VARIABLES
    }

    pub fn new(variables: usize) -> Result<Self, Why> {
        if Self::are_too_many(variables) {
            return Err(Why::Memory);
        }
        Ok(Self {
            variables: BddVariableSet::new_anonymous(variables as u16),
            count: variables,
        })
    }

    pub fn constant(&self, value: bool) -> Bdd {
        match value {
            true => self.variables.mk_true(),
            false => self.variables.mk_false(),
        }
    }

    pub fn variable(&self, variable: usize) -> Bdd {
        self.variables.mk_var(BddVariable::from_index(variable))
    }

    pub fn and(&self, a: &Bdd, b: &Bdd, meter: &mut Meter) -> Result<Bdd, Why> {
        self.combine(a, b, op_function::and, meter)
    }

    pub fn or(&self, a: &Bdd, b: &Bdd, meter: &mut Meter) -> Result<Bdd, Why> {
        self.combine(a, b, op_function::or, meter)
    }

    pub fn and_not(&self, a: &Bdd, b: &Bdd, meter: &mut Meter) -> Result<Bdd, Why> {
        self.combine(a, b, op_function::and_not, meter)
    }

    /// 1 where both are the same.
    pub fn equal(&self, a: &Bdd, b: &Bdd, meter: &mut Meter) -> Result<Bdd, Why> {
        self.combine(a, b, op_function::iff, meter)
    }

    fn combine(&self, a: &Bdd, b: &Bdd, by: Operation, meter: &mut Meter) -> Result<Bdd, Why> {
        let count = Count::new(meter);
        let result = Bdd::binary_op(a, b, |a, b| count.at(by(a, b)));
        count.spend(result, meter)
    }

    /// `a * b`, for some values of the variables for which `away` holds.
    pub fn and_exists(
        &self,
        a: &Bdd,
        b: &Bdd,
        away: &[bool],
        meter: &mut Meter,
    ) -> Result<Bdd, Why> {
        let count = Count::new(meter);
        let result = Bdd::binary_op_nested(
            a,
            b,
            |variable| away[variable.to_index()],
            |a, b| count.at(op_function::and(a, b)),
            |a, b| count.at(op_function::or(a, b)),
        );
        count.spend(result, meter)
    }

    /// The diagram with each variable replaced by the one before it. The order
    /// must stay the same.
    pub fn one_before(&self, diagram: &Bdd) -> Result<Bdd, Why> {
        let mut nodes = diagram.clone().to_nodes();
        for node in nodes.iter_mut().skip(2) {
            node.var = BddVariable::from_index(node.var.to_index().saturating_sub(1));
        }
        Bdd::from_nodes(&nodes).map_err(|_| Why::Unconfirmed)
    }

    /// In how many ways the variables for which `counted` holds, and on which
    /// alone `diagram` depends, make it 1; `None` if that may not fit.
    pub fn ways(&self, diagram: &Bdd, counted: &[bool]) -> Option<u128> {
        // How many counted variables come before each.
        let mut rank = vec![0_u32];
        for &is_counted in counted {
            rank.push(rank[rank.len() - 1] + u32::from(is_counted));
        }
        if rank[self.count] > 127 {
            return None;
        }
        let rank = |node: BddPointer| match node.is_terminal() {
            true => rank[self.count],
            false => rank[diagram.var_of(node).to_index()],
        };
        let mut ways = vec![0_u128, 1];
        for at in 2..diagram.size() {
            let node = BddPointer::from_index(at);
            let children = [diagram.low_link_of(node), diagram.high_link_of(node)];
            let below =
                |child: BddPointer| ways[child.to_index()] << (rank(child) - rank(node) - 1);
            ways.push(children.into_iter().map(below).sum());
        }
        let root = diagram.root_pointer();
        Some(ways[root.to_index()] << rank(root))
    }
}

/// Counts the pairs of nodes that an operation visits, and ends it.
struct Count {
    cancel: Cancel,
    most: usize,
    pairs: Cell<usize>,
    is_over: Cell<bool>,
}

impl Count {
    fn new(meter: &Meter) -> Self {
        Self {
            cancel: meter.cancel.clone(),
            // Each pair is asked for two times.
            most: 2 * meter.nodes.min(meter.left as usize),
            pairs: Cell::new(0),
            is_over: Cell::new(false),
        }
    }

    fn at(&self, value: Option<bool>) -> Option<bool> {
        let pairs = self.pairs.get() + 1;
        self.pairs.set(pairs);
        if pairs > self.most || pairs.is_multiple_of(LOOK) && self.cancel.is_cancelled() {
            self.is_over.set(true);
        }
        if self.is_over.get() {
            Some(false)
        } else {
            value
        }
    }

    /// The result, if the operation came to its end.
    fn spend(self, result: Bdd, meter: &mut Meter) -> Result<Bdd, Why> {
        meter.spend(4 * self.pairs.get() + result.size())?;
        if self.is_over.get() {
            return Err(Why::Memory);
        }
        Ok(result)
    }
}
