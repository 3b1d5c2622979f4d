//! How conditions are put into words: states become the variables of their
//! steps.

use std::collections::HashMap;

use logic::{Atom, AtomId, Atoms, Budget, Comparison, Expr, Function, Name};

use crate::Analysis;
use crate::conditions::Variable;
use crate::registers::Register;

/// Which steps stand for which states, and how to say conditions over them.
pub(super) struct Wording<'a> {
    analysis: &'a Analysis,
    /// The atoms of all conditions.
    atoms: &'a Atoms,
    budget: Budget,
    /// Steps of a state held in one bit; several where it is reached in
    /// different ways.
    steps: HashMap<AtomId, Vec<Name>>,
    /// Steps of a register's values.
    values: HashMap<Name, Vec<(i64, Name)>>,
}

/// A receptivity of more products than this is not written out: nobody could
/// read it, and a spec is there to be read.
const MOST_PRODUCTS: usize = 48;

impl<'a> Wording<'a> {
    pub(super) fn new(analysis: &'a Analysis, atoms: &'a Atoms, budget: &Budget) -> Self {
        Self {
            analysis,
            atoms,
            budget: Budget {
                products: budget.products.min(MOST_PRODUCTS),
                ..budget.clone()
            },
            steps: HashMap::new(),
            values: HashMap::new(),
        }
    }

    /// Says that `step` stands for the state `atom`.
    pub(super) fn stands_for(&mut self, atom: AtomId, step: Name) {
        self.steps.entry(atom).or_default().push(step);
    }

    /// Says that `step` stands for a value of a register.
    pub(super) fn stands_for_value(&mut self, register: &Register, value: i64, step: Name) {
        self.values
            .entry(register.name.clone())
            .or_default()
            .push((value, step));
    }

    /// The steps of a state.
    pub(super) fn steps_of(&self, atom: AtomId) -> &[Name] {
        self.steps.get(&atom).map_or(&[], Vec::as_slice)
    }

    /// The steps of a register with their values.
    pub(super) fn steps_of_register(&self, register: &Name) -> &[(i64, Name)] {
        self.values.get(register).map_or(&[], Vec::as_slice)
    }

    /// The next value of a variable with transition bits resolved.
    pub(super) fn resolved(&self, variable: &Variable) -> Option<Function> {
        let next = variable.next.as_ref().ok()?;
        let conditions = &self.analysis.conditions;
        let auxiliaries = &self.analysis.states().auxiliaries;
        Some(auxiliaries.resolve(next, conditions, &self.budget))
    }

    /// `function` as a receptivity or condition; `None` past the budget.
    ///
    /// Where it needs an edge to rise, what rises is true anyway and is not
    /// said a second time.
    pub(super) fn say(&self, function: &Function) -> Option<Expr> {
        let sums = &self.analysis.sums;
        let sum = sums.of(function, &self.budget, || self.sum(function))?;
        Some(self.in_steps(&sum))
    }

    /// The same before steps stand for states.
    fn sum(&self, function: &Function) -> Option<Expr> {
        let atoms = self.atoms;
        let mut rest = function.clone();
        let mut care = Function::constant(true);
        let mut edges = Vec::new();
        for &atom in function.support() {
            let Atom::Rise(inner) = atoms.atom(atom) else {
                continue;
            };
            if !function.restrict(atom, false).is_false() {
                continue;
            }
            let mut leaf = |atom: &Atom| match atoms.find(atom) {
                Some(id) => Function::atom(id),
                None => Function::constant(true),
            };
            let rising = Function::build(inner, &mut leaf, &self.budget).ok()?;
            care = care.and(&rising, &self.budget).ok()?;
            rest = rest.restrict(atom, true);
            edges.push(Expr::Atom(atoms.atom(atom).clone()));
        }
        let lower = rest.and(&care, &self.budget).ok()?;
        let upper = rest.or(&care.not(), &self.budget).ok()?;
        let expr = lower.to_expr_within(&upper, atoms, &self.budget).ok()?;
        if edges.is_empty() {
            return Some(expr);
        }
        match expr {
            Expr::Constant(true) => {}
            Expr::And(parts) => edges.extend(parts),
            other => edges.push(other),
        }
        Some(if edges.len() == 1 {
            edges.remove(0)
        } else {
            Expr::And(edges)
        })
    }

    /// `function` in words; past the budget a variable called after `label`,
    /// which a person has to fill in: the shape of the chart is still right.
    pub(super) fn say_or_name(&self, function: &Function, label: &str) -> Expr {
        self.say(function)
            .unwrap_or_else(|| Expr::variable(format!("condition of {label}")))
    }

    /// Like a share of states, of a register's values: the steps at which
    /// `function` can be true, if it is false at all values that have none.
    pub(super) fn shares_of_register(&self, function: &Function) -> Vec<(Name, Option<Expr>)> {
        let atoms = self.atoms;
        let register = function
            .support()
            .iter()
            .find_map(|atom| match atoms.atom(*atom) {
                Atom::Comparison(c) if self.values.contains_key(&c.left) => Some(&c.left),
                _ => None,
            });
        let Some(register) = register else {
            return Vec::new();
        };
        let at = |value: Option<i64>| {
            function
                .support()
                .iter()
                .fold(function.clone(), |here, atom| {
                    let Atom::Comparison(comparison) = atoms.atom(*atom) else {
                        return here;
                    };
                    let number = comparison.right.parse::<i64>();
                    match (number, value) {
                        (Ok(number), Some(value)) if comparison.left == *register => {
                            here.restrict(*atom, comparison.relation.holds(value, number))
                        }
                        (Ok(_), None) if comparison.left == *register => {
                            here.restrict(*atom, false)
                        }
                        _ => here,
                    }
                })
        };
        if !at(None).is_false() {
            return Vec::new();
        }
        let mut shares = Vec::new();
        for (value, step) in self.steps_of_register(register) {
            let here = at(Some(*value));
            if here.is_false() {
                continue;
            }
            let Some(condition) = self.say(&here) else {
                return Vec::new();
            };
            let condition = (condition != Expr::Constant(true)).then_some(condition);
            shares.push((step.clone(), condition));
        }
        shares
    }

    fn in_steps(&self, expr: &Expr) -> Expr {
        match expr {
            Expr::Constant(_) => expr.clone(),
            Expr::Not(inner) => self.in_steps(inner).complement(),
            Expr::And(parts) => Expr::And(parts.iter().map(|p| self.in_steps(p)).collect()),
            Expr::Or(parts) => Expr::Or(parts.iter().map(|p| self.in_steps(p)).collect()),
            Expr::Atom(atom) => self.atom(atom),
        }
    }

    fn atom(&self, atom: &Atom) -> Expr {
        match atom {
            Atom::Variable(_) => {
                let id = self.atoms.find(atom);
                match id.map(|id| self.steps_of(id)) {
                    Some(steps) if !steps.is_empty() => any_of(steps.iter()),
                    _ => Expr::Atom(atom.clone()),
                }
            }
            Atom::Comparison(comparison) => self.comparison(comparison),
            Atom::Rise(inner) => Expr::Atom(Atom::Rise(Box::new(self.in_steps(inner)))),
            Atom::Fall(inner) => Expr::Atom(Atom::Fall(Box::new(self.in_steps(inner)))),
            Atom::Elapsed { .. } => Expr::Atom(atom.clone()),
        }
    }

    /// A comparison of a step register with a number: the steps at which it
    /// holds, or, where these are more, none of the others.
    fn comparison(&self, comparison: &Comparison) -> Expr {
        let as_is = || Expr::Atom(Atom::Comparison(comparison.clone()));
        let Some(steps) = self.values.get(&comparison.left) else {
            return as_is();
        };
        let Ok(number) = comparison.right.parse::<i64>() else {
            return as_is();
        };
        let (inside, outside): (Vec<_>, Vec<_>) = steps
            .iter()
            .partition(|(value, _)| comparison.relation.holds(*value, number));
        let name = |entry: &'_ &(i64, Name)| entry.1.clone();
        if inside.len() <= outside.len() {
            any_of(inside.iter().map(name).collect::<Vec<_>>().iter())
        } else {
            any_of(outside.iter().map(name).collect::<Vec<_>>().iter()).complement()
        }
    }
}

fn any_of<'n>(names: impl Iterator<Item = &'n Name>) -> Expr {
    let mut parts: Vec<Expr> = names.cloned().map(Expr::variable).collect();
    match parts.len() {
        0 => Expr::Constant(false),
        1 => parts.remove(0),
        _ => Expr::Or(parts),
    }
}
