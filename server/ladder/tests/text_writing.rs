//! Writing programs as rung notation: what is read from the text is what was
//! written.

mod text;

use ladder::text::write;
use ladder::{
    Coil, CoilKind, Contact, ContactKind, ElementKind, Format, Network, NetworkBuilder, Operand,
    Placed, Program, Role, Routine, Rung,
};
use petgraph::graph::NodeIndex;
use source::Span;
use text::{drives_coil, fixture, program, said, without_marks};

/// Reads `text` and writes it; `expected` must come out, with nothing lost,
/// and hold the same program.
#[track_caller]
fn check(text: &str, expected: &str) {
    let read = program(text);
    let written = write(&read);
    assert_eq!(written.text, expected);
    assert_eq!(written.lost, []);
    assert_eq!(said(&program(&written.text)), said(&read));
}

/// The rung alone, written back.
#[track_caller]
fn same(rung: &str) {
    check(rung, &format!("{rung}\n"));
}

#[test]
fn a_rung_is_written_as_it_was_read() {
    same("rung \"Fill\": (s + v1) * /ls2 -> v1");
    same("rung: a * (b + /c*d + (e + f)*g) * rise(h) -> v");
    same("rung: (1 + a) * 0 -> v");
    same("rung: a * (level >= -3) * (\"the level\" < 5s) -> v");
    same("rung: a -> TON(t1, 1m30s), TOF(t2, delay), CTU(c1, 10), CTD(c2, \"how many\"), RTO(t3)");
    same("rung: 1 -> v, /w, set x, reset y, rising z, falling \"the door\"");
    same("rung: a -> x, (b -> y, (c + d -> /z), set z), reset x");
    same("rung label again: a -> jump again, call Doors(b, 3), return, return program, MCR()");
    same("rung: a -> TON(t1, 1m30s), TOF(t2), CTU(c1, 10), CTD(c2), RES(t1)");
    same("rung: a -> x := 5, x := x - 1, x := y, x := (y - 3) * z, PID(p, IN := a, Q => b, 3)");
    same("rung: a * b");
}

#[test]
fn edges_of_expressions_keep_their_gates() {
    same("rung: rise(a*b) * c -> v");
    same("rung: /rise(a) -> v");
    same("rung: fall(a + b) * /rise(c*d) -> v, (e -> w)");
}

#[test]
fn legs_share_the_contacts_before_them() {
    same("rung: a -> (b -> x), (c -> y, (d -> z)), w");
}

#[test]
fn the_fixtures_of_the_project_come_back_whole() {
    for name in ["neutralization/neutralization", "ladder/everything"] {
        let read = program(&without_marks(&fixture(&format!("{name}.ladder"))));
        let written = write(&read);
        assert_eq!(written.lost, [], "{name}");
        assert_eq!(
            said(&program(&written.text)),
            said(&read),
            "{}",
            written.text
        );
    }
}

/// Whatever format a fixture has: read, written and read again, every coil,
/// move, timer and counter gets power under the same conditions.
#[test]
fn every_output_of_every_fixture_keeps_its_condition() {
    let mut rungs = 0;
    for path in text::fixtures() {
        let bytes = std::fs::read(&path).expect("a readable file");
        let read = ladder::read(&bytes).program;
        let again = ladder::read(write(&read).text.as_bytes()).program;
        for ((_, before), (_, after)) in read.rungs().zip(again.rungs()) {
            // One shots of a single contact come back as edge contacts, whose
            // memory is another.
            let one_shot = |(_, element): (_, &ladder::Element)| {
                matches!(element.kind, ElementKind::OneShot(_))
            };
            if before.network.elements().any(one_shot) {
                continue;
            }
            rungs += 1;
            for seed in 0..16 {
                assert_eq!(
                    text::powered(&before.network, seed),
                    text::powered(&after.network, seed),
                    "rung {} of {}",
                    before.number,
                    path.display()
                );
            }
        }
    }
    assert!(rungs > 30, "only {rungs} rungs were compared");
}

/// A program with one rung.
fn with_rung(drawn: Placed) -> Program {
    let mut program = Program::empty(Format::Unknown);
    program.routines.push(Routine {
        scope: "P".into(),
        unit: "P".into(),
        name: "P".into(),
        role: Role::Main,
        rungs: vec![Rung::new(0, None, drawn, Span::default())],
        span: Span::default(),
    });
    program
}

fn contact(builder: &mut NetworkBuilder, feeds: &[NodeIndex], name: &str) -> NodeIndex {
    let contact = Contact {
        operand: Operand::new(name, Span::default()),
        kind: ContactKind::Open,
    };
    builder.add_after(feeds, ElementKind::Contact(contact), Span::default())
}

fn coil(builder: &mut NetworkBuilder, feeds: &[NodeIndex], name: &str) -> NodeIndex {
    let coil = Coil {
        operand: Operand::new(name, Span::default()),
        kind: CoilKind::Plain,
    };
    builder.add_after(feeds, ElementKind::Coil(coil), Span::default())
}

#[track_caller]
fn written(drawn: Placed) -> (String, Vec<String>) {
    let written = write(&with_rung(drawn));
    let rungs: Vec<_> = written.text.lines().skip(2).collect();
    let lost = written.lost.into_iter().map(|lost| lost.what).collect();
    (rungs.join("\n"), lost)
}

#[test]
fn contacts_behind_coils_become_legs() {
    let mut builder = NetworkBuilder::new(Span::default());
    let a = contact(&mut builder, &[Network::rail()], "a");
    let v = coil(&mut builder, &[a], "v");
    let b = contact(&mut builder, &[v], "b");
    coil(&mut builder, &[b], "w");
    let (text, lost) = written(builder.finish());
    assert_eq!((text.as_str(), lost.len()), ("rung: a -> v, (b -> w)", 0));
}

#[test]
fn a_bridge_between_legs_is_written_once_for_each_way_across() {
    // a leads to c and d, b to d alone.
    let mut builder = NetworkBuilder::new(Span::default());
    let a = contact(&mut builder, &[Network::rail()], "a");
    let b = contact(&mut builder, &[Network::rail()], "b");
    let c = contact(&mut builder, &[a], "c");
    let d = contact(&mut builder, &[a, b], "d");
    coil(&mut builder, &[c, d], "v");
    let (text, lost) = written(builder.finish());
    assert_eq!(
        (text.as_str(), lost.len()),
        ("rung: a*c + (a + b)*d -> v", 0)
    );
}

#[test]
fn what_the_order_of_legs_would_change_is_listed() {
    // b looks at v before v is written; in the text it would come after.
    let mut builder = NetworkBuilder::new(Span::default());
    let a = contact(&mut builder, &[Network::rail()], "a");
    let seen = contact(&mut builder, &[a], "v");
    coil(&mut builder, &[a], "v");
    coil(&mut builder, &[seen], "w");
    let (text, lost) = written(builder.finish());
    assert_eq!(text, "rung: a -> v, (v -> w)");
    assert_eq!(lost, ["at what moment of the scan `v` is looked at"]);
}

#[test]
fn a_rung_that_is_too_tangled_becomes_a_comment() {
    // Each contact is fed by all before it: a way for each choice of contacts.
    let mut builder = NetworkBuilder::new(Span::default());
    let mut all = vec![Network::rail()];
    for at in 0..40 {
        let next = contact(&mut builder, &all, &format!("a{at}"));
        all.push(next);
    }
    coil(&mut builder, &all, "v");
    let (text, lost) = written(builder.finish());
    assert!(text.starts_with("// rung"), "{text}");
    assert_eq!(
        lost,
        ["a rung whose legs are bridged too often to be written"]
    );
}

#[test]
fn a_network_may_nest_deeper_than_the_stack() {
    // Each contact is fed by the one before it, and the coil by all.
    let mut builder = NetworkBuilder::new(Span::default());
    let mut all = vec![Network::rail()];
    for _ in 0..50_000 {
        let last = all[all.len() - 1];
        all.push(contact(&mut builder, &[last], "a"));
    }
    coil(&mut builder, &all, "v");
    let (text, lost) = written(builder.finish());
    assert!(text.starts_with("// rung"), "{text}");
    assert_eq!(lost.len(), 1);
}

#[test]
fn a_long_series_of_contacts_and_coils_is_written_in_linear_time() {
    let mut builder = NetworkBuilder::new(Span::default());
    let mut last = Network::rail();
    for _ in 0..50_000 {
        last = contact(&mut builder, &[last], "a");
    }
    coil(&mut builder, &[last], "v");
    let (text, lost) = written(builder.finish());
    assert_eq!(text.matches("* a").count(), 49_999);
    assert_eq!(lost.len(), 0);
}

mod random {
    use proptest::prelude::*;

    use super::*;

    /// A network of contacts in which each is fed by any of the three before
    /// it, so that bridges are common, and one coil.
    fn networks() -> impl Strategy<Value = Placed> {
        let element = (0..4_usize, prop::collection::vec(0..4_usize, 1..3));
        prop::collection::vec(element, 1..8).prop_map(|elements| {
            let mut builder = NetworkBuilder::new(Span::default());
            let mut all = vec![Network::rail()];
            for (name, back) in elements {
                let mut feeds: Vec<_> = back
                    .iter()
                    .map(|back| all[all.len().saturating_sub(1 + back)])
                    .collect();
                feeds.sort_unstable();
                feeds.dedup();
                all.push(contact(&mut builder, &feeds, ["a", "b", "c", "d"][name]));
            }
            let last = [all[all.len() - 1], all[all.len() / 2]];
            coil(&mut builder, &last, "v");
            builder.finish()
        })
    }

    proptest! {
        #[test]
        fn the_text_powers_the_coil_exactly_when_the_network_does(drawn in networks()) {
            let (text, _) = written(drawn.clone());
            let read = program(&text);
            let (_, rung) = read.rungs().next().expect("a rung");
            for row in 0..16_u32 {
                let is_on = |name: &str| {
                    ["a", "b", "c", "d"].iter().position(|n| *n == name).is_some_and(|at| row >> at & 1 == 1)
                };
                prop_assert_eq!(
                    drives_coil(&rung.network, &is_on),
                    drives_coil(&drawn.network, &is_on),
                    "{} in row {}", text, row
                );
            }
        }
    }
}
