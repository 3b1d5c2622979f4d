//! Properties over random networks and programs: power is what a search for
//! conducting paths finds, and the machine stands everything.

mod scan_rungs;

use std::collections::HashMap;
use std::sync::Arc;

use ladder::flow::{Guard, Order, Place, Visit, execution};
use ladder::scan::{Machine, power};
use ladder::{
    Coil, CoilKind, Contact, ContactKind, Edge, ElementKind, Gate, Network, NetworkBuilder,
    OneShot, Operand, Port, Program, Wire,
};
use logic::Atom;
use petgraph::graph::NodeIndex;
use proptest::prelude::*;
use scan_rungs::rungs;
use source::Span;

const NAMES: [&str; 6] = ["a", "b", "c", "d", "e", "f"];

fn operand() -> impl Strategy<Value = Operand> {
    prop::sample::select(&NAMES[..]).prop_map(|name| Operand::new(name, Span::default()))
}

fn contact(kinds: &'static [ContactKind]) -> impl Strategy<Value = ElementKind> {
    (operand(), prop::sample::select(kinds))
        .prop_map(|(operand, kind)| ElementKind::Contact(Contact { operand, kind }))
}

fn plain_contact() -> impl Strategy<Value = ElementKind> {
    contact(&[ContactKind::Open, ContactKind::Closed])
}

/// Anything that stands in a network, with edges, gates and coils.
fn any_element() -> impl Strategy<Value = ElementKind> {
    use ContactKind::{Closed, Falling, Open, Rising};
    let coil_kinds = [
        CoilKind::Plain,
        CoilKind::Negated,
        CoilKind::Set,
        CoilKind::Reset,
        CoilKind::Rising,
        CoilKind::Falling,
    ];
    let coil = (operand(), prop::sample::select(coil_kinds.to_vec()))
        .prop_map(|(operand, kind)| ElementKind::Coil(Coil { operand, kind }));
    let edges = prop::sample::select(vec![Edge::Rising, Edge::Falling]);
    let one_shot = (edges, prop::option::of(operand()))
        .prop_map(|(edge, memory)| ElementKind::OneShot(OneShot { edge, memory }));
    let gate =
        prop::sample::select(vec![Gate::And, Gate::Or, Gate::Xor]).prop_map(ElementKind::Gate);
    prop_oneof![
        4 => contact(&[Open, Closed, Rising, Falling]),
        2 => coil,
        1 => one_shot,
        1 => gate,
        1 => Just(ElementKind::Invert),
        1 => Just(ElementKind::Open),
    ]
}

/// A network as series-parallel drawings give it.
#[derive(Clone, Debug)]
enum Shape {
    Element(ElementKind),
    Series(Vec<Shape>),
    Parallel(Vec<Shape>),
}

fn shape() -> impl Strategy<Value = Shape> {
    plain_contact()
        .prop_map(Shape::Element)
        .prop_recursive(4, 24, 4, |inner| {
            let parts = prop::collection::vec(inner, 0..4);
            prop_oneof![
                parts.clone().prop_map(Shape::Series),
                parts.prop_map(Shape::Parallel),
            ]
        })
}

fn draw(shape: &Shape, builder: &mut NetworkBuilder, ends: Vec<NodeIndex>) -> Vec<NodeIndex> {
    match shape {
        Shape::Element(kind) => vec![builder.add_after(&ends, kind.clone(), Span::default())],
        Shape::Series(parts) => parts
            .iter()
            .fold(ends, |ends, part| draw(part, builder, ends)),
        Shape::Parallel(legs) => {
            let legs = legs.iter().map(|leg| draw(leg, builder, ends.clone()));
            legs.collect::<Vec<_>>().concat()
        }
    }
}

fn series_parallel() -> impl Strategy<Value = Arc<Network>> {
    shape().prop_map(|shape| {
        let mut builder = NetworkBuilder::new(Span::default());
        draw(&shape, &mut builder, vec![Network::rail()]);
        builder.finish().network
    })
}

/// Elements joined at random from earlier to later ones: bridges, contacts
/// without a source, several wires between the same two.
fn bridged(element: impl Strategy<Value = ElementKind>) -> impl Strategy<Value = Arc<Network>> {
    let sources = prop::collection::vec(any::<prop::sample::Index>(), 0..4);
    prop::collection::vec((element, sources), 0..16).prop_map(|elements| {
        let mut builder = NetworkBuilder::new(Span::default());
        for (kind, sources) in elements {
            let earlier = builder.len();
            let is_gate = matches!(kind, ElementKind::Gate(_));
            let element = builder.add(kind, Span::new(earlier, earlier + 1));
            for (number, source) in sources.iter().enumerate() {
                let to = match is_gate {
                    true => Port::Pin(format!("IN{}", number % 2).into()),
                    false => Port::Power,
                };
                let wire = Wire {
                    to,
                    negated: is_gate && number == 1,
                    ..Wire::default()
                };
                assert!(builder.join(NodeIndex::new(source.index(earlier)), element, wire));
            }
        }
        builder.finish().network
    })
}

fn values() -> impl Strategy<Value = HashMap<&'static str, bool>> {
    prop::collection::vec(any::<bool>(), NAMES.len())
        .prop_map(|bits| NAMES.into_iter().zip(bits).collect())
}

/// Whether a path of conducting contacts leads from the rail to an element,
/// found by walking back from it.
fn path_leads_to(network: &Network, at: NodeIndex, values: &HashMap<&str, bool>) -> bool {
    at == Network::rail()
        || network.arriving(at).iter().any(|(from, _)| {
            conducts(network, *from, values) && path_leads_to(network, *from, values)
        })
}

fn conducts(network: &Network, at: NodeIndex, values: &HashMap<&str, bool>) -> bool {
    match &network.element(at).kind {
        ElementKind::Contact(contact) => {
            let on = values[&*contact.operand.name];
            on == (contact.kind == ContactKind::Open)
        }
        _ => true,
    }
}

fn check_paths(network: &Network, values: &HashMap<&str, bool>) {
    let power = power(network, |atom| values[&*atom.to_string()]);
    for (at, _) in network.elements() {
        assert_eq!(power.at(at), path_leads_to(network, at, values), "{at:?}");
        let after = power.at(at) && conducts(network, at, values);
        assert_eq!(power.after(at), after, "{at:?}");
    }
}

/// A program of one routine whose rungs have these networks.
fn with_networks(networks: Vec<Arc<Network>>) -> Program {
    let lines = vec!["OTE(x)"; networks.len()].join("\n");
    let mut program = rungs(&lines);
    for (rung, network) in program.routines[0].rungs.iter_mut().zip(networks) {
        rung.network = network;
    }
    program
}

/// A rung that may steer, and that counts how often it is solved while it is
/// not switched off. `#` stands for the name of its count.
fn steering_rung() -> impl Strategy<Value = String> {
    let word = prop::sample::select(vec![
        "OTE(q)", "JMP(L0)", "JMP(L1)", "RET", "END", "MCR", "JSR(A)", "JSR(B)",
    ]);
    let label = prop::sample::select(vec!["", "", "", "LBL(L0) ", "LBL(L1) "]);
    let test = prop::sample::select(vec!["", "XIC(a) ", "XIO(a) ", "XIC(b) ", "XIO(b) "]);
    (label, test, word).prop_map(|(label, test, word)| format!("{label}[{test}{word}, INC(1,#)]"))
}

fn steering_program() -> impl Strategy<Value = String> {
    let routine = || prop::collection::vec(steering_rung(), 0..8);
    (routine(), routine(), routine()).prop_map(|(main, a, b)| {
        let section = |header: &str, rungs: &[String]| {
            let lines = rungs.iter().enumerate().map(|(number, rung)| {
                let count = format!("{}{number}", &header[header.len() - 1..]);
                format!("  {}\n", rung.replace('#', &count))
            });
            format!("{header}\n{}", lines.collect::<String>())
        };
        let text = [
            section("main M", &main),
            section("called A", &a),
            section("called B", &b),
        ];
        text.concat()
    })
}

/// How often each rung's count is solved with power in one scan, by the guards
/// of the visits alone: `(routine, rung)` and the number. Nothing where a jump
/// leads back.
fn counted_by_guards(
    program: &Program,
    order: &Order,
    values: &HashMap<&str, bool>,
) -> Option<HashMap<(usize, usize), i64>> {
    let network = |visit: &Visit| &program.routines[visit.routine].rungs[visit.rung].network;
    let mut live: Vec<bool> = Vec::new();
    let mut solved: Vec<bool> = Vec::new();
    let mut counts = HashMap::new();
    for visit in &order.visits {
        let powered = |by: Place| {
            let network = network(&order.visits[by.visit]);
            let power = power(network, |atom| values[&*atom.to_string()]);
            live[by.visit] && power.at(by.element)
        };
        let mut is_solved = true;
        let mut is_on = true;
        for guard in order.guards(visit.guards) {
            match guard {
                Guard::Skipped { by, solved_when } => is_solved &= powered(by) == solved_when,
                Guard::Zone { begin } => is_on &= powered(begin) || !solved[begin.visit],
                Guard::Repeated { .. } => return None,
            }
        }
        solved.push(is_solved);
        live.push(is_solved && is_on);
        let counts_here = visit.elements.clone().any(|at| {
            let element = network(visit).element(NodeIndex::new(at));
            matches!(element.kind, ElementKind::Assign(_))
        });
        if counts_here && is_solved && is_on {
            *counts.entry((visit.routine, visit.rung)).or_default() += 1;
        }
    }
    Some(counts)
}

proptest! {
    #[test]
    fn power_is_what_a_search_for_paths_finds(network in series_parallel(), values in values()) {
        check_paths(&network, &values);
    }

    #[test]
    fn power_finds_its_way_over_bridges(network in bridged(plain_contact()), values in values()) {
        check_paths(&network, &values);
    }

    #[test]
    fn the_machine_sees_the_power_that_the_judge_sees(
        network in bridged(plain_contact()),
        values in values(),
    ) {
        let judged = power(&network, |atom| values[&*atom.to_string()]);
        let mut builder = NetworkBuilder::new(Span::default());
        let mut coils = Vec::new();
        for (at, element) in network.elements().skip(1) {
            let sources: Vec<_> = network.arriving(at).iter().map(|(from, _)| *from).collect();
            builder.add_after(&sources, element.kind.clone(), Span::default());
            coils.push(at);
        }
        for at in &coils {
            let name = format!("out{}", at.index());
            let operand = Operand::new(name, Span::default());
            let coil = ElementKind::Coil(Coil { operand, kind: CoilKind::Plain });
            builder.add_after(&[*at], coil, Span::default());
        }
        let program = with_networks(vec![builder.finish().network]);
        let mut machine = Machine::new(&program);
        for (name, value) in &values {
            machine.set_input(name, *value);
        }
        machine.scan(10);
        for at in coils {
            prop_assert_eq!(machine.is_on(&format!("out{}", at.index())), judged.after(at));
        }
    }

    #[test]
    fn every_network_can_be_solved(
        networks in prop::collection::vec(bridged(any_element()), 1..4),
        inputs in prop::collection::vec(values(), 1..4),
    ) {
        for network in &networks {
            power(network, |atom| matches!(atom, Atom::Variable(name) if name.len() == 1));
        }
        let program = with_networks(networks);
        let mut machine = Machine::new(&program);
        for values in inputs {
            for (name, value) in values {
                machine.set_input(name, value);
            }
            machine.scan(25);
        }
        prop_assert!(!machine.overran());
    }

    #[test]
    fn the_machine_solves_what_the_guards_say(text in steering_program(), a: bool, b: bool) {
        let program = scan_rungs::program(&text);
        let order = execution(&program).scan;
        let values = HashMap::from([("a", a), ("b", b)]);
        let Some(counts) = counted_by_guards(&program, &order, &values) else {
            return Ok(());
        };
        let mut machine = Machine::new(&program);
        machine.set_input("a", a);
        machine.set_input("b", b);
        machine.scan(25);
        prop_assert!(!machine.overran());
        for (at, routine) in program.routines.iter().enumerate() {
            for rung in 0..routine.rungs.len() {
                let name = format!("{}{rung}", routine.name);
                let count = counts.get(&(at, rung)).copied().unwrap_or(0);
                prop_assert_eq!(machine.value(&name).integer(), count, "{}", name);
            }
        }
    }
}
