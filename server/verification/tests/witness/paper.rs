//! What is suggested, against what happens in tables 2 to 4 of the paper.

use std::collections::BTreeSet;

use ladder::scan::Machine;
use logic::{Budget, Name};
use recovery::Analysis;
use recovery::successions::{Succession, possible};

use crate::{LEVELS, TANK, rules, seen, text};

/// Which follows which when the plant goes through the three tables, one after
/// the other, and begins again, one change of an input a scan. A coil that begins
/// follows
///
/// * the states that end in the same scan;
/// * else, if no state was on, those that ended last;
/// * else those that began last, of the ones that are still on.
fn occurring(analysis: &Analysis) -> BTreeSet<(Name, Name)> {
    let mut machine = Machine::new(&analysis.program);
    let coils: Vec<&Name> = analysis
        .conditions
        .variables
        .iter()
        .map(|it| &it.name)
        .collect();
    let is_state = |name: &&Name| analysis.states().find(name).is_some();
    let mut before: Vec<&Name> = Vec::new();
    let mut ended: Vec<&Name> = Vec::new();
    let mut begun: Vec<Vec<&Name>> = Vec::new();
    let mut found = BTreeSet::new();
    for change in changes() {
        machine.set_input(&change.name, change.value);
        machine.scan(10);
        let now: Vec<&Name> = coils
            .iter()
            .filter(|it| machine.is_on(it))
            .copied()
            .collect();
        let on: Vec<&Name> = before.iter().filter(|it| is_state(it)).copied().collect();
        let ends: Vec<&Name> = on.iter().filter(|it| !now.contains(it)).copied().collect();
        let begins: Vec<&Name> = now
            .iter()
            .filter(|it| !before.contains(it))
            .copied()
            .collect();
        let is_still_on = |it: &&Name| on.contains(it) && now.contains(it);
        let latest = begun
            .iter()
            .rev()
            .find(|group| group.iter().any(&is_still_on));
        let follows: Vec<&Name> = match (ends.is_empty(), on.is_empty()) {
            (false, _) => ends.clone(),
            (true, true) => ended.clone(),
            (true, false) => latest
                .iter()
                .flat_map(|it| it.iter().copied())
                .filter(is_still_on)
                .collect(),
        };
        for to in &begins {
            found.extend(follows.iter().map(|from| ((*from).clone(), (*to).clone())));
        }
        if !ends.is_empty() {
            ended = ends;
        }
        begun.push(begins.into_iter().filter(|it| is_state(it)).collect());
        before = now;
    }
    found
}

/// The changes of inputs in all three tables, and the first once more.
fn changes() -> Vec<scenario::Change> {
    let tables = [2, 3, 4, 2].map(|table| {
        let path = format!("fixtures/neutralization/table-{table}.scenario");
        scenario::read(&text(&path)).scenario.steps
    });
    let steps = tables.into_iter().flatten();
    steps.flat_map(|step| step.changes).collect()
}

fn pairs<'s>(list: impl IntoIterator<Item = &'s Succession>) -> Vec<(Name, Name)> {
    let pairs = list.into_iter().map(|it| (it.from.clone(), it.to.clone()));
    pairs.collect()
}

#[test]
fn every_succession_of_the_tables_is_suggested() {
    let analysis = seen(&text(TANK), &[]);
    let occurring = occurring(&analysis);
    assert_eq!(occurring.len(), 14);
    let mut suggested = pairs(analysis.successions());
    // What a light follows is seen by the methods that let every coil take part.
    suggested.extend(pairs(&possible(&analysis.conditions, &Budget::default())));
    let missed = occurring.iter().filter(|it| !suggested.contains(it));
    assert_eq!(missed.count(), 0);
}

/// How many suggestions are looked at: as many as the paper's expert confirmed or
/// added.
const AT: usize = 13;

#[test]
fn the_page_says_how_many_of_the_first_thirteen_happen() {
    let sequence = text("fixtures/neutralization/sequence.grafcet");
    let page = text("docs/witnesses.md");
    for (plant, environment) in [
        ("nothing is known of the plant", ""),
        ("two rules: levels do not overtake each other", LEVELS),
        ("the seven rules of the sequence", &sequence),
    ] {
        let analysis = seen(&text(TANK), &rules(environment));
        let occurring = occurring(&analysis);
        let is_state = |name: &Name| analysis.states().find(name).is_some();
        let of_states = occurring.iter().filter(|(_, to)| is_state(to)).count();
        let ranked = pairs(analysis.successions());
        let hits = ranked.iter().take(AT).filter(|it| occurring.contains(it));
        let hits = hits.count();
        let percent = |of: usize| (200 * hits + of) / (2 * of);
        let row = format!(
            "| {plant} | {} | {hits} | {} % | {} % | {} % |",
            ranked.len(),
            percent(AT),
            percent(of_states),
            percent(occurring.len()),
        );
        assert!(page.contains(&row), "docs/witnesses.md should say\n{row}");
    }
}
