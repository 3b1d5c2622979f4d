use std::cell::Cell;

use batsat::{Callbacks, ClauseKind, Lit, Solver as Sat, SolverInterface, SolverOpts, lbool};
use logic::Cancel;

use crate::Signal;
use crate::aside::{LARGE, free_aside};
use crate::graph::Graph;
use crate::limits::{Meter, STRIDE, Why};

/// What the search counts for, in steps: a literal propagated, with the clauses
/// that are looked at for it, and a conflict, with what is learnt from it.
const PER_LITERAL: u64 = 20;
const PER_CONFLICT: u64 = 2_000;
/// What a decision counts for as long as the literals that follow from it are
/// not counted: the solver tells their number only when it is done.
const PER_DECISION: u64 = 200;

/// Asks whether signals of a graph can be 1 together.
///
/// The graph may grow between questions. Of its gates only those are known to
/// the search that a question or an assertion needs, as three clauses each
/// (Tseitin 1968), so questions about a corner of a large graph stay cheap;
/// what was learnt in one is used in the next (Eén, Sörensson: Temporal
/// induction by incremental SAT solving, 2003).
pub(crate) struct Solver {
    sat: Sat<Watch>,
    /// The variable of each node that was asked about.
    variables: Vec<Option<batsat::Var>>,
    clause: Vec<Lit>,
    open: Vec<usize>,
}

/// Whether the signals of a question can be 1 together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// They can; [`Solver::value`] tells how.
    Yes,
    /// They cannot.
    No,
}

impl Drop for Solver {
    fn drop(&mut self) {
        // A search keeps two lists for each variable.
        let parts = self.variables.len();
        if parts >= LARGE {
            free_aside(std::mem::replace(&mut self.sat, fresh()), parts);
        }
    }
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            sat: fresh(),
            variables: Vec::new(),
            clause: Vec::new(),
            open: Vec::new(),
        }
    }
}

impl Solver {
    /// From now on `signal` is 1.
    pub fn assert(&mut self, graph: &Graph, signal: Signal, meter: &mut Meter) -> Result<(), Why> {
        self.assert_any(graph, &[signal], meter)
    }

    /// From now on at least one of the signals is 1.
    pub fn assert_any(
        &mut self,
        graph: &Graph,
        signals: &[Signal],
        meter: &mut Meter,
    ) -> Result<(), Why> {
        let mut clause = Vec::with_capacity(signals.len());
        for &signal in signals {
            clause.push(self.literal(graph, signal, meter)?);
        }
        self.sat.add_clause_reuse(&mut clause);
        Ok(())
    }

    /// Has the next answers tell the value of `signal`, whether the question needs
    /// it or not.
    pub fn watch(&mut self, graph: &Graph, signal: Signal, meter: &mut Meter) -> Result<(), Why> {
        self.literal(graph, signal, meter).map(drop)
    }

    /// Whether all of `signals` can be 1 together with what was asserted.
    pub fn ask(
        &mut self,
        graph: &Graph,
        signals: &[Signal],
        meter: &mut Meter,
    ) -> Result<Answer, Why> {
        let mut assumed = Vec::with_capacity(signals.len());
        for &signal in signals {
            assumed.push(self.literal(graph, signal, meter)?);
        }
        let clauses = self.sat.num_clauses() as usize;
        self.sat.cb_mut().start(meter, clauses);
        let before = self.work();
        let answer = self.sat.solve_limited(&assumed);
        let work = self.work() - before;
        let full = self.sat.cb().kept.get() >= meter.clauses;
        let spent = meter.spend(work as usize + 10);
        if answer == lbool::TRUE {
            Ok(Answer::Yes)
        } else if answer == lbool::FALSE {
            Ok(Answer::No)
        } else {
            spent?;
            Err(if full { Why::Memory } else { Why::Steps })
        }
    }

    /// What all searches took, in steps.
    fn work(&self) -> u64 {
        PER_LITERAL * self.sat.num_propagations() + PER_CONFLICT * self.sat.num_conflicts()
    }

    /// The value of a signal in the last answer, if the answer was yes and the
    /// signal mattered to it.
    pub fn value(&self, signal: Signal) -> Option<bool> {
        if signal.node() == 0 {
            return Some(signal == Signal::TRUE);
        }
        let variable = self.variables.get(signal.node()).copied().flatten()?;
        let value = self
            .sat
            .value_lit(Lit::new(variable, !signal.is_complement()));
        (value != lbool::UNDEF).then_some(value == lbool::TRUE)
    }

    /// The literal of a signal, whose gates are made known as far as needed.
    fn literal(&mut self, graph: &Graph, signal: Signal, meter: &mut Meter) -> Result<Lit, Why> {
        if self.variables.len() < graph.len() {
            self.variables.resize(graph.len(), None);
        }
        let mut made = 0;
        self.open.push(signal.node());
        while let Some(&node) = self.open.last() {
            if self.variables[node].is_some() {
                self.open.pop();
                continue;
            }
            match graph.gate(node) {
                None => {
                    let variable = self.sat.new_var_default();
                    self.variables[node] = Some(variable);
                    if node == 0 {
                        self.add(&[Lit::new(variable, false)]);
                    }
                }
                Some([a, b]) => {
                    let known = |signal: Signal| self.variables[signal.node()];
                    let (Some(left), Some(right)) = (known(a), known(b)) else {
                        self.open.extend([a.node(), b.node()]);
                        continue;
                    };
                    let variable = self.sat.new_var_default();
                    self.variables[node] = Some(variable);
                    let both = Lit::new(variable, true);
                    let left = Lit::new(left, !a.is_complement());
                    let right = Lit::new(right, !b.is_complement());
                    self.add(&[!both, left]);
                    self.add(&[!both, right]);
                    self.add(&[both, !left, !right]);
                    made += 1;
                }
            }
            self.open.pop();
            if made == STRIDE {
                self.made(made, meter)?;
                made = 0;
            }
        }
        self.made(made, meter)?;
        let variable = self.variables[signal.node()].unwrap_or(batsat::Var::UNDEF);
        Ok(Lit::new(variable, !signal.is_complement()))
    }

    /// So many gates were made known.
    fn made(&mut self, gates: usize, meter: &mut Meter) -> Result<(), Why> {
        let within = meter.spend(10 * gates);
        if within.is_ok() && self.sat.num_clauses() as usize <= meter.clauses {
            return Ok(());
        }
        // What is left open is begun anew when somebody asks again.
        self.open.clear();
        within.and(Err(Why::Memory))
    }

    fn add(&mut self, literals: &[Lit]) {
        self.clause.clear();
        self.clause.extend_from_slice(literals);
        self.sat.add_clause_reuse(&mut self.clause);
    }
}

fn fresh() -> Sat<Watch> {
    Sat::new(SolverOpts::default(), Watch::default())
}

/// Stops a search from within: asked at every decision.
#[derive(Default)]
struct Watch {
    cancel: Cancel,
    left: Cell<u64>,
    kept: Cell<usize>,
    most: usize,
}

impl Watch {
    fn start(&mut self, meter: &Meter, clauses: usize) {
        self.cancel = meter.cancel.clone();
        self.left.set(meter.left);
        self.kept.set(clauses);
        self.most = meter.clauses;
    }
}

impl Callbacks for Watch {
    fn stop(&self) -> bool {
        self.left.set(self.left.get().saturating_sub(PER_DECISION));
        self.left.get() == 0 || self.kept.get() >= self.most || self.cancel.is_cancelled()
    }

    fn on_new_clause(&mut self, _: &[Lit], kind: ClauseKind) {
        if kind == ClauseKind::Learnt {
            self.left.set(self.left.get().saturating_sub(PER_CONFLICT));
            self.kept.set(self.kept.get() + 1);
        }
    }

    fn on_delete_clause(&mut self, _: &[Lit]) {
        self.kept.set(self.kept.get().saturating_sub(1));
    }
}
