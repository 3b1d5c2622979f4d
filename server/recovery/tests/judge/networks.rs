//! Random networks: everything that may stand on a rung, joined in every way
//! that a network allows.

use std::sync::Arc;

use ladder::{
    Block, Coil, CoilKind, Comparison, Contact, ContactKind, Counter, CounterKind, Edge,
    ElementKind, Familiarity, Gate, Network, NetworkBuilder, OneShot, Operand, Pin, PinDirection,
    Port, Timer, TimerKind, Wire,
};
use logic::Relation;
use petgraph::graph::NodeIndex;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use source::Span;

pub fn named(name: &str) -> Operand {
    Operand::new(name, Span::default())
}

fn operand(names: &'static [&'static str]) -> impl Strategy<Value = Operand> {
    select(names).prop_map(named)
}

pub fn contact(
    kinds: &'static [ContactKind],
    names: &'static [&'static str],
) -> impl Strategy<Value = ElementKind> {
    (operand(names), select(kinds))
        .prop_map(|(operand, kind)| ElementKind::Contact(Contact { operand, kind }))
}

fn edge() -> impl Strategy<Value = Edge> {
    select(&[Edge::Rising, Edge::Falling][..])
}

fn comparison() -> impl Strategy<Value = ElementKind> {
    use Relation::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
    let relation = select(&[Equal, NotEqual, Less, LessOrEqual, Greater, GreaterOrEqual][..]);
    let side = || operand(&["n", "5", "level"]);
    (side(), relation, side()).prop_map(|(left, relation, right)| {
        ElementKind::Comparison(Comparison {
            left,
            relation,
            right,
        })
    })
}

fn one_shot() -> impl Strategy<Value = ElementKind> {
    // Its memory may be a bit that contacts look at too.
    let memory = prop::option::of(operand(&["memory", "other memory", "a"]));
    (edge(), memory).prop_map(|(edge, memory)| ElementKind::OneShot(OneShot { edge, memory }))
}

fn timer() -> impl Strategy<Value = ElementKind> {
    use TimerKind::{OffDelay, OnDelay, Pulse, Retentive};
    select(&[OnDelay, OffDelay, Pulse, Retentive][..]).prop_map(|kind| {
        ElementKind::Timer(Timer {
            kind,
            instance: named("T"),
            output: "T.Q".into(),
            preset_ms: None,
            preset_from: None,
        })
    })
}

fn counter() -> impl Strategy<Value = ElementKind> {
    use CounterKind::{Circular, Down, Up, UpDown};
    select(&[Up, Down, UpDown, Circular][..]).prop_map(|kind| {
        ElementKind::Counter(Counter {
            kind,
            instance: named("C"),
            output: "C.DN".into(),
            preset: None,
            preset_from: None,
        })
    })
}

fn block() -> impl Strategy<Value = ElementKind> {
    let pin = (
        select(&[PinDirection::Input, PinDirection::Output][..]),
        prop::option::of(operand(&["a", "x"])),
    );
    let pin = pin.prop_map(|(direction, operand)| Pin {
        name: None,
        direction,
        operand,
    });
    (
        prop::option::of(operand(&["B"])),
        prop::collection::vec(pin, 0..3),
        select(&[Familiarity::Known, Familiarity::Unknown][..]),
        any::<bool>(),
    )
        .prop_map(|(instance, pins, familiarity, shapes_power)| {
            ElementKind::Block(Block {
                name: "LIM".into(),
                instance,
                pins,
                familiarity,
                shapes_power,
            })
        })
}

/// Anything that decides about power, or lets it pass.
fn element() -> impl Strategy<Value = ElementKind> {
    use ContactKind::{Closed, Falling, Open, Rising};
    let coil = (
        operand(&["a", "q"]),
        select(&[CoilKind::Plain, CoilKind::Set][..]),
    )
        .prop_map(|(operand, kind)| ElementKind::Coil(Coil { operand, kind }));
    prop_oneof![
        6 => contact(&[Open, Closed], &["a", "b", "c", "d"]),
        2 => contact(&[Rising, Falling], &["a", "b"]),
        1 => contact(&[Open, Closed], &["TRUE", "0"]),
        1 => coil,
        1 => comparison(),
        2 => one_shot(),
        2 => select(&[Gate::And, Gate::Or, Gate::Xor][..]).prop_map(ElementKind::Gate),
        1 => timer(),
        1 => counter(),
        2 => block(),
        2 => Just(ElementKind::Invert),
        1 => Just(ElementKind::Open),
    ]
}

/// A network as series-parallel drawings give it.
#[derive(Clone, Debug)]
pub enum Shape {
    Element(ElementKind),
    Series(Vec<Shape>),
    Parallel(Vec<Shape>),
}

impl Shape {
    /// Adds the shape behind `ends`; what is behind it now.
    pub fn draw(&self, builder: &mut NetworkBuilder, ends: Vec<NodeIndex>) -> Vec<NodeIndex> {
        match self {
            Self::Element(kind) => {
                let place = builder.len();
                vec![builder.add_after(&ends, kind.clone(), Span::new(place, place + 1))]
            }
            Self::Series(parts) => parts
                .iter()
                .fold(ends, |ends, part| part.draw(builder, ends)),
            Self::Parallel(legs) => legs
                .iter()
                .flat_map(|leg| leg.draw(builder, ends.clone()))
                .collect(),
        }
    }
}

/// A shape of at most `size` elements.
pub fn shape(
    element: impl Strategy<Value = ElementKind> + 'static,
    size: u32,
) -> impl Strategy<Value = Shape> {
    element
        .prop_map(Shape::Element)
        .prop_recursive(4, size, 4, |inner| {
            let parts = prop::collection::vec(inner, 0..4);
            prop_oneof![
                parts.clone().prop_map(Shape::Series),
                parts.prop_map(Shape::Parallel),
            ]
        })
}

/// Networks drawn as branches within branches.
pub fn drawn() -> impl Strategy<Value = Arc<Network>> {
    shape(element(), 16).prop_map(|shape| {
        let mut builder = NetworkBuilder::new(Span::default());
        shape.draw(&mut builder, vec![Network::rail()]);
        builder.finish().network
    })
}

/// A wire in the making: where it comes from, the ports to choose from at both
/// ends, whether it is negated, and an edge.
type Joint = (Index, Index, Index, bool, Option<Edge>);

fn joint() -> impl Strategy<Value = Joint> {
    let edge = prop::option::weighted(0.15, edge());
    let negated = prop::bool::weighted(0.2);
    (
        any::<Index>(),
        any::<Index>(),
        any::<Index>(),
        negated,
        edge,
    )
}

/// Networks of elements joined at random from earlier to later ones: bridges,
/// elements without a source, pins, negated and edge wires, several wires
/// between the same two.
pub fn wired() -> impl Strategy<Value = Arc<Network>> {
    let elements = (element(), prop::collection::vec(joint(), 0..4));
    prop::collection::vec(elements, 0..10).prop_map(|elements| {
        let mut builder = NetworkBuilder::new(Span::default());
        let mut kinds = vec![ElementKind::Rail];
        for (kind, joints) in elements {
            let place = builder.len();
            let at = builder.add(kind.clone(), Span::new(place, place + 1));
            for (from, leaves, arrives, negated, edge) in joints {
                let from = from.index(place);
                let wire = Wire {
                    from: port(outputs(&kinds[from]), leaves),
                    to: port(inputs(&kind), arrives),
                    negated,
                    edge,
                };
                assert!(builder.join(NodeIndex::new(from), at, wire));
            }
            kinds.push(kind);
        }
        builder.finish().network
    })
}

fn port(pins: &[&str], which: Index) -> Port {
    match pins[which.index(pins.len())] {
        "" => Port::Power,
        pin => Port::Pin(pin.into()),
    }
}

/// Output pins by name; the empty one is the power flow.
fn outputs(kind: &ElementKind) -> &'static [&'static str] {
    match kind {
        ElementKind::Timer(_) => &["", "Q", "TT"],
        ElementKind::Counter(_) => &["", "DN", "QU"],
        ElementKind::Block(_) => &["", "OUT", "ERR"],
        _ => &[""],
    }
}

/// Input pins by name; the empty one is the power flow.
fn inputs(kind: &ElementKind) -> &'static [&'static str] {
    match kind {
        ElementKind::Timer(_) => &["", "IN", "R"],
        ElementKind::Counter(_) => &["", "CU", "CD", "R"],
        ElementKind::Block(_) => &["", "EN", "X"],
        ElementKind::Gate(_) => &["IN1", "IN2", "IN3"],
        _ => &[""],
    }
}
