//! BLIF, the Berkeley logic interchange format, read by ABC, Yosys and SIS.
//!
//! BLIF knows no properties and no constraints. A netlist with properties is
//! written with these as its outputs: the question is whether one can be 1.
//! Constraints and free initial values are [built in](Netlist::plain) first.

use std::fmt::Write;

use rustc_hash::FxHashSet;

use crate::{Netlist, Signal};

/// The netlist as a model with this name.
pub fn text(netlist: &Netlist, model: &str) -> String {
    let netlist = &netlist.plain();
    let names = Names::of(netlist);
    let mut text = format!(".model {}\n", spelled(model));
    let leaves = netlist.inputs.iter().map(|input| input.signal.node());
    names.list(
        &mut text,
        ".inputs",
        leaves.map(|node| names.of_node[node].as_str()),
    );
    names.list(
        &mut text,
        ".outputs",
        names.shown.iter().map(String::as_str),
    );
    for (latch, next) in netlist.latches.iter().zip(&names.next) {
        let own = &names.of_node[latch.signal.node()];
        let initial = u8::from(latch.initial.value() == Some(true));
        let _ = writeln!(text, ".latch {next} {own} {initial}");
    }
    let _ = writeln!(text, ".names {}", names.of_node[0]);
    for node in 1..netlist.size() {
        if let Some([a, b]) = netlist.graph.gate(node) {
            let [left, right, out] = [a.node(), b.node(), node].map(|at| &names.of_node[at]);
            let [a, b] = [a, b].map(|side| u8::from(!side.is_complement()));
            let _ = writeln!(text, ".names {left} {right} {out}\n{a}{b} 1");
        }
    }
    let shown = netlist.shown().iter().map(|output| output.signal);
    let next = netlist.latches.iter().map(|latch| latch.next);
    let copies = shown.zip(&names.shown).chain(next.zip(&names.next));
    for (signal, name) in copies {
        names.copy(&mut text, signal, name);
    }
    text + ".end\n"
}

/// A name for every wire, each different.
struct Names {
    of_node: Vec<String>,
    /// The outputs.
    shown: Vec<String>,
    /// What each latch takes.
    next: Vec<String>,
}

impl Names {
    fn of(netlist: &Netlist) -> Self {
        let mut taken = FxHashSet::default();
        // Inputs and outputs are what two files are compared by: theirs come
        // first, and only the others give way.
        let mut of_node = vec![String::new(); netlist.size()];
        for input in &netlist.inputs {
            of_node[input.signal.node()] = unique(&input.name, &mut taken);
        }
        let shown = netlist.shown().iter();
        let shown = shown.map(|it| unique(&it.name, &mut taken)).collect();
        for latch in &netlist.latches {
            of_node[latch.signal.node()] = unique(&latch.name, &mut taken);
        }
        let latches = netlist.latches.iter();
        let next = latches
            .map(|it| unique(&format!("{}.next", it.name), &mut taken))
            .collect();
        for (node, name) in of_node.iter_mut().enumerate() {
            if name.is_empty() {
                *name = unique(&format!("n{node}"), &mut taken);
            }
        }
        Self {
            of_node,
            shown,
            next,
        }
    }

    fn list<'a>(&self, text: &mut String, key: &str, names: impl Iterator<Item = &'a str>) {
        text.push_str(key);
        for name in names {
            // A line ends soon, and goes on after a backslash.
            text.push_str(" \\\n  ");
            text.push_str(name);
        }
        text.push('\n');
    }

    /// A wire that is what `signal` is.
    fn copy(&self, text: &mut String, signal: Signal, name: &str) {
        let from = &self.of_node[signal.node()];
        let value = u8::from(!signal.is_complement());
        let _ = writeln!(text, ".names {from} {name}\n{value} 1");
    }
}

/// The name, spelled as BLIF can, and with a number if somebody else has it.
fn unique(name: &str, taken: &mut FxHashSet<String>) -> String {
    let plain = spelled(name);
    let mut name = plain.clone();
    let mut number = 1;
    while !taken.insert(name.clone()) {
        number += 1;
        name = format!("{plain}~{number}");
    }
    name
}

/// Blanks, comments, line ends and equals signs mean something in BLIF.
fn spelled(name: &str) -> String {
    let is_plain = |c: char| c.is_ascii_graphic() && !matches!(c, '#' | '\\' | '=' | '"');
    let letters = name.chars().map(|c| if is_plain(c) { c } else { '_' });
    let spelled: String = letters.collect();
    match spelled.starts_with('.') || spelled.is_empty() {
        true => format!("_{spelled}"),
        false => spelled,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gates;

    #[test]
    fn a_netlist_is_a_model() {
        let mut netlist = Netlist::default();
        let start = netlist.input("start now");
        let motor = netlist.latch("motor", true);
        let runs = netlist.or(start, motor);
        netlist.set_next(motor, runs);
        netlist.output("motor", runs);
        let expected = "\
.model seal_in
.inputs \\
  start_now
.outputs \\
  motor
.latch motor.next motor~2 1
.names n0
.names start_now motor~2 n3
00 1
.names n3 motor
0 1
.names n3 motor.next
0 1
.end
";
        assert_eq!(text(&netlist, "seal in"), expected);
    }
}
