use crate::bounded::{Bounded, Scan};
use crate::limits::Meter;
use crate::{Limits, Netlist, Why};

/// How many scans the constraints of `netlist` allow at most; `None` if they allow
/// sequences of more than `most`, or if the limits are reached before that is
/// known.
///
/// What is proved under constraints that allow nothing is worth nothing, so who
/// proves something should ask this too.
pub fn deadlock(netlist: &Netlist, most: usize, limits: &Limits) -> Result<Option<usize>, Why> {
    if netlist.constraints().is_empty() {
        return Ok(None);
    }
    let environment = netlist.cone(&[], &limits.cancel)?.netlist;
    let mut meter = Meter::new(limits, limits.steps);
    let mut bounded = Bounded::new(&environment);
    while bounded.clean < most {
        match bounded.advance(|_| true, &mut meter) {
            Ok(Scan::Forbidden) => return Ok(Some(bounded.clean)),
            Ok(_) => {}
            Err(Why::Cancelled) => return Err(Why::Cancelled),
            Err(_) => return Ok(None),
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gates;

    #[test]
    fn rules_that_contradict_each_other_allow_so_many_scans() {
        let mut netlist = Netlist::default();
        let a = netlist.input("a");
        let was = netlist.delayed("a before", a, false);
        let allowed = |netlist: &Netlist| deadlock(netlist, 10, &Limits::default());
        assert_eq!(allowed(&netlist), Ok(None));
        // From scan to scan it goes on and off.
        let changes = netlist.xor(a, was);
        netlist.constrain(changes);
        assert_eq!(allowed(&netlist), Ok(None));
        // And two scans before it was not on.
        let long_ago = netlist.delayed("a long before", was, false);
        let both = netlist.and(a, long_ago);
        netlist.constrain(!both);
        assert_eq!(allowed(&netlist), Ok(Some(2)));
    }
}
