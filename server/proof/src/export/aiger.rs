//! AIGER, the format of hardware model checkers (Biere, Heljanko, Wieringa:
//! AIGER 1.9 and beyond, 2011): ASCII (`aag`) and binary (`aig`).
//!
//! A netlist with properties is written as the question whether one of them can
//! be violated: bad states and invariant constraints. Without properties its
//! outputs are written. Names are in the symbol table.

use std::fmt::Write;

use rustc_hash::FxHashSet;

use crate::{Initial, Netlist, Signal};

/// The netlist as text.
pub fn ascii(netlist: &Netlist) -> String {
    let numbering = Numbering::of(netlist);
    let mut text = numbering.header(netlist, "aag");
    for input in &netlist.inputs {
        let _ = writeln!(text, "{}", numbering.literal(input.signal));
    }
    text += &numbering.latches(netlist, true);
    text += &numbering.roots(netlist);
    for &gate in &numbering.gates {
        let [out, left, right] = numbering.gate(netlist, gate);
        let _ = writeln!(text, "{out} {left} {right}");
    }
    text + &symbols(netlist)
}

/// The netlist in the binary form: gates are differences of numbers, seven bits
/// a byte.
pub fn binary(netlist: &Netlist) -> Vec<u8> {
    let numbering = Numbering::of(netlist);
    let mut text = numbering.header(netlist, "aig");
    text += &numbering.latches(netlist, false);
    text += &numbering.roots(netlist);
    let mut bytes = text.into_bytes();
    for &gate in &numbering.gates {
        let [out, left, right] = numbering.gate(netlist, gate);
        for mut difference in [out - left, left - right] {
            while difference > 0x7f {
                bytes.push(difference as u8 | 0x80);
                difference >>= 7;
            }
            bytes.push(difference as u8);
        }
    }
    bytes.extend(symbols(netlist).bytes());
    bytes
}

/// The variables of a file: inputs, latches, gates, each group in the
/// netlist's order, counted from 1; 0 is the constant.
struct Numbering {
    of_node: Vec<u32>,
    gates: Vec<usize>,
}

impl Numbering {
    fn of(netlist: &Netlist) -> Self {
        let nodes = 1..netlist.size();
        let gates: Vec<usize> = nodes
            .filter(|&node| netlist.graph.gate(node).is_some())
            .collect();
        let inputs = netlist.inputs.iter().map(|input| input.signal.node());
        let latches = netlist.latches.iter().map(|latch| latch.signal.node());
        let mut of_node = vec![0; netlist.size()];
        for (at, node) in inputs
            .chain(latches)
            .chain(gates.iter().copied())
            .enumerate()
        {
            of_node[node] = at as u32 + 1;
        }
        Self { of_node, gates }
    }

    fn literal(&self, signal: Signal) -> u32 {
        2 * self.of_node[signal.node()] + u32::from(signal.is_complement())
    }

    /// A gate and its two sides, the larger first.
    fn gate(&self, netlist: &Netlist, node: usize) -> [u32; 3] {
        let sides = netlist.graph.gate(node).unwrap_or([Signal::FALSE; 2]);
        let [a, b] = sides.map(|side| self.literal(side));
        [2 * self.of_node[node], a.max(b), a.min(b)]
    }

    fn header(&self, netlist: &Netlist, kind: &str) -> String {
        let (inputs, latches) = (netlist.inputs.len(), netlist.latches.len());
        let (outputs, bad) = match netlist.properties.len() {
            0 => (netlist.outputs.len(), 0),
            bad => (0, bad),
        };
        let gates = self.gates.len();
        let all = inputs + latches + gates;
        let mut header = format!("{kind} {all} {inputs} {latches} {outputs} {gates}");
        let constraints = netlist.constraints.len();
        if bad + constraints > 0 {
            let _ = write!(header, " {bad} {constraints}");
        }
        header + "\n"
    }

    fn latches(&self, netlist: &Netlist, is_named: bool) -> String {
        let mut text = String::new();
        for latch in &netlist.latches {
            let own = self.literal(latch.signal);
            if is_named {
                let _ = write!(text, "{own} ");
            }
            let _ = write!(text, "{}", self.literal(latch.next));
            let _ = match latch.initial {
                Initial::Zero => writeln!(text),
                Initial::One => writeln!(text, " 1"),
                Initial::Free => writeln!(text, " {own}"),
            };
        }
        text
    }

    fn roots(&self, netlist: &Netlist) -> String {
        let shown = netlist.shown().iter().map(|output| output.signal);
        let roots = shown.chain(netlist.constraints.iter().copied());
        roots.fold(String::new(), |mut text, root| {
            let _ = writeln!(text, "{}", self.literal(root));
            text
        })
    }
}

fn symbols(netlist: &Netlist) -> String {
    let shown = if netlist.properties.is_empty() {
        'o'
    } else {
        'b'
    };
    // Readers take two things of one name for one: inputs and outputs, by which
    // files are compared, keep theirs, and latches give way.
    let mut taken = FxHashSet::default();
    let mut unique = |name: &str| {
        let plain = name.replace(['\n', '\r'], " ");
        let mut name = plain.clone();
        let mut copies = 1;
        while !taken.insert(name.clone()) {
            copies += 1;
            name = format!("{plain}~{copies}");
        }
        name
    };
    let inputs: Vec<String> = netlist.inputs.iter().map(|it| unique(&it.name)).collect();
    let roots: Vec<String> = netlist.shown().iter().map(|it| unique(&it.name)).collect();
    let latches: Vec<String> = netlist.latches.iter().map(|it| unique(&it.name)).collect();
    let mut text = String::new();
    for (kind, names) in [('i', inputs), ('l', latches), (shown, roots)] {
        for (number, name) in names.iter().enumerate() {
            let _ = writeln!(text, "{kind}{number} {name}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::seal_in;

    #[test]
    fn a_netlist_is_written_as_text() {
        let expected = "aag 5 2 1 1 2\n2\n4\n6 10\n10\n8 7 3\n10 9 5\n\
                        i0 start\ni1 stop\nl0 motor~2\no0 motor\n";
        assert_eq!(ascii(&seal_in()), expected);
    }

    #[test]
    fn a_name_is_an_input_s_or_a_latch_s_once() {
        let mut netlist = Netlist::default();
        netlist.input("motor");
        netlist.latch("motor", false);
        netlist.latch("motor", false);
        assert_eq!(symbols(&netlist), "i0 motor\nl0 motor~2\nl1 motor~3\n");
    }

    #[test]
    fn the_binary_form_says_the_same_in_differences() {
        let expected =
            b"aig 5 2 1 1 2\n10\n10\n\x01\x04\x01\x04i0 start\ni1 stop\nl0 motor~2\no0 motor\n";
        assert_eq!(binary(&seal_in()), expected);
    }

    #[test]
    fn properties_are_bad_states_and_what_the_environment_keeps_is_said() {
        let mut netlist = seal_in();
        let start = netlist.input("start");
        let memory = netlist.latch("memory", Initial::Free);
        netlist.constrain(!start);
        netlist.never("runs", memory);
        let expected = "aag 6 2 2 0 2 1 1\n2\n4\n6 12\n8 8 8\n8\n3\n10 7 3\n12 11 5\n\
                        i0 start\ni1 stop\nl0 motor\nl1 memory\nb0 runs\n";
        assert_eq!(ascii(&netlist), expected);
    }
}
