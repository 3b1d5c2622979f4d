//! The guards of all real rungs, built by two libraries of decision diagrams.

use bench::diagrams::{Circuits, Own, Peer, agree, build, circuits};
use bench::measure::{in_turn, time};
use bench::real::files;

use super::Row;

const ROUNDS: usize = 9;

/// Valuations under which every guard is compared.
const VALUATIONS: usize = 64;

/// One row, after every guard was found equal in both libraries.
///
/// # Panics
///
/// If a guard differs: then one of the libraries, or its use, is wrong, and no
/// time of it is worth knowing.
pub fn rows() -> Vec<Row> {
    let programs: Vec<Circuits> = ["l5x", "plcopen"]
        .into_iter()
        .flat_map(files)
        .map(|file| circuits(&ladder::read(&file.bytes).program))
        .collect();
    let variables = programs.iter().map(|program| program.variables).max();
    let Some(mut peer) = variables.and_then(Peer::new) else {
        return Vec::new();
    };
    let rungs = || programs.iter().flat_map(|program| &program.rungs);
    let guards = compared(rungs().map(|circuit| {
        let own = build(circuit, &mut Own::default());
        (own, build(circuit, &mut peer))
    }));
    let mut ours = || {
        time(|| {
            let mut library = Own::default();
            let built: Vec<_> = rungs()
                .map(|circuit| build(circuit, &mut library))
                .collect();
            built
        })
    };
    let mut theirs = || {
        peer.forget();
        time(|| {
            let built: Vec<_> = rungs().map(|circuit| build(circuit, &mut peer)).collect();
            built
        })
    };
    match in_turn(ROUNDS, &mut [&mut ours, &mut theirs])[..] {
        [ours, theirs] => vec![Row::times(
            format!("building {guards} guards of the corpus"),
            "OxiDD",
            (ours, theirs),
            None,
        )],
        _ => Vec::new(),
    }
}

type Built = (
    Option<Vec<logic::Function>>,
    Option<Vec<oxidd::bdd::BDDFunction>>,
);

/// Number of guards, all equal in both libraries.
fn compared(rungs: impl Iterator<Item = Built>) -> usize {
    let valuations = valuations();
    let mut guards = 0;
    for (own, peer) in rungs {
        let (Some(own), Some(peer)) = (own, peer) else {
            panic!("a guard of the corpus does not fit into the budget");
        };
        assert_eq!(own.len(), peer.len());
        for (own, peer) in own.iter().zip(&peer) {
            assert!(agree(own, peer, &valuations), "the libraries differ");
            guards += 1;
        }
    }
    guards
}

/// Words of random bits, the same on every run (SplitMix64).
fn valuations() -> Vec<u64> {
    let mut state = 0_u64;
    std::iter::repeat_with(|| {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    })
    .take(VALUATIONS)
    .collect()
}
