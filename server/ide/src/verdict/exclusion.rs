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

use ::verification::{Difference, Trace, What};
use logic::{Datum, Name};
use source::Edit;

use super::rule::{Fact, Literal};
use super::{About, Judged, Observed};
use crate::changed;
use crate::navigate::driving;

/// So many rules of a form are offered.
const MOST: usize = 2;

/// So many scans are looked at, those of the trace and those that were observed
/// once for each fact: some tenths of a second. The facts that are tried first
/// are those about what changes.
const MOST_LOOKS: usize = 1_000_000;

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
    let seen = observed.iter().filter(|it| !it.follows(&difference.trace));
    let Some(case) = Case::of(judged, about, difference, seen.collect()) else {
        return Vec::new();
    };
    let mut ranked: Vec<([usize; 6], Fact)> = Vec::new();
    for fact in case.facts() {
        ranked.extend(case.rank(&fact).map(|rank| (rank, fact)));
    }
    // What is left equal stays in the order of the inputs and outputs.
    ranked.sort_by_key(|(rank, _)| *rank);
    let mut offered = [0, 0];
    let mut found = Vec::new();
    for (_, fact) in ranked {
        let of_its_form = &mut offered[usize::from(fact.is_about_two())];
        // Of two inputs that change together each is a reason for the same rule.
        if *of_its_form < MOST
            && let Some(exclusion) = case.added(&fact)
            && !found.contains(&exclusion)
        {
            *of_its_form += 1;
            found.push(exclusion);
        }
    }
    found
}

/// A sequence that is to be excluded.
struct Case<'c> {
    judged: Judged<'c>,
    trace: &'c Trace,
    /// The same, by names.
    scans: Observed,
    /// The last step in which an input changes.
    at: usize,
    /// The inputs that change in it.
    changed: Vec<Name>,
    /// What was seen at the plant.
    seen: Vec<&'c Observed>,
    /// What the rungs read that decide, once for each rung.
    read: Vec<Name>,
    /// How the rule is to be called.
    label: Name,
}

impl<'c> Case<'c> {
    fn of(
        judged: Judged<'c>,
        about: &About,
        difference: &'c Difference,
        seen: Vec<&'c Observed>,
    ) -> Option<Self> {
        let trace = &difference.trace;
        let scans = Observed::of_trace(trace);
        let changed = |at: usize| -> Vec<Name> {
            let inputs = trace.steps[at].inputs.iter();
            let changed = inputs.filter(
                |(name, value)| matches!(value, Datum::Bool(on) if *on != scans.is_on(name, at)),
            );
            changed.map(|(name, _)| name.clone()).collect()
        };
        let steps = (0..trace.steps.len()).rev();
        let mut changes = steps.map(|at| (at, changed(at)));
        let (at, changed) = changes.find(|(_, changed)| !changed.is_empty())?;
        Some(Self {
            read: read_for(judged, &difference.what, about),
            label: free_label(judged),
            judged,
            trace,
            at,
            changed,
            seen,
            scans,
        })
    }

    /// The variables among these that are on or off, as they are after so many
    /// scans.
    fn literals(&self, values: &[(Name, Datum)], scans: usize) -> Vec<Literal> {
        let bits = values.iter().filter(|it| matches!(it.1, Datum::Bool(_)));
        let literals = bits.map(|(name, _)| Literal {
            name: name.clone(),
            on: self.scans.is_on(name, scans),
        });
        literals.collect()
    }

    /// All facts of two values that forbid what happens in the step, as far as
    /// they can be looked at.
    fn facts(&self) -> Vec<Fact> {
        let step = &self.trace.steps[self.at];
        let inputs = self.literals(&step.inputs, self.at + 1);
        let outputs = self.literals(&step.ladder, self.at);
        let mut facts = Vec::new();
        for input in inputs.iter().filter(|it| self.changed.contains(&it.name)) {
            let was = input.complement();
            for other in inputs.iter().filter(|it| it.name != input.name) {
                facts.push(Fact::NotTogether(input.clone(), other.clone()));
                if other.on && self.scans.is_on(&other.name, self.at) {
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
        let seen: usize = self.seen.iter().map(|it| it.len()).sum();
        facts.truncate(MOST_LOOKS / (self.scans.len() + seen).max(1));
        facts
    }

    /// Where a fact stands among those that are offered, the least first; `None` if
    /// it does not forbid what happens last, or was seen not to be true.
    fn rank(&self, fact: &Fact) -> Option<[usize; 6]> {
        let rule = fact.rule(&self.label);
        if self.scans.breaks(&rule) != Some(self.at) {
            return None;
        }
        let inputs = &self.trace.steps[self.at].inputs;
        let told = self.seen.iter().map(|it| it.obeys(&rule, inputs));
        let told: usize = told.sum::<Option<usize>>()?;
        let is_read = |name: &Name| self.read.iter().filter(|it| *it == name).count();
        let reads: usize = fact.names().into_iter().map(is_read).sum();
        let is_idle = fact.output().is_some_and(|it| !is_state(self.judged, it));
        Some([
            usize::from(told == 0),
            usize::from(!fact.is_about_any(&self.changed)),
            usize::from(is_idle),
            usize::MAX - told,
            fact.strangeness(),
            usize::MAX - reads,
        ])
    }

    /// The rule put into the spec, if what is read from there then is broken by the
    /// trace.
    fn added(&self, fact: &Fact) -> Option<Exclusion> {
        let text = &self.judged.spec.text;
        let mut target = self.judged.spec.reading.spec.clone();
        target.environment.push(fact.rule(&self.label));
        let new = grafcet::rewrite(text, &target);
        let again = grafcet::read(&new);
        let rules = again.spec.environment.iter();
        let rule = rules.rev().find(|rule| rule.name == self.label)?;
        self.scans.breaks(rule)?;
        let places = again.places.rules.iter();
        let place = places.rev().find(|rule| rule.name == self.label)?;
        let line = new.get(place.span.range())?;
        let (_, rule) = line.split_once(':')?;
        Some(Exclusion {
            fact: fact.words(),
            rule: rule.trim().to_owned(),
            edits: changed(text, &new),
        })
    }
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

/// A label of the form `e8` that nothing in the spec is called by.
fn free_label(judged: Judged<'_>) -> Name {
    let mentions = judged.spec.reading.places.mentions.iter();
    let taken: HashSet<&Name> = mentions.map(|it| &it.name).collect();
    let mut labels = (1..).map(|number: u32| Name::from(format!("e{number}")));
    let free = labels.find(|label| !taken.contains(label));
    free.unwrap_or_else(|| "e".into())
}
