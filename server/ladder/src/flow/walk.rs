//! Follows the layouts from the main routines down and writes the visits.

use std::collections::HashSet;

use petgraph::graph::NodeIndex;
use source::{Diagnostic, codes};

use super::{Guard, GuardSet, Layout, Order, Place, Steer, Visit};
use crate::{ElementKind, Program, Role};

/// Visits and guard sets allowed beyond the number that the program's size
/// explains. Real programs call a routine from a few places at most.
const SPARE: usize = 20_000;
/// Visits and guard sets allowed for each stretch of the program.
const PER_STRETCH: usize = 16;

/// One walk over a program. All its orders share one allowance, so that the
/// whole stays linear.
pub(super) struct Walk<'p> {
    program: &'p Program,
    layouts: &'p [Layout],
    visited: Vec<bool>,
    /// Routines on the path of calls being walked.
    open: Vec<bool>,
    allowance: usize,
    /// How much of the allowance the orders before have used.
    spent: usize,
    /// Calls that would close a circle and have been reported.
    cut_calls: HashSet<(usize, usize, NodeIndex)>,
    diagnostics: Vec<Diagnostic>,
}

/// A routine being walked.
struct Frame {
    routine: usize,
    /// The next stretch.
    next: usize,
    /// The next range of repetition.
    repeated: usize,
    /// Number of guards when the routine was entered, its call's excluded.
    floor: usize,
    /// A zone that has begun: its first and last stretch, and its begin.
    zone: Option<(usize, usize, Place)>,
    /// Stretches before which a guard ends.
    landings: HashSet<usize>,
}

/// A guard in force.
struct Active {
    guard: Guard,
    /// The set of this guard and all before it.
    set: GuardSet,
    ends: Ends,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    /// Before a stretch of the routine being walked.
    Before(usize),
    /// With the routine being walked.
    WithRoutine,
    /// With the main routine.
    WithMain,
}

impl<'p> Walk<'p> {
    pub(super) fn new(program: &'p Program, layouts: &'p [Layout]) -> Self {
        let stretches: usize = layouts.iter().map(|layout| layout.stretches.len()).sum();
        Self {
            program,
            layouts,
            visited: vec![false; layouts.len()],
            open: vec![false; layouts.len()],
            allowance: SPARE + PER_STRETCH * stretches,
            spent: 0,
            cut_calls: HashSet::new(),
            diagnostics: Vec::new(),
        }
    }

    /// The visits of `roots`, one after the other, and of what they call.
    pub(super) fn order(&mut self, roots: &[usize]) -> Order {
        let mut order = Order::default();
        for &root in roots {
            if !self.walk(root, &mut order) {
                break;
            }
        }
        self.open.fill(false);
        self.spent += order.visits.len() + order.sets.len();
        order
    }

    /// The routines that no walk came to, and what was found.
    pub(super) fn finish(mut self) -> (Vec<usize>, Vec<Diagnostic>) {
        let unreachable: Vec<usize> = (0..self.visited.len())
            .filter(|&at| !self.visited[at])
            .filter(|&at| self.program.routines[at].role == Role::Called)
            .collect();
        for &at in &unreachable {
            let routine = &self.program.routines[at];
            let span = routine.rungs.first().map_or(routine.span, |rung| rung.span);
            self.diagnostics.push(
                Diagnostic::new(
                    codes::UNREACHABLE_RUNG,
                    span,
                    format!("the routine `{}` is never called", routine.name),
                )
                .help("call it, or remove it"),
            );
        }
        (unreachable, self.diagnostics)
    }

    /// Walks one main routine. The answer is `false` when the allowance is
    /// used up.
    fn walk(&mut self, root: usize, order: &mut Order) -> bool {
        let mut guards = Guards::default();
        let mut frames = vec![self.enter(root, 0)];
        while let Some(frame) = frames.last_mut() {
            let layout = &self.layouts[frame.routine];
            let Some(stretch) = layout.stretches.get(frame.next) else {
                self.open[frame.routine] = false;
                guards.leave_routine(frame.floor, order);
                frames.pop();
                continue;
            };
            let here = frame.next;
            frame.next += 1;
            if frame.landings.remove(&here) {
                guards.arrive(here, frame.floor, order);
            }
            if let Some(&(first, last, jump)) = layout.repeated.get(frame.repeated)
                && first == here
            {
                frame.repeated += 1;
                let rung = layout.stretches[last].rung;
                frame.landings.insert(last + 1);
                guards.add(
                    Guard::Repeated { rung, jump },
                    Ends::Before(last + 1),
                    order,
                );
            }
            if let Some((_, last, begin)) = frame.zone.take_if(|zone| zone.0 == here) {
                frame.landings.insert(last + 1);
                guards.add(Guard::Zone { begin }, Ends::Before(last + 1), order);
            }
            let visit = order.visits.len();
            order.visits.push(Visit {
                routine: frame.routine,
                rung: stretch.rung,
                elements: stretch.elements.clone(),
                guards: guards.set(),
            });
            let element = stretch.last();
            let by = Place { visit, element };
            let skips = Guard::Skipped {
                by,
                solved_when: false,
            };
            match stretch.steer {
                Some(Steer::Call(Some(routine))) if self.open[routine] => {
                    let caller = frame.routine;
                    if self.cut_calls.insert((caller, stretch.rung, element)) {
                        self.report_recursion(caller, stretch.rung, element);
                    }
                }
                Some(Steer::Call(Some(routine))) => {
                    let floor = guards.count();
                    let runs = Guard::Skipped {
                        by,
                        solved_when: true,
                    };
                    guards.add(runs, Ends::WithRoutine, order);
                    frames.push(self.enter(routine, floor));
                }
                Some(Steer::Jump(Some(to))) if to > here => {
                    frame.landings.insert(to);
                    guards.add(skips, Ends::Before(to), order);
                }
                Some(Steer::Return) => guards.add(skips, Ends::WithRoutine, order),
                Some(Steer::End) => guards.add(skips, Ends::WithMain, order),
                Some(Steer::ZoneBegin { first, last }) if first <= last => {
                    frame.zone = Some((first, last, by));
                }
                _ => {}
            }
            if self.spent + order.visits.len() + order.sets.len() > self.allowance {
                self.report_explosion(&frames);
                return false;
            }
        }
        true
    }

    fn enter(&mut self, routine: usize, floor: usize) -> Frame {
        self.visited[routine] = true;
        self.open[routine] = true;
        Frame {
            routine,
            next: 0,
            repeated: 0,
            floor,
            zone: None,
            landings: HashSet::new(),
        }
    }

    fn report_recursion(&mut self, routine: usize, rung: usize, call: NodeIndex) {
        let Some(rung) = self.program.routines[routine].rungs.get(rung) else {
            return;
        };
        let ElementKind::Call(call) = &rung.network.element(call).kind else {
            return;
        };
        let diagnostic = Diagnostic::new(
            codes::CALL_NOT_FOLLOWED,
            rung.place(call.routine.within),
            format!(
                "`{}` is being solved when this calls it again; the call is not followed",
                call.routine.name
            ),
        )
        .help("a scan has to end: remove the call, or make it a jump or a flag");
        self.diagnostics.push(diagnostic);
    }

    fn report_explosion(&mut self, frames: &[Frame]) {
        let routine = frames.last().map(|frame| frame.routine);
        let Some(routine) = routine.and_then(|at| self.program.routines.get(at)) else {
            return;
        };
        self.diagnostics.push(
            Diagnostic::new(
                codes::CALL_NOT_FOLLOWED,
                routine.span,
                format!(
                    "calls and jumps unfold into more than {} visits of rungs; from `{}` on they are not followed",
                    self.allowance, routine.name
                ),
            )
            .help("call each routine from fewer places"),
        );
    }
}

/// The guards in force, innermost last.
#[derive(Default)]
struct Guards {
    active: Vec<Active>,
}

impl Guards {
    fn count(&self) -> usize {
        self.active.len()
    }

    fn set(&self) -> GuardSet {
        self.active
            .last()
            .map_or(GuardSet::NONE, |active| active.set)
    }

    fn add(&mut self, guard: Guard, ends: Ends, order: &mut Order) {
        let set = order.extend(self.set(), guard);
        self.active.push(Active { guard, set, ends });
    }

    /// Drops the guards that end before stretch `here` of the routine whose
    /// guards begin at `floor`.
    fn arrive(&mut self, here: usize, floor: usize, order: &mut Order) {
        let ended = |active: &Active| active.ends == Ends::Before(here);
        let own = self.active.get(floor..).unwrap_or_default();
        if let Some(first) = own.iter().position(ended) {
            self.keep(floor + first, |active| !ended(active), order);
        }
    }

    /// Drops the guards of the routine whose guards begin at `floor`.
    fn leave_routine(&mut self, floor: usize, order: &mut Order) {
        self.keep(floor, |active| active.ends == Ends::WithMain, order);
    }

    /// Of the guards from `first` on keeps those that `stays` says, chained
    /// anew.
    fn keep(&mut self, first: usize, stays: impl Fn(&Active) -> bool, order: &mut Order) {
        let tail = self.active.split_off(first);
        for active in tail.into_iter().filter(stays) {
            self.add(active.guard, active.ends, order);
        }
    }
}
