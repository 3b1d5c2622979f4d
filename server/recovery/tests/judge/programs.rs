//! Random programs without timers, numbers and edges.
//!
//! A program is sketched first: rungs of contacts with parallel legs behind
//! them, and a coil or something that steers at the end of each leg. What its
//! contacts may look at is what makes one kind of program different from
//! another, so it is settled when the program is built.

use std::collections::BTreeSet;

use ladder::{
    Call, Coil, CoilKind, Contact, ContactKind, ElementKind, Format, Network, NetworkBuilder,
    Placed, Program, Role, Routine, Rung,
};
use proptest::prelude::*;
use proptest::sample::{Index, select};
use source::Span;

use crate::networks::{Shape, named};

pub const INPUTS: [&str; 4] = ["i0", "i1", "i2", "i3"];
pub const COILS: [&str; 4] = ["q0", "q1", "q2", "q3"];

/// What the contacts of a program may look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sight {
    /// Inputs; coils that nothing above writes; and on the way to a coil, that
    /// coil. So every contact sees a value from before the scan, or one that
    /// only the coil's own rungs, or the legs above on its rung, have changed.
    Before,
    /// Any input and coil.
    Anything,
}

/// A program before its contacts are settled.
#[derive(Clone, Debug)]
pub struct Sketch {
    main: Vec<RungSketch>,
    /// The rungs of a routine that is called once, and from where.
    called: Option<(Index, Guard, Vec<RungSketch>)>,
}

#[derive(Clone, Debug)]
struct RungSketch {
    common: Guard,
    legs: Vec<(Guard, End)>,
}

/// A series-parallel drawing of contacts.
#[derive(Clone, Debug)]
enum Guard {
    Contact { looks_at: Index, kind: ContactKind },
    Series(Vec<Guard>),
    Parallel(Vec<Guard>),
}

/// What stands at the end of a leg.
#[derive(Clone, Debug)]
enum End {
    /// A coil of the variable at this place of [`COILS`].
    Coil(usize, CoilKind),
    /// Goes on at a rung below.
    Jump(Index),
    /// Leaves the routine.
    Return,
    /// Begins or ends a zone under master control.
    Zone,
}

fn guard(size: u32) -> impl Strategy<Value = Guard> {
    let kinds = select(&[ContactKind::Open, ContactKind::Closed][..]);
    (any::<Index>(), kinds)
        .prop_map(|(looks_at, kind)| Guard::Contact { looks_at, kind })
        .prop_recursive(3, size, 3, |inner| {
            let parts = prop::collection::vec(inner, 0..4);
            prop_oneof![
                parts.clone().prop_map(Guard::Series),
                parts.prop_map(Guard::Parallel),
            ]
        })
}

fn coil() -> impl Strategy<Value = End> {
    use CoilKind::{Negated, Plain, Reset, Set};
    let kinds = select(&[Plain, Plain, Negated, Set, Reset][..]);
    (0..COILS.len(), kinds).prop_map(|(which, kind)| End::Coil(which, kind))
}

fn any_end() -> impl Strategy<Value = End> {
    prop_oneof![
        9 => coil(),
        1 => any::<Index>().prop_map(End::Jump),
        1 => Just(End::Return),
        1 => Just(End::Zone),
    ]
}

fn rung(end: impl Strategy<Value = End>, most_legs: usize) -> impl Strategy<Value = RungSketch> {
    let legs = prop::collection::vec((guard(3), end), 1..=most_legs);
    (guard(5), legs).prop_map(|(common, legs)| RungSketch { common, legs })
}

/// Rungs with one coil each.
pub fn plain() -> impl Strategy<Value = Sketch> {
    prop::collection::vec(rung(coil(), 1), 3..=8).prop_map(|main| Sketch { main, called: None })
}

/// Rungs with coils on several legs, jumps, returns, zones, and a call.
pub fn steering() -> impl Strategy<Value = Sketch> {
    let called = prop::collection::vec(rung(coil(), 2), 1..4);
    let call = prop::option::weighted(0.3, (any::<Index>(), guard(3), called));
    (prop::collection::vec(rung(any_end(), 3), 3..=8), call)
        .prop_map(|(main, called)| Sketch { main, called })
}

impl Sketch {
    /// The program, with `sight` settling what contacts look at.
    pub fn build(&self, sight: Sight) -> Program {
        let mut building = Building {
            sight,
            written: BTreeSet::new(),
        };
        let call_at = self
            .called
            .as_ref()
            .map(|(place, ..)| place.index(self.main.len()));
        let mut main = Vec::new();
        let mut called = Vec::new();
        for (at, sketch) in self.main.iter().enumerate() {
            if Some(at) == call_at
                && let Some((_, guard, rungs)) = &self.called
            {
                main.push(building.call(guard));
                called = rungs.iter().map(|rung| building.rung(rung, 0, 0)).collect();
            }
            main.push(building.rung(sketch, at, self.main.len()));
        }
        main.push(numbered(label(self.main.len()).finish()));
        let mut program = Program::empty(Format::Unknown);
        program.routines = vec![
            routine("Main", Role::Main, main),
            routine("Called", Role::Called, called),
        ];
        program
    }
}

fn routine(name: &str, role: Role, rungs: Vec<Rung>) -> Routine {
    Routine {
        scope: name.into(),
        unit: "Unit".into(),
        name: name.into(),
        role,
        rungs,
        span: Span::default(),
    }
}

fn numbered(drawn: Placed) -> Rung {
    Rung::new(0, None, drawn, Span::default())
}

/// The beginning of a rung that jumps may lead to.
fn label(at: usize) -> NetworkBuilder {
    let mut builder = NetworkBuilder::new(Span::default());
    let label = ElementKind::Label(named(&format!("L{at}")));
    builder.add_after(&[Network::rail()], label, Span::new(1, 2));
    builder
}

/// A program being built in the order of its scan.
struct Building {
    sight: Sight,
    /// Coils written so far.
    written: BTreeSet<usize>,
}

impl Building {
    /// What contacts may look at, `also` that coil.
    fn visible(&self, also: Option<usize>) -> Vec<&'static str> {
        let coils = (0..COILS.len()).filter(|at| {
            self.sight == Sight::Anything || !self.written.contains(at) || Some(*at) == also
        });
        let coils = coils.map(|at| COILS[at]);
        INPUTS.into_iter().chain(coils).collect()
    }

    fn call(&self, guard: &Guard) -> Rung {
        let mut builder = NetworkBuilder::new(Span::default());
        let rail = vec![Network::rail()];
        let ends = guard.shape(&self.visible(None)).draw(&mut builder, rail);
        let call = ElementKind::Call(Call {
            routine: named("Called"),
            arguments: Vec::new(),
        });
        builder.add_after(&ends, call, Span::default());
        numbered(builder.finish())
    }

    fn rung(&mut self, sketch: &RungSketch, at: usize, count: usize) -> Rung {
        let mut builder = label(at);
        let start = vec![petgraph::graph::NodeIndex::new(1)];
        let coil_of = |end: &End| match end {
            End::Coil(which, _) => Some(*which),
            _ => None,
        };
        let mut coils = sketch.legs.iter().map(|(_, end)| coil_of(end));
        let own = coils.next().flatten();
        let own = own.filter(|own| coils.all(|coil| coil == Some(*own)));
        let common = sketch.common.shape(&self.visible(own));
        let ends = common.draw(&mut builder, start);
        for (guard, end) in &sketch.legs {
            let coil = coil_of(end);
            let guard = guard.shape(&self.visible(coil));
            let ends = guard.draw(&mut builder, ends.clone());
            let end = match end {
                End::Coil(which, kind) => ElementKind::Coil(Coil {
                    operand: named(COILS[*which]),
                    kind: *kind,
                }),
                End::Jump(to) if at < count => {
                    let to = at + 1 + to.index(count - at);
                    ElementKind::Jump(named(&format!("L{to}")))
                }
                End::Jump(_) | End::Return => ElementKind::Return { program: false },
                End::Zone => ElementKind::Zone,
            };
            let place = builder.len();
            builder.add_after(&ends, end, Span::new(place, place + 1));
            self.written.extend(coil);
        }
        numbered(builder.finish())
    }
}

impl Guard {
    /// The drawing with every contact looking at one of `visible`.
    fn shape(&self, visible: &[&'static str]) -> Shape {
        let all = |parts: &[Self]| parts.iter().map(|part| part.shape(visible)).collect();
        match self {
            Self::Contact { looks_at, kind } => Shape::Element(ElementKind::Contact(Contact {
                operand: named(visible[looks_at.index(visible.len())]),
                kind: *kind,
            })),
            Self::Series(parts) => Shape::Series(all(parts)),
            Self::Parallel(legs) => Shape::Parallel(all(legs)),
        }
    }
}
