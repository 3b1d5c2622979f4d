//! Actions about states: which follows which, and where a sequence starts.

use grafcet::{Role, Verdict};
use logic::{Budget, Name};
use recovery::Analysis;
use recovery::successions::{Evidence, Kind, Succession};
use source::Span;

use super::mend::said;
use super::{Action, ActionKind, Asked, Effect, pair};
use crate::change::listed;
use crate::{Change, Decided, Departing, Ladder, Spec, Standing, legible};

/// The states that a place in a ladder is about: with a selection of several
/// names all that are named in it, else the one that is named there, else those
/// of the rung.
pub(super) fn in_ladder(ladder: &Ladder, span: Span) -> Vec<Name> {
    let states = &ladder.analysis.states();
    let is_state = |name: &&Name| states.find(name).is_some();
    let names = ladder.names().all();
    let Some(offset) = cursor(span, names.iter().map(|it| it.span)) else {
        let selected = names.iter().filter(|it| holds(span, it.span));
        return distinct(selected.map(|it| &it.name).filter(is_state));
    };
    if let Some(mention) = ladder.names().at(offset)
        && is_state(&&mention.name)
    {
        return vec![mention.name.clone()];
    }
    let Some((_, rung)) = ladder.rung_at(offset).and_then(|place| ladder.rung(place)) else {
        return Vec::new();
    };
    let elements = rung.network.elements();
    let written = elements.flat_map(|(_, element)| element.kind.writes());
    let mut names = distinct(written.map(|it| &it.name).filter(is_state));
    // A rung that moves a number says what follows the values it is read at.
    let values = ladder.analysis.registers.iter().flat_map(|register| {
        let arcs = register.arcs.iter();
        let here = arcs.filter(|arc| {
            arc.written_at
                .iter()
                .any(|(_, at)| rung.span.touches(at.range().start))
        });
        here.map(|arc| register.state_name(arc.from))
            .collect::<Vec<_>>()
    });
    for value in values {
        if !names.contains(&value) {
            names.push(value);
        }
    }
    names
}

/// The states that a place in a spec is about.
pub(super) fn in_spec(spec: &Spec, span: Span) -> Vec<Name> {
    let grafcet = &spec.reading.spec.grafcet;
    let state_of = |mention: &grafcet::Mention| match mention.role {
        Role::State => Some(mention.name.clone()),
        Role::Step => {
            let step = grafcet.steps().find(|step| step.name == mention.name)?;
            step.state.clone()
        }
        _ => None,
    };
    let mentions = &spec.reading.places.mentions;
    let cursor = cursor(span, mentions.iter().map(|it| it.span));
    let here = mentions.iter().filter(|it| match cursor {
        Some(offset) => it.span.touches(offset),
        None => holds(span, it.span),
    });
    let names: Vec<Name> = here.filter_map(state_of).collect();
    distinct(names.iter())
}

/// Where the cursor is, unless `span` selects of several `names`. Some editors
/// always select the character under their cursor, so that a selection alone
/// does not say that somebody made it.
fn cursor(span: Span, names: impl Iterator<Item = Span>) -> Option<usize> {
    let at = span.range().start;
    if span.is_empty() {
        return Some(at);
    }
    let touched = names.filter(|it| it.start < span.end && span.start < it.end);
    let touched: Vec<Span> = touched.collect();
    match &*touched {
        [one] => Some(one.range().start),
        // An index is a name within the name of its element.
        all if all.iter().all(|it| holds(*it, span)) => Some(at),
        _ => None,
    }
}

fn holds(outer: Span, inner: Span) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

fn distinct<'n>(names: impl Iterator<Item = &'n Name>) -> Vec<Name> {
    let mut all: Vec<Name> = Vec::new();
    for name in names {
        if !all.contains(name) {
            all.push(name.clone());
        }
    }
    all
}

/// What can be decided about states, best first: followers of each, what it
/// follows, where a sequence starts, and what was decided before. Of several
/// states, as selected, each may follow the one before it.
pub(super) fn about_states(
    ladder: &Ladder,
    spec: Option<&Spec>,
    states: &[Name],
    asked: Asked<'_>,
) -> Vec<Action> {
    let view = View {
        ladder,
        decided: spec.map(Decided::of).unwrap_or_default(),
        weakest: asked.weakest,
        budget: asked.budget,
    };
    let mut all = Vec::new();
    for two in states.windows(2) {
        all.extend(view.own(&two[0], &two[1]));
    }
    for state in states {
        all.extend(view.together(state));
        all.extend(view.followers(state));
    }
    for state in states {
        all.extend(view.predecessors(state));
        all.extend(view.rejections(state));
    }
    for state in states {
        all.extend(view.initial(state));
        all.extend(undoing(spec, state));
    }
    all
}

struct View<'v> {
    ladder: &'v Ladder,
    decided: Decided,
    weakest: Evidence,
    budget: &'v Budget,
}

impl View<'_> {
    fn analysis(&self) -> &Analysis {
        &self.ladder.analysis
    }

    /// Suggestions about which nothing is decided, best first. Arcs of registers
    /// are no suggestions.
    fn open(&self) -> impl Iterator<Item = &Succession> {
        let all = self.analysis().successions().iter();
        all.filter(|it| it.evidence != Evidence::Written && it.evidence <= self.weakest)
            .filter(|it| self.decided.standing(&it.from, &it.to) == Standing::Open)
    }

    fn reason(&self, succession: &Succession) -> String {
        let evidence = succession.evidence.word();
        let condition = succession.condition.as_ref();
        let condition = condition
            .and_then(|it| legible(it, &self.analysis().conditions, self.budget))
            .filter(|it| it.len() <= LONGEST_REASON);
        match condition {
            Some(condition) => format!("{evidence} on {condition}"),
            None => evidence.to_owned(),
        }
    }

    fn accept(&self, succession: &Succession, preferred: bool) -> Action {
        let (from, to) = (succession.from.clone(), succession.to.clone());
        Action {
            title: format!("Accept {} ({})", pair(&from, &to), self.reason(succession)),
            kind: ActionKind::Accept,
            preferred,
            effect: make(Verdict::Accept { from, to: vec![to] }),
        }
    }

    fn followers(&self, state: &Name) -> Vec<Action> {
        let open = self.open().filter(|it| it.from == *state);
        open.map(|it| self.accept(it, false)).collect()
    }

    fn predecessors(&self, state: &Name) -> Vec<Action> {
        let open = self.open().filter(|it| it.to == *state);
        open.map(|it| self.accept(it, false)).collect()
    }

    /// Followers that start together: those proposed as AND, of the best
    /// evidence.
    fn together(&self, state: &Name) -> Option<Action> {
        let open = self
            .open()
            .filter(|it| it.from == *state && it.kind == Kind::And);
        let open: Vec<&Succession> = open.collect();
        let best = open.first()?.evidence;
        let same: Vec<&Succession> = open.into_iter().filter(|it| it.evidence == best).collect();
        if same.len() < 2 {
            return None;
        }
        let to: Vec<Name> = same.iter().map(|it| it.to.clone()).collect();
        Some(Action {
            title: format!(
                "Accept {state} -> {} together (AND, {}{})",
                listed(&to),
                best.word(),
                self.shared(&same)
            ),
            kind: ActionKind::AcceptTogether,
            preferred: best == Evidence::Handover,
            effect: make(Verdict::Accept {
                from: state.clone(),
                to,
            }),
        })
    }

    /// What all of these begin on: `, all on ls2`.
    fn shared(&self, successions: &[&Succession]) -> String {
        let conditions = &self.analysis().conditions;
        let mut functions = successions.iter().filter_map(|it| it.condition.as_ref());
        let Some(first) = functions.next() else {
            return String::new();
        };
        let all = functions.try_fold(first.clone(), |all, it| all.and(it, self.budget));
        let said = all
            .ok()
            .and_then(|all| legible(&all, conditions, self.budget));
        match said.filter(|it| it.len() <= LONGEST_REASON && it != "0") {
            Some(said) => format!(", all on {said}"),
            None => String::new(),
        }
    }

    fn rejections(&self, state: &Name) -> Vec<Action> {
        let open = self.open().filter(|it| it.from == *state);
        open.map(|it| Action {
            title: format!("Reject {} ({})", pair(&it.from, &it.to), self.reason(it)),
            kind: ActionKind::Reject,
            preferred: false,
            effect: make(Verdict::Reject {
                from: it.from.clone(),
                to: it.to.clone(),
            }),
        })
        .collect()
    }

    fn initial(&self, state: &Name) -> Option<Action> {
        // Where a register starts is what the ladder moves into it.
        let is_bit = self.analysis().states().find(state).is_some();
        (is_bit && !self.decided.is_initial(state)).then(|| Action {
            title: format!("Start the sequence in {state}"),
            kind: ActionKind::Initial,
            preferred: false,
            effect: make(Verdict::Initial(state.clone())),
        })
    }

    /// A succession that nobody suggests.
    fn own(&self, from: &Name, to: &Name) -> Option<Action> {
        let is_bit = |name: &Name| self.analysis().states().find(name).is_some();
        let is_known = self
            .analysis()
            .successions()
            .iter()
            .any(|it| it.from == *from && it.to == *to);
        let is_open = self.decided.standing(from, to) == Standing::Open;
        (is_bit(from) && is_bit(to) && !is_known && is_open).then(|| Action {
            title: format!("Accept {} (not suggested)", pair(from, to)),
            kind: ActionKind::Accept,
            preferred: false,
            effect: make(Verdict::Accept {
                from: from.clone(),
                to: vec![to.clone()],
            }),
        })
    }
}

/// Longer conditions stand in the hover, not in a title.
const LONGEST_REASON: usize = 40;

fn make(verdict: Verdict) -> Effect {
    Effect::Spec(vec![Change::Make(verdict)], Departing::Stay)
}

/// Takes back what was decided about a state.
fn undoing(spec: Option<&Spec>, state: &Name) -> Vec<Action> {
    let decisions = spec.into_iter().flat_map(|it| &it.reading.spec.decisions);
    let about = decisions.filter(|it| match &it.verdict {
        Verdict::Accept { from, to } => from == state || to.contains(state),
        Verdict::Reject { from, to } => from == state || to == state,
        Verdict::Initial(name) | Verdict::End(name) => name == state,
        Verdict::Keep(_) => false,
    });
    about
        .map(|it| Action {
            title: format!("Take back: {}", said(&it.verdict)),
            kind: ActionKind::Undo,
            preferred: false,
            effect: Effect::Spec(vec![Change::Withdraw(it.verdict.clone())], Departing::Stay),
        })
        .collect()
}
