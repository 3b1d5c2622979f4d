//! The tank of the case study.

use std::collections::BTreeSet;

use recovery::successions::{Evidence, Sights};

use crate::{LEVELS, TANK, assert_told, counted, rules, seen, text};

/// The pairs that were seen in one scan.
fn at_once(sights: &Sights) -> BTreeSet<(String, String)> {
    let seen = sights.pairs.iter();
    let at_once = seen.filter(|(_, sight)| sight.at_once.is_some());
    at_once
        .map(|((from, to), _)| (from.to_string(), to.to_string()))
        .collect()
}

fn pairs(list: &[(&str, &str)]) -> BTreeSet<(String, String)> {
    let each = list.iter().flat_map(|(from, followers)| {
        let followers = followers.split(' ');
        followers.map(|to| ((*from).to_owned(), to.to_owned()))
    });
    each.collect()
}

#[test]
fn what_ends_in_the_scan_that_starts_another_is_what_an_exhaustive_search_found() {
    let analysis = seen(&text(TANK), &rules(LEVELS));
    let expected = pairs(&[
        ("h", "v1 v2 v3 v4"),
        ("m", "v1"),
        ("v1", "h m v2 v3 v4"),
        ("v2", "h m v1 v3 v4"),
        ("v3", "v1"),
        ("v4", "v1 v3"),
    ]);
    assert_eq!(at_once(analysis.sights().expect("seen")), expected);
}

#[test]
fn under_the_rules_of_its_plant_what_happens_comes_first() {
    let sequence = text("fixtures/neutralization/sequence.grafcet");
    let analysis = seen(&text(TANK), &rules(&sequence));
    let strong = analysis.successions().iter();
    let strong = strong.filter(|it| it.evidence < Evidence::Possible);
    assert_told(
        &counted(strong),
        "
        v1 -> v2  handover, and, in 3 scans
        v1 -> h  handover, and, in 3 scans
        v1 -> m  handover, and, in 3 scans
        v1 -> v4  handover, or, in 4 scans
        v2 -> v4  handover, or, in 4 scans
        v2 -> v3  handover, or, in 5 scans
        h -> v3  handover, or, in 5 scans
        v4 -> v3  handover, or, in 7 scans
        v3 -> v1  delayed, or, in 10 scans
        m -> v1  delayed, or, in 10 scans
        h -> v2  witnessed, or, in 3 scans, several at once
        h -> v4  witnessed, or, in 3 scans, several at once
        ",
    );
}

#[test]
fn a_handover_that_no_plant_shows_is_merely_possible() {
    // Nobody presses the start button while liquid leaves by v3, and v4 does not
    // drain below ls2.
    let sequence = text("fixtures/neutralization/sequence.grafcet");
    let analysis = seen(&text(TANK), &rules(&sequence));
    let of = |from: &str, to: &str| {
        let mut all = analysis.successions().iter();
        let found = all.find(|it| &*it.from == from && &*it.to == to);
        found.map(|it| it.evidence)
    };
    assert_eq!(of("v4", "v1"), Some(Evidence::Possible));
    assert_eq!(of("v4", "v3"), Some(Evidence::Handover));
}
