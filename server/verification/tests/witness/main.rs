//! Which state can be seen to begin after which.

mod judge;
mod ladders;
mod paper;
mod real;
mod tank;

use std::sync::Arc;

use grafcet::EnvironmentRule;
use logic::Budget;
use proof::Limits;
use recovery::successions::Succession;
use recovery::{Analysis, analyse};
use verification::witness::sights;

/// The case study.
pub const TANK: &str = "fixtures/neutralization/neutralization.ladder";

/// A plant in which levels do not overtake each other.
pub const LEVELS: &str = "Environment:\ne1: ls3 |- ls2\ne2: ls2 |- ls1\n";

/// A text of the repository.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(end_to_end::path(path)).expect("a readable fixture")
}

/// The environment rules in a text.
pub fn rules(text: &str) -> Vec<EnvironmentRule> {
    grafcet::read(text).spec.environment
}

/// A ladder, with all that can be seen of it in plants that obey these rules.
#[track_caller]
pub fn seen(ladder: &str, environment: &[EnvironmentRule]) -> Analysis {
    let program = ladder::read(ladder.as_bytes()).program;
    let analysis = analyse(&Arc::clone(&program), &Budget::default());
    let sights = sights(&analysis, environment, &Limits::default()).expect("a translation");
    assert!(sights.is_whole);
    analysis.seeing(sights)
}

/// `v1 -> v2  handover, and, in 3 scans`, a line for each.
pub fn counted<'s>(list: impl Iterator<Item = &'s Succession>) -> String {
    let lines = list.map(|it| {
        let scans = it.witness.as_ref().map(|it| {
            let manner = if it.is_calm { "" } else { ", several at once" };
            format!(", in {} scans{manner}", it.scans())
        });
        let (evidence, kind) = (it.evidence.word(), it.kind.word());
        let scans = scans.unwrap_or_default();
        format!("{} -> {}  {evidence}, {kind}{scans}\n", it.from, it.to)
    });
    lines.collect()
}

/// `v1 -> v2  handover: on ls1; on s; on ls2`, a line for each.
pub fn told<'s>(list: impl Iterator<Item = &'s Succession>) -> String {
    let lines = list.map(|it| {
        let words = it.witness.as_ref().map(|it| it.in_words());
        let words = words.unwrap_or_default();
        format!(
            "{} -> {}  {}: {words}\n",
            it.from,
            it.to,
            it.evidence.word()
        )
    });
    lines.collect()
}

/// Compares line by line, whatever the indentation of what is expected.
#[track_caller]
pub fn assert_told(found: &str, expected: &str) {
    let lines = |text: &str| -> Vec<String> {
        let lines = text.lines().map(|line| line.trim().to_owned());
        lines.filter(|line| !line.is_empty()).collect()
    };
    assert_eq!(lines(found), lines(expected), "found:\n{found}");
}
