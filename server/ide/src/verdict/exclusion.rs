//! Rules about the plant under which a sequence of inputs cannot happen.
//!
//! A sequence that shows a difference holds no change of an input that is not
//! needed, so what is impossible about it, if anything is, is what happens last.
//! Each [`Fact`] of two values that forbids this, and nothing before it, is a
//! candidate. Scenarios tell what was seen at the plant: a candidate that one of
//! them contradicts is none, and those that they speak for are offered first.
//! Where they tell nothing, what the deciding rungs read comes first. Whether a
//! candidate is true only people know.

use std::collections::{BTreeSet, HashSet};

use ::verification::{Step, Trace, What};
use grafcet::EnvironmentRule;
use logic::{Datum, Name};
use source::Edit;

use super::rule::{Fact, Literal, Obeyed, obeyed};
use super::{About, Judged, Observed};
use crate::navigate::driving;

/// So many rules of a form are offered.
const MOST: usize = 2;

/// A rule under which a sequence cannot happen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exclusion {
    /// What it says of the plant, in words.
    pub fact: String,
    /// The rule, without its label: `ls2 |- ls1`.
    pub rule: String,
    /// The edits that add it to the spec.
    pub edits: Vec<Edit>,
}

/// The rules that exclude the sequence of a difference, best first: at most two
/// about the inputs of one scan, and two about two scans. Each was added to the
/// spec, read back and found to be broken by the sequence.
pub fn exclusions(judged: Judged<'_>, about: &About, observed: &[Observed]) -> Vec<Exclusion> {
    let Some(difference) = judged.difference(about) else {
        return Vec::new();
    };
    let trace = &difference.trace;
    let Some(at) = last_change(trace) else {
        return Vec::new();
    };
    let inputs = &trace.steps[at].inputs;
    let seen: Vec<&Observed> = observed.iter().filter(|it| !it.follows(trace)).collect();
    let label = free_label(judged);
    let read = read_for(judged, &difference.what, about);
    let mut ranked: Vec<([usize; 6], Fact)> = Vec::new();
    for fact in facts(trace, at) {
        let rule = fact.rule(&label);
        if broken_at(&rule, trace) != Some(at) {
            continue;
        }
        let told: Option<Vec<usize>> = seen.iter().map(|it| it.obeys(&rule, inputs)).collect();
        if let Some(told) = told {
            let told: usize = told.iter().sum();
            let reads = fact
                .names()
                .map(|name| read.iter().filter(|it| *it == name).count());
            let is_idle = fact.output().is_some_and(|it| !is_state(judged, it));
            let rank = [
                usize::from(told == 0),
                usize::from(!fact.is_about_any(&changed(trace, at))),
                usize::from(is_idle),
                usize::MAX - told,
                fact.strangeness(),
                usize::MAX - reads.iter().sum::<usize>(),
            ];
            ranked.push((rank, fact));
        }
    }
    // What is left equal stays in the order of the inputs and outputs.
    ranked.sort_by_key(|(rank, _)| *rank);
    let (mut one, mut two) = (0, 0);
    let mut found = Vec::new();
    for (_, fact) in ranked {
        let of_its_form = if fact.is_about_two() {
            &mut two
        } else {
            &mut one
        };
        // Of two inputs that change together each is a reason for the same rule.
        if *of_its_form < MOST
            && let Some(exclusion) = added(judged, &label, &fact, trace)
            && !found.contains(&exclusion)
        {
            *of_its_form += 1;
            found.push(exclusion);
        }
    }
    found
}

/// Whether a variable holds a state of the process, as valves do and lights do
/// not: what the plant does next depends on these.
fn is_state(judged: Judged<'_>, name: &Name) -> bool {
    let groups = judged.ladder.analysis.groups();
    groups.iter().any(|group| group.states.contains(name))
}

/// What the rungs read that decide over what differs, once for each rung.
fn read_for(judged: Judged<'_>, what: &What, about: &About) -> Vec<Name> {
    let outputs: Vec<Name> = match (what, about) {
        (What::Outputs(names), _) => names.clone(),
        (_, About::Property(label)) => judged.names_of_property(label),
        _ => Vec::new(),
    };
    let mut read = Vec::new();
    for output in &outputs {
        for target in driving(judged.ladder, output) {
            let place = judged.ladder.rung_at(target.name.range().start);
            let Some((_, rung)) = place.and_then(|it| judged.ladder.rung(it)) else {
                continue;
            };
            let elements = rung.network.elements();
            let names = elements.flat_map(|(_, element)| element.kind.reads());
            let names: BTreeSet<Name> = names.map(|it| it.name.clone()).collect();
            read.extend(names);
        }
    }
    read
}

/// The last step in which an input changes.
fn last_change(trace: &Trace) -> Option<usize> {
    let mut steps = (0..trace.steps.len()).rev();
    steps.find(|&at| !changed(trace, at).is_empty())
}

/// The inputs that change in a step.
fn changed(trace: &Trace, at: usize) -> Vec<&Name> {
    let past = before(trace, at);
    let inputs = trace.steps[at].inputs.iter();
    let changed = inputs.filter(|(name, value)| {
        let is = bit(*value);
        is.is_some_and(|on| on != in_step(past, name))
    });
    changed.map(|(name, _)| name).collect()
}

fn before(trace: &Trace, at: usize) -> Option<&Step> {
    at.checked_sub(1).map(|at| &trace.steps[at])
}

/// Whether a variable is on in a step; before the first step none is.
fn in_step(step: Option<&Step>, name: &str) -> bool {
    let values = step
        .into_iter()
        .flat_map(|it| it.inputs.iter().chain(&it.ladder));
    let mut own = values.filter(|(it, _)| **it == *name);
    own.next().is_some_and(|(_, value)| value.is_on())
}

fn bit(value: Datum) -> Option<bool> {
    match value {
        Datum::Bool(on) => Some(on),
        _ => None,
    }
}

/// All facts of two values that forbid one of the changes in a step.
fn facts(trace: &Trace, at: usize) -> Vec<Fact> {
    let (now, past) = (&trace.steps[at], before(trace, at));
    let inputs = now.inputs.iter().filter_map(|(name, value)| {
        let on = bit(*value)?;
        Some(Literal {
            name: name.clone(),
            on,
        })
    });
    let inputs: Vec<Literal> = inputs.collect();
    let outputs = now.ladder.iter().filter_map(|(name, value)| {
        bit(*value)?;
        Some(Literal {
            name: name.clone(),
            on: in_step(past, name),
        })
    });
    let outputs: Vec<Literal> = outputs.collect();
    let changed = changed(trace, at);
    let mut facts = Vec::new();
    for input in inputs.iter().filter(|it| changed.contains(&&it.name)) {
        let was = Literal {
            name: input.name.clone(),
            on: !input.on,
        };
        for other in inputs.iter().filter(|it| it.name != input.name) {
            facts.push(Fact::NotTogether(input.clone(), other.clone()));
            if other.on && in_step(past, &other.name) {
                facts.push(Fact::StaysAsLongAs(was.clone(), other.clone()));
            }
        }
        for output in &outputs {
            facts.push(Fact::StaysWhile(was.clone(), output.clone()));
        }
    }
    // An output may have come on in the scan before, so any input will do.
    for input in inputs.iter().filter(|it| it.on) {
        for output in outputs.iter().filter(|it| it.on) {
            facts.push(Fact::NotAfter(input.clone(), output.clone()));
        }
    }
    facts
}

/// The first step of a trace in which a rule is broken.
fn broken_at(rule: &EnvironmentRule, trace: &Trace) -> Option<usize> {
    (0..trace.steps.len()).find(|&at| {
        let past = before(trace, at);
        let now = Some(&trace.steps[at]);
        let (before, now) = (
            |name: &str| Some(in_step(past, name)),
            |name: &str| Some(in_step(now, name)),
        );
        obeyed(rule, &before, &now) == Obeyed::Broken
    })
}

/// A label of the form `e8` that nothing in the spec is called by.
fn free_label(judged: Judged<'_>) -> Name {
    let mentions = judged.spec.reading.places.mentions.iter();
    let taken: HashSet<&Name> = mentions.map(|it| &it.name).collect();
    let mut labels = (1..).map(|number: u32| Name::from(format!("e{number}")));
    let free = labels.find(|label| !taken.contains(label));
    free.unwrap_or_else(|| "e".into())
}

/// The rule put into the spec, if what is read from there then is broken by the
/// trace.
fn added(judged: Judged<'_>, label: &Name, fact: &Fact, trace: &Trace) -> Option<Exclusion> {
    let text = &judged.spec.text;
    let mut target = judged.spec.reading.spec.clone();
    target.environment.push(fact.rule(label));
    let new = grafcet::rewrite(text, &target);
    let again = grafcet::read(&new);
    let rules = again.spec.environment.iter();
    let rule = rules.rev().find(|rule| rule.name == *label)?;
    broken_at(rule, trace)?;
    let places = again.places.rules.iter();
    let place = places.rev().find(|rule| rule.name == *label)?;
    let line = new.get(place.span.range())?;
    let (_, rule) = line.split_once(':')?;
    Some(Exclusion {
        fact: fact.words(),
        rule: rule.trim().to_owned(),
        edits: crate::changed(text, &new),
    })
}
