//! Conditions with a register at a value.

use std::collections::HashMap;

use logic::{Atom, AtomId, Budget, Expr, Function, Name, Stop};

use crate::conditions::{Conditions, WriteKind};

/// The indexed parts of a name: `A.OK[R].Done` has `("A.OK", "R")`. Indices
/// with several dimensions count as none.
pub(super) fn indices(name: &str) -> Vec<(String, &str)> {
    let mut found = Vec::new();
    let mut rest = 0;
    while let Some(open) = name[rest..].find('[').map(|at| at + rest) {
        let Some(close) = name[open..].find(']').map(|at| at + open) else {
            break;
        };
        found.push((name[..open].to_owned(), &name[open + 1..close]));
        rest = close + 1;
    }
    found
}

/// Whether an atom looks at the register: compares it, or is indexed by it.
pub(super) fn mentions(atom: &Atom, register: &Name) -> bool {
    match atom {
        Atom::Comparison(comparison) => {
            comparison.left == *register || comparison.right == *register
        }
        Atom::Variable(name) => indices(name).iter().any(|(_, index)| *index == &**register),
        Atom::Rise(inner) | Atom::Fall(inner) => {
            let mut found = false;
            inner.each_atom(&mut |atom| found |= mentions(atom, register));
            found
        }
        Atom::Elapsed { .. } => false,
    }
}

/// Coils between a register and the guards of its writes.
const FARTHEST: usize = 3;

/// Coils whose only writer depends on the register, directly or through a few
/// others, with their conditions: at a value of the register they are known.
pub(super) fn dependent_coils(
    conditions: &Conditions,
    register: &Name,
) -> HashMap<AtomId, Function> {
    let mut found: HashMap<AtomId, Function> = HashMap::new();
    for _ in 0..FARTHEST {
        let before = found.len();
        for variable in &conditions.variables {
            let [write] = &variable.writes[..] else {
                continue;
            };
            let Ok(next) = &variable.next else { continue };
            let plain = matches!(write.kind, WriteKind::Coil(ladder::CoilKind::Plain));
            let depends = || {
                next.support().iter().any(|atom| {
                    mentions(conditions.atoms.atom(*atom), register) || found.contains_key(atom)
                })
            };
            if plain && !next.depends_on(variable.atom) && depends() {
                found.insert(variable.atom, next.clone());
            }
        }
        if found.len() == before {
            break;
        }
    }
    found
}

/// A register at one of its values: turns conditions of the program into
/// conditions of that step.
pub(super) struct AtValue<'a> {
    register: &'a Name,
    value: i64,
    coils: &'a HashMap<AtomId, Function>,
    conditions: &'a mut Conditions,
    budget: &'a Budget,
    /// What each atom has become, so that none is worked out twice.
    known: HashMap<AtomId, Option<Function>>,
}

impl<'a> AtValue<'a> {
    pub(super) fn new(
        register: &'a Name,
        value: i64,
        coils: &'a HashMap<AtomId, Function>,
        conditions: &'a mut Conditions,
        budget: &'a Budget,
    ) -> Self {
        Self {
            register,
            value,
            coils,
            conditions,
            budget,
            known: HashMap::new(),
        }
    }

    /// `guard` with the register at the value.
    pub(super) fn condition(&mut self, guard: &Function) -> Result<Function, Stop> {
        self.at_depth(guard, 0)
    }

    fn at_depth(&mut self, function: &Function, depth: usize) -> Result<Function, Stop> {
        let mut result = function.clone();
        for &atom in function.support() {
            if let Some(by) = self.atom(atom, depth)? {
                result = result.substitute(atom, &by, self.budget)?;
            }
        }
        Ok(result)
    }

    /// What an atom becomes, if anything else than itself.
    fn atom(&mut self, atom: AtomId, depth: usize) -> Result<Option<Function>, Stop> {
        if let Some(known) = self.known.get(&atom) {
            return Ok(known.clone());
        }
        let becomes = self.worked_out(atom, depth)?;
        self.known.insert(atom, becomes.clone());
        Ok(becomes)
    }

    fn worked_out(&mut self, atom: AtomId, depth: usize) -> Result<Option<Function>, Stop> {
        if let Some(next) = self.coils.get(&atom)
            && depth < FARTHEST
        {
            return self.at_depth(next, depth + 1).map(Some);
        }
        let register = self.register;
        match self.conditions.atoms.atom(atom).clone() {
            Atom::Comparison(comparison) => {
                let value = self.value.to_string();
                let (left, right) = if comparison.left == *register {
                    (&*value, &*comparison.right)
                } else if comparison.right == *register {
                    (&*comparison.left, &*value)
                } else {
                    return Ok(None);
                };
                let expr = Expr::comparison(left, comparison.relation, right);
                Function::of(&expr, &mut self.conditions.atoms, self.budget).map(Some)
            }
            Atom::Variable(name) => {
                let at = format!("[{}]", self.value);
                let indexed = format!("[{register}]");
                if !name.contains(&indexed) {
                    return Ok(None);
                }
                let element = name.replace(&indexed, &at);
                let id = self.conditions.atoms.add_variable(&element.into());
                let own = Function::atom(id);
                match self.atom(id, depth)? {
                    Some(by) => Ok(Some(by)),
                    None => Ok(Some(own)),
                }
            }
            Atom::Rise(inner) => self.edge(&inner, depth, Atom::Rise),
            Atom::Fall(inner) => self.edge(&inner, depth, Atom::Fall),
            Atom::Elapsed { .. } => Ok(None),
        }
    }

    /// An edge of an expression with the register in it: the edge of that
    /// expression at the value. One that can never be true has no edge.
    fn edge(
        &mut self,
        inner: &Expr,
        depth: usize,
        kind: fn(Box<Expr>) -> Atom,
    ) -> Result<Option<Function>, Stop> {
        let function = Function::of(inner, &mut self.conditions.atoms, self.budget)?;
        let at_value = self.at_depth(&function, depth)?;
        if at_value == function {
            return Ok(None);
        }
        if at_value.is_false() {
            return Ok(Some(Function::constant(false)));
        }
        let expr = at_value.to_expr(&self.conditions.atoms, self.budget)?;
        let id = self.conditions.atoms.add(kind(Box::new(expr)));
        Ok(Some(Function::atom(id)))
    }

    /// Whether a condition at the value can be true, the laws of timers
    /// counted: an on-delay that is never enabled at the value never times
    /// out there.
    pub(super) fn can_happen(&mut self, condition: &Function) -> bool {
        if condition.is_false() {
            return false;
        }
        let mut full = condition.clone();
        for &atom in condition.support() {
            let Some(timer) = self.conditions.timers.get(&atom).cloned() else {
                continue;
            };
            let applied = timer
                .input
                .clone()
                .and_then(|input| self.condition(&input))
                .and_then(|input| Function::atom(atom).and(&input, self.budget))
                .and_then(|law| full.substitute(atom, &law, self.budget));
            if timer.kind == ladder::TimerKind::OnDelay
                && let Ok(lawful) = applied
            {
                full = lawful;
            }
        }
        !full.is_false()
    }
}
