use logic::{Atom, AtomId, Expr, Function};

use crate::{Gates, Netlist, Signal};

/// What is left to do while an expression is built: visit a part, or combine
/// the signals of the last parts.
enum Task<'e> {
    Visit(&'e Expr),
    Not,
    And(usize),
    Or(usize),
}

impl Netlist {
    /// The gates of an expression, where `leaf` says what each atom is. An
    /// edge or a time is one atom: what it means over scans is for the caller
    /// to say, who knows what the expression belongs to.
    pub fn expr(
        &mut self,
        expr: &Expr,
        mut leaf: impl FnMut(&mut Self, &Atom) -> Signal,
    ) -> Signal {
        let mut tasks = vec![Task::Visit(expr)];
        let mut done: Vec<Signal> = Vec::new();
        while let Some(task) = tasks.pop() {
            let signal = match task {
                Task::Visit(Expr::Constant(value)) => Signal::constant(*value),
                Task::Visit(Expr::Atom(atom)) => leaf(self, atom),
                Task::Visit(Expr::Not(inner)) => {
                    tasks.extend([Task::Not, Task::Visit(inner)]);
                    continue;
                }
                Task::Visit(Expr::And(parts)) => {
                    tasks.push(Task::And(parts.len()));
                    tasks.extend(parts.iter().rev().map(Task::Visit));
                    continue;
                }
                Task::Visit(Expr::Or(parts)) => {
                    tasks.push(Task::Or(parts.len()));
                    tasks.extend(parts.iter().rev().map(Task::Visit));
                    continue;
                }
                Task::Not => !done.pop().unwrap_or(Signal::FALSE),
                Task::And(count) => {
                    let parts = done.split_off(done.len() - count);
                    self.all(&parts)
                }
                Task::Or(count) => {
                    let parts = done.split_off(done.len() - count);
                    self.any(&parts)
                }
            };
            done.push(signal);
        }
        done.pop().unwrap_or(Signal::FALSE)
    }

    /// The gates of a function, one multiplexer for each node of its diagram,
    /// where `leaf` says what each atom is.
    pub fn function(
        &mut self,
        function: &Function,
        mut leaf: impl FnMut(&mut Self, AtomId) -> Signal,
    ) -> Signal {
        let atoms: Vec<Signal> = function
            .support()
            .iter()
            .map(|&atom| leaf(self, atom))
            .collect();
        let mut signals = vec![Signal::FALSE, Signal::TRUE];
        for (place, low, high) in function.decisions() {
            let signal = self.ite(atoms[place], signals[high], signals[low]);
            signals.push(signal);
        }
        match function.is_false() {
            true => Signal::FALSE,
            false => *signals.last().unwrap_or(&Signal::FALSE),
        }
    }
}

#[cfg(test)]
mod tests {
    use logic::{Atoms, Budget, notation};

    use super::*;
    use crate::{Trace, replay};

    /// What the output is for the given values of a, b, c, for each of two
    /// ways to build it.
    fn values(text: &str) -> Vec<[bool; 2]> {
        let expr = notation::parse(text).expect("an expression");
        let mut netlist = Netlist::default();
        for name in ["a", "b", "c"] {
            netlist.input(name);
        }
        let named = |netlist: &mut Netlist, atom: &Atom| match atom {
            Atom::Variable(name) => netlist.input(name.clone()),
            other => panic!("{other:?}"),
        };
        let written = netlist.expr(&expr, named);
        let mut atoms = Atoms::default();
        let function = Function::of(&expr, &mut atoms, &Budget::default()).expect("small");
        let meant = netlist.function(&function, |netlist, atom| named(netlist, atoms.atom(atom)));
        netlist.output("written", written);
        netlist.output("meant", meant);
        let inputs = (0..8).map(|bits| (0..3).map(|at| bits >> at & 1 == 1).collect());
        let trace = Trace {
            initial: Vec::new(),
            inputs: inputs.collect(),
        };
        let outputs = replay(&netlist, &trace).outputs;
        outputs.into_iter().map(|row| [row[0], row[1]]).collect()
    }

    #[test]
    fn an_expression_and_its_function_have_the_same_gates_values() {
        let truth = |f: fn(bool, bool, bool) -> bool| -> Vec<[bool; 2]> {
            let bits = (0..8).map(|at| [at & 1 == 1, at >> 1 & 1 == 1, at >> 2 & 1 == 1]);
            bits.map(|[a, b, c]| [f(a, b, c); 2]).collect()
        };
        assert_eq!(values("a"), truth(|a, _, _| a));
        assert_eq!(values("0"), truth(|_, _, _| false));
        assert_eq!(values("1"), truth(|_, _, _| true));
        assert_eq!(values("/(a*b) + c"), truth(|a, b, c| !(a && b) || c));
        assert_eq!(
            values("(a + /b)*(/a + c)"),
            truth(|a, b, c| (a || !b) && (!a || c))
        );
    }
}
