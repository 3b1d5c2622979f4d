//! The things that a rule text and its ladder have, as they can be typed.

use std::collections::BTreeSet;

use grafcet::{Role, spelled, spelled_state};
use logic::Name;
use source::Span;

use super::spec::Asked;
use super::variables::{Wanted, variables};
use super::{Completion, CompletionKind};

impl Asked<'_> {
    /// The states of the ladder.
    pub(super) fn states(&self) -> Vec<Completion> {
        let Some(ladder) = self.ladder else {
            return Vec::new();
        };
        let analysis = &ladder.analysis;
        let values = analysis.registers.iter().flat_map(|register| {
            let states = register.states.iter();
            states.map(|it| (register.state_name(it.value), it.title.clone(), None))
        });
        let coils = analysis.states().states.iter().map(|state| {
            let name = state.name.clone();
            (name.clone(), analysis.description(&name), Some(name))
        });
        let state = |(name, title, variable): (Name, Option<Name>, Option<Name>)| Completion {
            variable,
            ..Completion::new(
                &*name,
                CompletionKind::State,
                title.as_deref().unwrap_or_default(),
            )
            .insert(spelled_state(&name))
        };
        coils.chain(values).map(state).collect()
    }

    pub(super) fn steps(&self) -> Vec<Completion> {
        let steps = self.spec.reading.spec.grafcet.steps();
        let step = |it: &grafcet::Step| {
            let said = match (&it.state, &it.comment) {
                (Some(state), Some(comment)) => format!("for {state}  {comment}"),
                (Some(state), None) => format!("for {state}"),
                (None, comment) => comment.as_deref().unwrap_or_default().to_owned(),
            };
            Completion::new(&*it.name, CompletionKind::Step, said).insert(spelled(&it.name))
        };
        steps.map(step).collect()
    }

    /// Variables that are declared in the spec.
    pub(super) fn declared<'v>(
        &self,
        all: impl Iterator<Item = &'v grafcet::Variable>,
    ) -> Vec<Completion> {
        let variable = |it: &grafcet::Variable| {
            let mut said: Vec<&str> = Vec::new();
            said.extend(it.address.as_deref());
            said.extend(it.comment.as_deref());
            Completion {
                variable: Some(it.name.clone()),
                ..Completion::new(&*it.name, CompletionKind::Variable, said.join("  "))
                    .insert(spelled(&it.name))
            }
        };
        all.map(variable).collect()
    }

    /// Variables that can be read: the spec's own, then the ladder's.
    pub(super) fn values(&self) -> Vec<Completion> {
        let mut items = self.declared(self.spec.reading.spec.grafcet.variables());
        let known = self.known();
        let others = self.of_ladder(Wanted::Read).into_iter();
        items.extend(others.filter(|it| !known.contains(it.label.as_str())));
        items
    }

    pub(super) fn outputs(&self) -> Vec<Completion> {
        let grafcet = &self.spec.reading.spec.grafcet;
        self.declared(grafcet.outputs.iter().chain(&grafcet.internals))
    }

    pub(super) fn of_ladder(&self, wanted: Wanted) -> Vec<Completion> {
        let known = self.ladder.filter(|ladder| ladder.is_known());
        known.map_or(Vec::new(), |ladder| {
            variables(ladder, wanted, Span::default(), spelled)
        })
    }

    /// Names that the spec declares as variables or steps.
    pub(super) fn known(&self) -> BTreeSet<&str> {
        let grafcet = &self.spec.reading.spec.grafcet;
        let variables = grafcet.variables().map(|it| &*it.name);
        variables
            .chain(grafcet.steps().map(|it| &*it.name))
            .collect()
    }

    /// What is declared in a role.
    pub(super) fn named(&self, role: Role, kind: CompletionKind) -> Vec<Completion> {
        let mut seen = BTreeSet::new();
        let mentions = self.spec.reading.places.mentions.iter();
        mentions
            .filter(|it| it.role == role && seen.insert(&it.name))
            .map(|it| Completion::new(&*it.name, kind, "").insert(spelled(&it.name)))
            .collect()
    }
}
