use logic::Name;
use rustc_hash::FxHashMap;

use crate::{Gates, Netlist, Signal};

/// Two netlists side by side on the same inputs.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Both netlists. Inputs are shared by name; the latches and outputs of
    /// each are called `left.NAME` and `right.NAME`. For every output that
    /// both have there is a property with the output's name: that the two
    /// differ. What constrains one of them constrains both, and properties of
    /// their own are kept.
    pub netlist: Netlist,
    /// Outputs that only the left one has, and that are compared with nothing.
    pub only_left: Vec<Name>,
    /// The same of the right one.
    pub only_right: Vec<Name>,
}

/// Puts two netlists side by side and compares their outputs by name.
///
/// The two are equivalent exactly when no property of the comparison can be
/// violated; [`crate::check`] finds out. Properties stand in the order of the
/// left one's outputs.
pub fn compare(left: &Netlist, right: &Netlist) -> Comparison {
    let mut netlist = Netlist::default();
    let placed = [
        netlist.include(left, "left."),
        netlist.include(right, "right."),
    ];
    let signals = |side: &Netlist, at: usize| -> Vec<(Name, Signal)> {
        let outputs = side.outputs.iter();
        outputs
            .map(|output| (output.name.clone(), placed[at].of(output.signal)))
            .collect()
    };
    let [ours, theirs] = [signals(left, 0), signals(right, 1)];
    for (side, outputs) in [("left", &ours), ("right", &theirs)] {
        for (name, signal) in outputs {
            netlist.output(format!("{side}.{name}"), *signal);
        }
    }
    let right_by_name: FxHashMap<&Name, Signal> = theirs
        .iter()
        .map(|(name, signal)| (name, *signal))
        .collect();
    let left_by_name: FxHashMap<&Name, Signal> =
        ours.iter().map(|(name, signal)| (name, *signal)).collect();
    let mut only_left = Vec::new();
    for (name, signal) in &ours {
        match right_by_name.get(name) {
            Some(&other) => {
                let differ = netlist.xor(*signal, other);
                netlist.never(name.clone(), differ);
            }
            None => only_left.push(name.clone()),
        }
    }
    let names = theirs.iter().map(|(name, _)| name);
    let only_right = names
        .filter(|name| !left_by_name.contains_key(name))
        .cloned()
        .collect();
    Comparison {
        netlist,
        only_left,
        only_right,
    }
}
