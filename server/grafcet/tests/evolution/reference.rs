//! Brute force: the rules of `docs/evolution.md` as sets of names, short and
//! slow. It shares no code with the machine that it judges.

use std::collections::{BTreeMap, BTreeSet};

use grafcet::{Action, ActionKind, Chart, Effect, Trigger};
use logic::{Atom, Expr, Name, Relation};

type Edges = BTreeMap<Atom, bool>;

/// Evolutions after which the reference gives up.
const MANY: usize = 3_000;

/// A chart without parts, running.
#[derive(Clone)]
pub struct Reference<'c> {
    chart: &'c Chart,
    situation: BTreeSet<Name>,
    values: BTreeMap<Name, i64>,
    kept: BTreeMap<Name, i64>,
    since: BTreeMap<Name, u64>,
    looked_at: Edges,
    /// What the edges in conditions of continuous actions looked at, for each
    /// output.
    shown: BTreeMap<Name, Edges>,
    now: u64,
    is_first: bool,
}

/// What expressions see.
struct Moment<'m> {
    situation: &'m BTreeSet<Name>,
    values: &'m BTreeMap<Name, i64>,
    since: &'m BTreeMap<Name, u64>,
    edges: &'m Edges,
    now: u64,
}

impl Moment<'_> {
    fn value(&self, text: &str) -> i64 {
        match text.parse() {
            Ok(number) => number,
            Err(_) if self.situation.contains(text) => 1,
            Err(_) => self.values.get(text).copied().unwrap_or(0),
        }
    }

    fn holds(&self, expr: &Expr) -> bool {
        match expr {
            Expr::Constant(value) => *value,
            Expr::Not(inner) => !self.holds(inner),
            Expr::And(parts) => parts.iter().all(|part| self.holds(part)),
            Expr::Or(parts) => parts.iter().any(|part| self.holds(part)),
            Expr::Atom(Atom::Variable(name)) => self.value(name) != 0,
            Expr::Atom(Atom::Comparison(it)) => {
                let (left, right) = (self.value(&it.left), self.value(&it.right));
                match it.relation {
                    Relation::Equal => left == right,
                    Relation::Less => left < right,
                    _ => left > right,
                }
            }
            Expr::Atom(Atom::Elapsed { time, step }) => {
                let time: u64 = time.trim_end_matches("ms").parse().expect("a time");
                self.situation.contains(step) && self.now - self.since[step] >= time
            }
            Expr::Atom(edge) => self.edges.get(edge).copied().unwrap_or(false),
        }
    }
}

impl<'c> Reference<'c> {
    pub fn new(chart: &'c Chart) -> Self {
        let initial = chart.steps.iter().filter(|step| step.initial);
        Self {
            chart,
            situation: initial.map(|step| step.name.clone()).collect(),
            values: BTreeMap::new(),
            kept: BTreeMap::new(),
            since: BTreeMap::new(),
            looked_at: BTreeMap::new(),
            shown: BTreeMap::new(),
            now: 0,
            is_first: true,
        }
    }

    pub fn set_input(&mut self, name: &str, value: i64) {
        self.values.insert(name.into(), value);
    }

    pub fn is_active(&self, step: &str) -> bool {
        self.situation.contains(step)
    }

    pub fn value(&self, name: &str) -> i64 {
        self.values.get(name).copied().unwrap_or(0)
    }

    /// `None` if no stable situation is found.
    pub fn scan(&mut self, elapsed: u64) -> Option<()> {
        self.now += elapsed;
        let mut next = self.clone();
        let done = next.evolve();
        if done.is_some() {
            *self = next;
        }
        done
    }

    fn evolve(&mut self) -> Option<()> {
        let edges = self.sample();
        let active = self.situation.clone();
        self.store(&edges, |action, on| match on {
            Trigger::Event(event) => {
                active.contains(&action.step) && edges[&Atom::Rise(Box::new(event.clone()))]
            }
            _ => false,
        });
        if self.is_first {
            self.changed(&BTreeSet::new(), &edges);
        }
        self.is_first = false;
        let none = Edges::new();
        for nth in 0..MANY {
            let occurring = if nth == 0 { &edges } else { &none };
            let before = self.clone();
            let moment = before.moment(occurring);
            let enabled = self.chart.transitions.iter();
            let enabled = enabled.filter(|it| it.from.iter().all(|step| before.is_active(step)));
            let fired: Vec<_> = enabled.filter(|it| moment.holds(&it.receptivity)).collect();
            for step in fired.iter().flat_map(|it| &it.from) {
                self.situation.remove(step);
            }
            for step in fired.iter().flat_map(|it| &it.to) {
                self.situation.insert(step.clone());
            }
            self.changed(&before.situation, occurring);
            let is_same = self.situation == before.situation
                && self.values == before.values
                && self.kept == before.kept
                && self.since == before.since;
            if is_same && (nth > 0 || fired.is_empty()) {
                self.publish();
                return Some(());
            }
        }
        None
    }

    fn moment<'m>(&'m self, edges: &'m Edges) -> Moment<'m> {
        Moment {
            situation: &self.situation,
            values: &self.values,
            since: &self.since,
            edges,
            now: self.now,
        }
    }

    /// Every edge that is written anywhere, and whether it occurs.
    fn sample(&mut self) -> Edges {
        let mut all = Vec::new();
        for transition in &self.chart.transitions {
            edges_of(&transition.receptivity, &mut all);
        }
        for action in &self.chart.actions {
            let ActionKind::Stored { on, .. } = &action.kind else {
                continue;
            };
            let condition = action.condition.iter();
            condition.for_each(|it| edges_of(it, &mut all));
            if let Trigger::Event(event) = on {
                edges_of(&Expr::Atom(Atom::Rise(Box::new(event.clone()))), &mut all);
            }
        }
        if self.is_first {
            for step in &self.situation {
                self.since.insert(step.clone(), self.now);
            }
        }
        let (occurring, looked_at) = occurring(all, &self.looked_at, self.moment(&Edges::new()));
        self.looked_at = looked_at;
        occurring
    }

    fn changed(&mut self, before: &BTreeSet<Name>, edges: &Edges) {
        let after = self.situation.clone();
        for step in after.difference(before) {
            self.since.insert(step.clone(), self.now);
        }
        self.store(edges, |action, on| {
            *on == Trigger::Deactivation
                && before.contains(&action.step)
                && !after.contains(&action.step)
        });
        self.store(edges, |action, on| {
            *on == Trigger::Activation
                && after.contains(&action.step)
                && !before.contains(&action.step)
        });
    }

    /// Performs the stored actions that are due.
    fn store(&mut self, edges: &Edges, is_due: impl Fn(&Action, &Trigger) -> bool) {
        let moment = self.moment(edges);
        let stored = self
            .chart
            .actions
            .iter()
            .filter_map(|action| match &action.kind {
                ActionKind::Stored { effect, on } => Some((action, effect, on)),
                _ => None,
            });
        let due: Vec<_> = stored
            .filter(|(action, _, on)| is_due(action, on))
            .filter(|(action, ..)| action.condition.iter().all(|it| moment.holds(it)))
            .map(|(action, effect, _)| (action.output.clone(), effect))
            .collect();
        let write = |this: &mut Self, name: &Name, value: i64| {
            let is_continuous = this.acts_on(name).next().is_some();
            let values = if is_continuous {
                &mut this.kept
            } else {
                &mut this.values
            };
            values.insert(name.clone(), value);
        };
        for (name, effect) in &due {
            if let Effect::Assign(term) = effect {
                let sum = term.split(" + ").map(|part| self.moment(edges).value(part));
                let sum = sum.fold(0, i64::wrapping_add);
                write(self, name, sum);
            }
        }
        for (name, _) in due.iter().filter(|(_, effect)| **effect == Effect::Set) {
            write(self, name, 1);
        }
        for (name, _) in due.iter().filter(|(_, effect)| **effect == Effect::Reset) {
            write(self, name, 0);
        }
    }

    fn acts_on<'s>(&'s self, output: &'s str) -> impl Iterator<Item = &'c Action> + use<'s, 'c> {
        let actions = self.chart.actions.iter();
        actions.filter(move |it| {
            matches!(it.kind, ActionKind::Continuous { .. }) && &*it.output == output
        })
    }

    /// The outputs whose new values `output` may depend on, near or far.
    fn depends_on(&self, output: &str) -> BTreeSet<Name> {
        let mut found = BTreeSet::new();
        let mut open = vec![Name::from(output)];
        while let Some(output) = open.pop() {
            for condition in self.acts_on(&output).filter_map(|it| it.condition.as_ref()) {
                for name in names_in(condition) {
                    if self.acts_on(&name).next().is_some() && found.insert(name.clone()) {
                        open.push(name);
                    }
                }
            }
        }
        found
    }

    fn publish(&mut self) {
        let mut outputs: BTreeSet<Name> = BTreeSet::new();
        for action in &self.chart.actions {
            if matches!(action.kind, ActionKind::Continuous { .. }) {
                outputs.insert(action.output.clone());
            }
        }
        let (mut published, mut shown) = (BTreeMap::new(), BTreeMap::new());
        for output in &outputs {
            self.published(output, &mut published, &mut shown);
        }
        self.values.extend(published);
        self.shown = shown;
    }

    /// Works one output out, after those that it depends on and that do not
    /// depend on it.
    fn published(
        &self,
        output: &Name,
        published: &mut BTreeMap<Name, i64>,
        shown: &mut BTreeMap<Name, Edges>,
    ) {
        if published.contains_key(output) {
            return;
        }
        let mut values = self.values.clone();
        for other in self.depends_on(output) {
            if !self.depends_on(&other).contains(output) {
                self.published(&other, published, shown);
                values.insert(other.clone(), published[&other]);
            }
        }
        let mut edges = Vec::new();
        for condition in self.acts_on(output).filter_map(|it| it.condition.as_ref()) {
            edges_of(condition, &mut edges);
        }
        let none = Edges::new();
        let moment = Moment {
            values: &values,
            ..self.moment(&none)
        };
        let before = self.shown.get(output).unwrap_or(&none);
        let (edges, looked_at) = occurring(edges, before, moment);
        shown.insert(output.clone(), looked_at);
        let moment = Moment {
            values: &values,
            ..self.moment(&edges)
        };
        let acts = self.acts_on(output).any(|action| {
            let ActionKind::Continuous { delay, limit } = &action.kind else {
                return false;
            };
            let has_passed = |time: &Name| {
                moment.holds(&Expr::Atom(Atom::Elapsed {
                    time: time.clone(),
                    step: action.step.clone(),
                }))
            };
            self.is_active(&action.step)
                && delay.iter().all(has_passed)
                && !limit.iter().any(has_passed)
                && action.condition.iter().all(|it| moment.holds(it))
        });
        let kept = self.kept.get(output).copied().unwrap_or(0);
        published.insert(output.clone(), i64::from(acts || kept != 0));
    }
}

/// Which edges occur, and what they look at now.
fn occurring(edges: Vec<Atom>, before: &Edges, moment: Moment<'_>) -> (Edges, Edges) {
    let (mut occurring, mut looked_at) = (Edges::new(), Edges::new());
    for edge in edges {
        let (Atom::Rise(inner) | Atom::Fall(inner)) = &edge else {
            unreachable!("only edges are collected");
        };
        let is_on = Moment {
            edges: &occurring,
            ..moment
        }
        .holds(inner);
        let was_on = before.get(&edge).copied().unwrap_or(false);
        let occurs = match edge {
            Atom::Rise(_) => is_on && !was_on,
            _ => was_on && !is_on,
        };
        occurring.insert(edge.clone(), occurs);
        looked_at.insert(edge, is_on);
    }
    (occurring, looked_at)
}

/// The variables in an expression, those in edges too.
fn names_in(expr: &Expr) -> Vec<Name> {
    let mut names = Vec::new();
    expr.each_atom(&mut |atom| match atom {
        Atom::Variable(name) => names.push(name.clone()),
        Atom::Comparison(it) => names.extend([it.left.clone(), it.right.clone()]),
        Atom::Rise(inner) | Atom::Fall(inner) => names.extend(names_in(inner)),
        Atom::Elapsed { .. } => {}
    });
    names
}

/// The edges in an expression, inner ones before those that look at them.
fn edges_of(expr: &Expr, all: &mut Vec<Atom>) {
    expr.each_atom(&mut |atom| {
        if let Atom::Rise(inner) | Atom::Fall(inner) = atom {
            edges_of(inner, all);
            if !all.contains(atom) {
                all.push(atom.clone());
            }
        }
    });
}
