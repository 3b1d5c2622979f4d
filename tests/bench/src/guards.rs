//! The guards of many rungs in both libraries: which they build, and that what
//! they build is the same.

use logic::{AtomId, Function, Literal};
use oxidd::BooleanFunction;
use oxidd::bdd::BDDFunction;

use crate::circuit::{Circuit, circuits};
use crate::diagrams::{Own, Peer, build};
use crate::real::files;

/// What both libraries make of the guards of many rungs.
pub struct Guards {
    /// The rungs of which both build every guard, for both to be measured on.
    pub rungs: Vec<Circuit>,
    /// Number of guards in all rungs, the others included.
    pub all: usize,
    /// Guards that Gradus refused.
    pub refused: usize,
    /// Guards that the peer refused.
    pub refused_by_peer: usize,
    /// Nodes of the guards in `rungs`, those of each counted by itself.
    pub nodes: usize,
    /// Nodes of the same guards in the peer, where they share them.
    pub nodes_of_peer: usize,
    /// The peer, with as many variables as the rungs have and nothing built.
    pub peer: Peer,
}

impl Guards {
    /// Number of guards in [`rungs`](Self::rungs).
    pub fn measured(&self) -> usize {
        self.rungs.iter().map(|rung| rung.guards.len()).sum()
    }
}

/// The guards of all real files; `None` where there are none.
///
/// # Panics
///
/// As [`guards`] does.
pub fn of_corpus() -> Option<Guards> {
    let programs = ["l5x", "plcopen"]
        .into_iter()
        .flat_map(files)
        .map(|file| circuits(&ladder::read(&file.bytes).program));
    let mut rungs = Vec::new();
    let mut variables = 0;
    // Each program counts its variables from 0: what they share helps the
    // peer, which keeps all in one place.
    for program in programs {
        variables = variables.max(program.variables);
        rungs.extend(program.rungs);
    }
    if rungs.is_empty() {
        return None;
    }
    guards(rungs, variables, Own::default())
}

/// The guards of `rungs` over so many `variables`; `None` if there is no
/// memory for the peer.
///
/// # Panics
///
/// If a guard differs: then one of the libraries, or its use, is wrong, and no
/// time of it is worth knowing. If the peer has no room for all guards at once
/// that it builds one by one, for the same reason.
pub fn guards(rungs: Vec<Circuit>, variables: u32, own: Own) -> Option<Guards> {
    let mut guards = Guards {
        rungs: Vec::with_capacity(rungs.len()),
        all: 0,
        refused: 0,
        refused_by_peer: 0,
        nodes: 0,
        nodes_of_peer: 0,
        peer: Peer::new(variables)?,
    };
    for rung in rungs {
        let ours = build(&rung, &own);
        let theirs = build(&rung, &guards.peer);
        let mut both = true;
        guards.all += ours.len();
        for pair in ours.iter().zip(&theirs) {
            guards.refused += usize::from(pair.0.is_none());
            guards.refused_by_peer += usize::from(pair.1.is_none());
            match pair {
                (Some(ours), Some(theirs)) => {
                    assert!(agree(ours, theirs), "the libraries differ");
                }
                _ => both = false,
            }
        }
        if both {
            guards.nodes += ours.iter().flatten().map(Function::nodes).sum::<usize>();
            guards.rungs.push(rung);
        } else {
            // What it built before it refused would leave no room.
            drop(theirs);
            guards.peer.forget();
        }
    }
    guards.peer.forget();
    let rungs = guards.rungs.iter();
    let held: Vec<_> = rungs.flat_map(|it| build(it, &guards.peer)).collect();
    assert!(held.iter().all(Option::is_some), "the peer has no room");
    guards.peer.forget();
    guards.nodes_of_peer = guards.peer.nodes();
    drop(held);
    guards.peer.forget();
    Some(guards)
}

/// Random valuations under which every guard is compared.
const VALUATIONS: u64 = 64;

/// Paths to 1 and to 0 along which every guard is compared: a guard of many
/// contacts in series is 0 under nearly every random valuation.
const PATHS: u64 = 16;

/// Whether both libraries hold the same function, as far as that is tried:
/// equally many nodes, as two canonical diagrams in one order have, and the
/// same value under random valuations and along the first paths.
pub fn agree(own: &Function, peer: &BDDFunction) -> bool {
    use oxidd::Function as _;
    // A constant has one terminal, or the terminal zero beside the one.
    let nodes = match own.is_true() || own.is_false() {
        true => 1,
        false => own.nodes(),
    };
    let under = |valuation: &dyn Fn(AtomId) -> bool| {
        let support = own.support().iter();
        peer.eval(support.map(|atom| (number(*atom), valuation(*atom))))
    };
    let random = |seed| {
        let valuation = |atom| value(seed, atom);
        own.evaluate(valuation) == under(&valuation)
    };
    let along = |function: &Function, value_there| {
        let mut paths = function.paths().zip(0..PATHS);
        paths.all(|(path, seed)| under(&|atom| on(&path, seed, atom)) == value_there)
    };
    nodes == peer.node_count()
        && (0..VALUATIONS).all(random)
        && along(own, true)
        && along(&own.not(), false)
}

/// The value of an atom on a path, which leaves some open.
/// The number under which the peer knows an atom.
fn number(atom: AtomId) -> u32 {
    u32::try_from(atom.0).unwrap_or(u32::MAX)
}

fn on(path: &[Literal], seed: u64, atom: AtomId) -> bool {
    let literal = path.iter().find(|literal| literal.atom == atom);
    literal.map_or_else(|| value(seed, atom), |literal| literal.positive)
}

/// The value of an atom under a random valuation, the same on every run.
fn value(seed: u64, atom: AtomId) -> bool {
    mixed(mixed(seed) ^ atom.0) >> 63 == 1
}

/// A step of SplitMix64: each bit of the state decides about half of the bits.
fn mixed(state: u64) -> u64 {
    let state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let state = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let state = (state ^ (state >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    state ^ (state >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_text(text: &str, nodes: usize) -> Guards {
        let found = circuits(&ladder::read(text.as_bytes()).program);
        let mut own = Own::default();
        own.budget.nodes = nodes;
        guards(found.rungs, found.variables, own).expect("memory")
    }

    #[test]
    fn both_libraries_build_the_same() {
        let text = crate::pair::pair(12) + "rung: a */a -> never\nrung: 1 -> always, x\n";
        let guards = of_text(&text, 20_000);
        assert_eq!((guards.all, guards.measured()), (5, 5));
        assert_eq!((guards.refused, guards.refused_by_peer), (0, 0));
    }

    #[test]
    fn what_one_refuses_is_counted_and_not_measured() {
        let text = "rung: a -> x\nrung: (a + b)*(c + d)*(e + f) -> y, set z\n";
        let guards = of_text(text, 4);
        assert_eq!((guards.all, guards.measured()), (3, 1));
        assert_eq!((guards.refused, guards.refused_by_peer), (2, 0));
    }

    #[test]
    fn functions_that_differ_do_not_agree() {
        let found = circuits(&ladder::read(b"rung: a * b -> x\nrung: a * /b -> y").program);
        let peer = Peer::new(found.variables).expect("memory");
        let ours = found.rungs.iter().flat_map(|it| build(it, &Own::default()));
        let theirs = found.rungs.iter().flat_map(|it| build(it, &peer));
        let (ours, theirs): (Vec<_>, Vec<_>) = (
            ours.flatten().collect::<Vec<_>>(),
            theirs.flatten().collect::<Vec<_>>(),
        );
        let agreeing = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(a, b)| agree(&ours[a], &theirs[b]));
        assert_eq!(agreeing, [true, false, false, true]);
    }

    #[test]
    fn variables_far_apart_have_values_of_their_own() {
        for (a, b) in [(0, 64), (1, 129), (5, 5 + 64 * 7), (0, 1)] {
            let differ = |seed: &u64| value(*seed, AtomId(a)) != value(*seed, AtomId(b));
            let count = (0..VALUATIONS).filter(differ).count();
            assert!((16..=48).contains(&count), "{a} and {b}: {count} of 64");
        }
    }
}
