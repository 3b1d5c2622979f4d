use std::collections::{BTreeSet, HashMap};
use std::convert::Infallible;

use logic::Name;
use petgraph::graph::NodeIndex;

use super::power::{Flow, Power};
use super::solve::{Memory, Solving};
use super::state::State;
use super::timer::Clock;
use super::unknown::unknown;
use super::{Datum, Names, counter, timer};
use crate::flow::{Layout, Steer, layouts};
use crate::{ElementKind, Program, Role};

/// Stretches of rungs that a scan may solve beyond the program's own number.
const SPARE: usize = 20_000;
/// Stretches that a scan may solve for each one of the program: the watchdog.
const PER_STRETCH: usize = 64;

/// A controller that holds a program: its variables, its clock, its scans.
///
/// ```
/// use ladder::scan::Machine;
///
/// let drawing = "\
/// |  Start     Stop  Run
/// +--[ ]---+---[/]---( )--
/// |  Run   |
/// +--[ ]---+
/// ";
/// let reading = ladder::read(drawing.as_bytes());
/// let mut machine = Machine::new(&reading.program);
/// machine.set_input("Start", true);
/// machine.scan(10);
/// machine.set_input("Start", false);
/// machine.scan(10);
/// assert!(machine.is_on("Run"));
/// ```
#[derive(Clone, Debug)]
pub struct Machine<'p> {
    program: &'p Program,
    layouts: Vec<Layout>,
    /// The routines that are solved by themselves: the main ones, or all
    /// definitions where there is nothing else.
    roots: Vec<usize>,
    state: State,
    memories: HashMap<Memory, bool>,
    clock: Clock,
    first_scan: Name,
    scans: u64,
    overran: bool,
    unknown: BTreeSet<Name>,
}

/// A routine being solved.
struct Frame<'p> {
    routine: usize,
    next: usize,
    /// The zone that is switched off: its first and last stretch.
    off: Option<(usize, usize)>,
    /// The rung being solved, kept over a call in its middle.
    flow: Option<(usize, Flow<'p>)>,
}

impl<'p> Machine<'p> {
    /// A machine before its first scan: declared variables at their initial
    /// values, all others 0.
    pub fn new(program: &'p Program) -> Self {
        let Ok(machine) = Self::try_new(program, || Ok::<(), Infallible>(()));
        machine
    }

    /// The same, stopped by an error of `look`, which is called again and again
    /// meanwhile.
    pub fn try_new<E>(
        program: &'p Program,
        mut look: impl FnMut() -> Result<(), E>,
    ) -> Result<Self, E> {
        let mut state = State::new(program);
        let mut first_scan: Name = "S:FS".into();
        for (_, rung) in program.rungs() {
            look()?;
            for (_, element) in rung.network.elements() {
                match &element.kind {
                    ElementKind::Timer(of) => timer::prepare(of, &mut state),
                    ElementKind::Counter(of) => counter::prepare(of, &mut state),
                    ElementKind::Contact(contact)
                        if contact.operand.name.eq_ignore_ascii_case(&first_scan) =>
                    {
                        first_scan = contact.operand.name.clone();
                    }
                    _ => {}
                }
            }
        }
        let unknown = unknown(program, &state);
        look()?;
        let root_role = match program.is_only_definitions() {
            true => Role::Definition,
            false => Role::Main,
        };
        let roles = program.routines.iter().map(|routine| routine.role);
        let roots = roles.enumerate().filter(|(_, role)| *role == root_role);
        Ok(Self {
            roots: roots.map(|(at, _)| at).collect(),
            program,
            layouts: layouts(program).0,
            state,
            memories: HashMap::new(),
            clock: Clock::default(),
            first_scan,
            scans: 0,
            overran: false,
            unknown,
        })
    }

    /// Gives a variable a value between two scans. Any variable may be
    /// given one, not only inputs.
    pub fn set_input(&mut self, name: &str, value: impl Into<Datum>) {
        self.state.write(name, value.into());
    }

    /// Solves the program once, `elapsed_ms` milliseconds after the last scan
    /// began.
    pub fn scan(&mut self, elapsed_ms: u64) {
        self.scan_observed(elapsed_ms, &mut |_, _, _| {});
    }

    /// The same. `observe` is told of each rung, by its routine and its place
    /// there, what power was in it when it was solved; of a rung that a call
    /// interrupts, or that is solved several times, it is told again.
    pub fn scan_observed(
        &mut self,
        elapsed_ms: u64,
        observe: &mut dyn FnMut(usize, usize, &Power),
    ) {
        self.clock.now = self.clock.now.saturating_add(elapsed_ms);
        let first_scan = self.first_scan.clone();
        self.state.write(&first_scan, (self.scans == 0).into());
        self.overran = false;
        let stretches: usize = self.layouts.iter().map(|one| one.stretches.len()).sum();
        let mut watchdog = SPARE + PER_STRETCH * stretches;
        for root in self.roots.clone() {
            self.run(root, &mut watchdog, observe);
        }
        self.scans += 1;
    }

    /// The value of a variable; members of timers and counters answer to
    /// their IEC and Rockwell names, `Word.3` is a bit of `Word`.
    pub fn value(&self, name: &str) -> Datum {
        self.state.read(name)
    }

    /// The value of a variable, a constant or a term such as `a + 2`, if it can
    /// be computed.
    pub fn compute(&self, text: &str) -> Option<Datum> {
        self.state.compute(text)
    }

    /// What names mean to this machine.
    pub fn names(&self) -> &Names {
        self.state.names()
    }

    /// The values that are stored now, in no order: before the first scan the
    /// initial ones. All other variables are 0.
    pub fn stored(&self) -> impl Iterator<Item = (&Name, Datum)> {
        self.state.values()
    }

    /// The variable that is on in the first scan and off from then on.
    pub fn first_scan(&self) -> &Name {
        &self.first_scan
    }

    /// The routines that a scan solves by themselves, in their order, as places
    /// in [`Program::routines`].
    pub fn roots(&self) -> &[usize] {
        &self.roots
    }

    /// Whether all variables and the memories of all edges are as in `other`,
    /// an earlier moment of the same machine.
    pub fn is_as_in(&self, other: &Self) -> bool {
        self.memories == other.memories && self.state.is_same(&other.state)
    }

    /// Whether a variable is on.
    pub fn is_on(&self, name: &str) -> bool {
        self.value(name).is_on()
    }

    /// Number of scans so far.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// Names that the program expects something else to write, in order:
    /// outputs of boxes that are not modelled, terms that cannot be computed,
    /// presets that are not given. They are inputs of the machine.
    pub fn unknown(&self) -> impl Iterator<Item = &Name> {
        self.unknown.iter()
    }

    /// Whether the last scan was cut by the watchdog, since jumps or calls
    /// went round in it.
    pub fn overran(&self) -> bool {
        self.overran
    }

    fn run(
        &mut self,
        root: usize,
        watchdog: &mut usize,
        observe: &mut dyn FnMut(usize, usize, &Power),
    ) {
        let mut frames = vec![enter(root)];
        // Routines on the path of calls; one that calls itself is not followed.
        let mut open = vec![false; self.layouts.len()];
        open[root] = true;
        while let Some(frame) = frames.last_mut() {
            let layout = &self.layouts[frame.routine];
            let Some(stretch) = layout.stretches.get(frame.next) else {
                open[frame.routine] = false;
                frames.pop();
                continue;
            };
            let Some(left) = watchdog.checked_sub(1) else {
                self.overran = true;
                return;
            };
            *watchdog = left;
            let here = frame.next;
            frame.next += 1;
            let network = &self.program.routines[frame.routine].rungs[stretch.rung].network;
            let mut flow = match frame.flow.take() {
                Some((rung, flow)) if rung == stretch.rung && stretch.elements.start > 0 => flow,
                _ => Flow::new(network),
            };
            let mut circuit = Solving {
                routine: frame.routine,
                rung: stretch.rung,
                network,
                state: &mut self.state,
                memories: &mut self.memories,
                clock: &mut self.clock,
            };
            let is_off = frame
                .off
                .is_some_and(|(first, last)| first <= here && here <= last);
            for at in stretch.elements.clone().map(NodeIndex::new) {
                if is_off {
                    flow.solve_switched_off(at, &mut circuit);
                } else {
                    flow.solve(at, &mut circuit);
                }
            }
            observe(frame.routine, stretch.rung, flow.power());
            let power = flow.power().at(stretch.last());
            frame.flow = Some((stretch.rung, flow));
            match stretch.steer {
                Some(Steer::Call(Some(routine))) if power && !open[routine] => {
                    open[routine] = true;
                    frames.push(enter(routine));
                }
                Some(Steer::Jump(Some(to))) if power => frame.next = to,
                Some(Steer::Return) if power => frame.next = layout.stretches.len(),
                Some(Steer::End) if power => return,
                Some(Steer::ZoneBegin { first, last }) => {
                    frame.off = (!power).then_some((first, last));
                }
                _ => {}
            }
        }
    }
}

fn enter<'p>(routine: usize) -> Frame<'p> {
    Frame {
        routine,
        next: 0,
        off: None,
        flow: None,
    }
}
