use std::convert::Infallible;

use logic::Name;

use crate::Netlist;
use crate::lanes::{Lanes, WORDS, bit};

/// A sequence of inputs, scan by scan, and where it starts from.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Trace {
    /// What each latch holds before the first scan, in the netlist's order.
    /// Only those of [free](crate::Initial::Free) latches are looked at;
    /// missing ones are 0.
    pub initial: Vec<bool>,
    /// The inputs of each scan, in the netlist's order; missing ones are 0.
    pub inputs: Vec<Vec<bool>>,
}

impl Trace {
    /// Number of scans.
    pub fn scans(&self) -> usize {
        self.inputs.len()
    }
}

/// What a netlist does on a trace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Replay {
    /// The outputs in each scan, in the netlist's order.
    pub outputs: Vec<Vec<bool>>,
    /// The latches in each scan, as the scan found them.
    pub latches: Vec<Vec<bool>>,
    /// The first scan, counted from 0, in which a constraint does not hold: what
    /// the trace says from there on cannot happen.
    pub forbidden: Option<usize>,
    /// The first scan in which a property is violated while every constraint
    /// has held, and the properties violated there.
    pub violation: Option<(usize, Vec<Name>)>,
}

/// Runs the netlist on a trace. The one judge of traces: what an engine finds
/// is told only after it was seen here.
pub fn replay(netlist: &Netlist, trace: &Trace) -> Replay {
    let mut replay = Replay::default();
    let Ok(()) = run(netlist, trace, |scan, lanes| {
        let value = |signal| bit(&lanes.value(signal), 0);
        let outputs = netlist.outputs.iter();
        let outputs = outputs.map(|output| value(output.signal));
        replay.outputs.push(outputs.collect());
        let latches = netlist.latches.iter().map(|latch| value(latch.signal));
        replay.latches.push(latches.collect());
        if replay.forbidden.is_none() && !bit(&lanes.allowed(), 0) {
            replay.forbidden = Some(scan);
        }
        if replay.forbidden.is_none() && replay.violation.is_none() {
            let violated = violated(netlist, lanes);
            replay.violation = (!violated.is_empty()).then_some((scan, violated));
        }
        Ok::<_, Infallible>(true)
    });
    replay
}

/// The first scan of a trace in which a property is violated, and the properties
/// violated there; `None` if there is none before a scan that the constraints
/// forbid. `look` is asked before every scan whether to go on.
pub fn violation<E>(
    netlist: &Netlist,
    trace: &Trace,
    mut look: impl FnMut() -> Result<(), E>,
) -> Result<Option<(usize, Vec<Name>)>, E> {
    let mut found = None;
    run(netlist, trace, |scan, lanes| {
        look()?;
        let is_allowed = bit(&lanes.allowed(), 0);
        let violated = violated(netlist, lanes);
        if is_allowed && !violated.is_empty() {
            found = Some((scan, violated));
        }
        Ok(is_allowed && found.is_none())
    })?;
    Ok(found)
}

/// Shows each scan of a trace when it is computed, as long as more are wanted.
fn run<E>(
    netlist: &Netlist,
    trace: &Trace,
    mut show: impl FnMut(usize, &Lanes<'_>) -> Result<bool, E>,
) -> Result<(), E> {
    let spread = |value: bool| [0_u64.wrapping_sub(value.into()); WORDS];
    let values = trace.initial.iter().copied();
    let latches = netlist
        .latches
        .iter()
        .zip(values.chain(std::iter::repeat(false)));
    let mut initial = latches
        .filter(|(latch, _)| latch.initial.value().is_none())
        .map(|(_, value)| spread(value));
    let mut lanes = Lanes::new(netlist, || initial.next().unwrap_or_default());
    for (scan, values) in trace.inputs.iter().enumerate() {
        let values = values.iter().copied().chain(std::iter::repeat(false));
        for (input, value) in netlist.inputs.iter().zip(values) {
            lanes.set(input.signal, spread(value));
        }
        lanes.solve();
        if !show(scan, &lanes)? {
            break;
        }
        lanes.advance();
    }
    Ok(())
}

/// The properties that are violated in a scan.
fn violated(netlist: &Netlist, lanes: &Lanes<'_>) -> Vec<Name> {
    let properties = netlist.properties.iter();
    properties
        .filter(|property| bit(&lanes.value(property.signal), 0))
        .map(|property| property.name.clone())
        .collect()
}

/// Which properties are violated in the last scan of a trace that the
/// constraints allow; none of one that they forbid.
pub(crate) fn violated_at_end(netlist: &Netlist, trace: &Trace) -> Vec<bool> {
    let mut judge = netlist.clone();
    let properties = std::mem::take(&mut judge.properties);
    let outputs = judge.outputs.len();
    judge.outputs.extend(properties);
    let mut seen = replay(&judge, trace);
    let end = seen.outputs.pop().filter(|_| seen.forbidden.is_none());
    let none = vec![false; judge.outputs.len()];
    end.unwrap_or(none).split_off(outputs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gates;
    use crate::tests::seal_in;

    #[test]
    fn a_latch_shows_what_the_scan_before_computed() {
        let mut netlist = seal_in();
        let [start, stop] = ["start", "stop"].map(|name| netlist.input(name));
        let motor = netlist.latches()[0].signal;
        let both = netlist.and(start, stop);
        netlist.constrain(!both);
        netlist.never("runs by itself", motor);

        let row = |text: &str| text.chars().map(|c| c == '1').collect::<Vec<bool>>();
        let trace = Trace {
            initial: Vec::new(),
            inputs: ["00", "10", "00", "01", "11"].map(row).to_vec(),
        };
        let seen = replay(&netlist, &trace);
        assert_eq!(seen.outputs, ["0", "1", "1", "0", "0"].map(row));
        assert_eq!(seen.latches, ["0", "0", "1", "1", "0"].map(row));
        assert_eq!(seen.forbidden, Some(4));
        let expected = Some((2, vec!["runs by itself".into()]));
        assert_eq!(seen.violation, expected);
        assert_eq!(
            violation(&netlist, &trace, || Ok::<_, ()>(())),
            Ok(expected)
        );
        assert_eq!(violation(&netlist, &trace, || Err("stop")), Err("stop"));
    }
}
