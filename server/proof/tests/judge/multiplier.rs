//! Questions as hard as they come, for every engine.

use proof::{Gates, Netlist, Signal};

/// A multiplier, its factors exchanged or not. With enough bits nobody knows how
/// to prove the two equal.
pub fn multiplier(bits: usize, is_exchanged: bool) -> Netlist {
    let mut netlist = Netlist::default();
    let mut factor = |name: &str| -> Vec<Signal> {
        (0..bits)
            .map(|bit| netlist.input(format!("{name}{bit}")))
            .collect()
    };
    let mut factors = [factor("a"), factor("b")];
    if is_exchanged {
        factors.reverse();
    }
    let mut sum = vec![Signal::FALSE; 2 * bits];
    for (shift, &bit) in factors[0].iter().enumerate() {
        let mut carry = Signal::FALSE;
        for (at, &other) in factors[1].iter().enumerate() {
            let product = netlist.and(bit, other);
            let place = &mut sum[shift + at];
            let half = netlist.xor(*place, product);
            let carries = [netlist.and(*place, product), netlist.and(half, carry)];
            *place = netlist.xor(half, carry);
            carry = netlist.any(&carries);
        }
        sum[shift + bits] = carry;
    }
    for (at, bit) in sum.into_iter().enumerate() {
        let latch = netlist.delayed(format!("p{at}"), bit, false);
        netlist.output(format!("p{at}"), latch);
    }
    netlist
}
