use std::collections::BTreeMap;

use ::ladder::{CoilKind, Routine, Rung};
use logic::{AtomId, Budget, Function, Name};
use recovery::Analysis;
use recovery::conditions::{Place, Variable, WriteKind};
use source::Span;

use crate::condition::Words;

/// A variable that coils write.
pub struct Coil<'a> {
    /// Its name in conditions.
    pub name: &'a Name,
    /// Its address, where it has one.
    pub address: Option<&'a str>,
    /// What the source says about it.
    pub description: Option<Name>,
    /// Its conditions; `None` past the budget.
    pub conditions: Option<Said>,
    /// Its conditions with auxiliary coils resolved, where these differ.
    pub resolved: Option<Said>,
    /// Whether it keeps itself on.
    pub persistent: bool,
    /// What it is among the variables of the program.
    pub part: Part,
    /// Coils that hold a state and stand before it as normally closed contacts.
    pub interlocks: Vec<Name>,
    /// What unknown boxes do to it.
    pub opaque: Vec<String>,
    /// Variables that its conditions take to be at rest.
    pub at_rest: Vec<AtRest<'a>>,
    /// Where coils write it, in the order of the source.
    pub writes: Vec<Drawn<'a>>,
}

/// A variable that conditions take to be at rest, though a rung writes it
/// between contacts that read it.
pub struct AtRest<'a> {
    /// The variable.
    pub name: Name,
    /// The first such rung, and its routine; `None` if nobody knows which is
    /// the first, since rungs are solved several times in a scan.
    pub written: Option<(&'a Routine, &'a Rung)>,
}

impl AtRest<'_> {
    /// What is supposed, in words.
    pub fn in_words(&self) -> String {
        let by = match self.written {
            Some((routine, rung)) => routine.name_of(rung),
            None => "a rung".to_owned(),
        };
        format!(
            "{} at rest: {by} writes it between contacts that see it",
            self.name
        )
    }
}

/// The four conditions, each as text.
pub struct Said {
    /// Its value after a scan.
    pub activation: String,
    /// What starts it.
    pub turns_on: String,
    /// What keeps it.
    pub stays_on: String,
    /// What ends it.
    pub deactivation: String,
}

/// What a coil is for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A state of the process.
    State,
    /// An output that some states set and others reset.
    Repeats,
    /// It keeps its value, but nothing starts it or nothing ends it.
    Keeps,
    /// Its value stays only while its rung is skipped.
    KeptWhenSkipped,
    /// Its rung falls when it is on.
    Oscillates,
    /// It carries a condition from states to other rungs.
    Auxiliary,
    /// It follows its condition.
    Follows,
    /// Its conditions are past the budget, so that nobody can tell.
    TooLarge,
}

/// A coil as it is drawn.
pub struct Drawn<'a> {
    /// How it writes.
    pub kind: CoilKind,
    /// The routine it stands in.
    pub routine: &'a Routine,
    /// The rung it stands on.
    pub rung: &'a Rung,
    /// The power at it; `None` past the budget.
    pub guard: Option<String>,
    /// When its rung is solved; `None` past the budget.
    pub solved: Option<String>,
    /// The bytes of the coil.
    pub span: Span,
}

impl Coil<'_> {
    /// Whether `name` is its name or its address.
    pub fn is_called(&self, name: &str) -> bool {
        **self.name == *name || self.address == Some(name)
    }
}

/// All coils, in the order of the source.
pub fn coils<'a>(analysis: &'a Analysis, budget: &Budget) -> Vec<Coil<'a>> {
    let variables = analysis.conditions.variables.iter();
    let mut coils: Vec<Coil<'a>> = variables
        .map(|variable| coil(variable, analysis, budget))
        .filter(|coil| !coil.writes.is_empty())
        .collect();
    coils.sort_by_key(|coil| coil.writes.first().map(|write| write.span));
    coils
}

/// What is known of one variable that coils write.
pub fn coil<'a>(variable: &'a Variable, analysis: &'a Analysis, budget: &Budget) -> Coil<'a> {
    let conditions = &analysis.conditions;
    let mut words = Words::new(conditions, budget);
    let declared = analysis.program.declarations.find(&variable.name);
    let next = variable.next.as_ref().ok();
    let resolved = next.and_then(|next| {
        let auxiliaries = &analysis.states().auxiliaries;
        let resolved = auxiliaries.resolve(next, conditions, budget);
        (resolved != *next).then(|| four(&resolved, variable.atom, &mut words))?
    });
    let opaque = next.map_or(Vec::new(), |next| conditions.opaque_in(next));
    Coil {
        name: &variable.name,
        address: declared.and_then(|it| it.address.as_deref()),
        description: analysis.description(&variable.name),
        conditions: next.and_then(|next| four(next, variable.atom, &mut words)),
        resolved,
        persistent: variable.is_persistent() && !variable.kept_when_skipped,
        part: part(variable, analysis),
        interlocks: interlocks(variable, analysis),
        opaque: opaque
            .into_iter()
            .map(|atom| conditions.atoms.atom(atom).to_string())
            .collect(),
        at_rest: at_rest(variable, analysis),
        writes: writes(variable, analysis, &mut words, budget),
    }
}

fn at_rest<'a>(variable: &Variable, analysis: &'a Analysis) -> Vec<AtRest<'a>> {
    let routines = &analysis.program.routines;
    let all = analysis.at_rest(variable).into_iter();
    all.map(|it| AtRest {
        name: it.name,
        written: it.written.and_then(|(routine, rung)| {
            let routine = routines.get(routine)?;
            Some((routine, routine.rungs.get(rung)?))
        }),
    })
    .collect()
}

fn four(next: &Function, atom: AtomId, words: &mut Words<'_>) -> Option<Said> {
    let stays_on = next.restrict(atom, true);
    Some(Said {
        activation: words.say(next)?,
        turns_on: words.say(&next.restrict(atom, false))?,
        deactivation: words.say(&stays_on.not())?,
        stays_on: words.say(&stays_on)?,
    })
}

fn part(variable: &Variable, analysis: &Analysis) -> Part {
    let atom = variable.atom;
    if analysis.states().state(atom).is_some() {
        Part::State
    } else if analysis.states().stored.iter().any(|it| it.atom == atom) {
        Part::Repeats
    } else if variable.next.is_err() {
        Part::TooLarge
    } else if variable.kept_when_skipped {
        Part::KeptWhenSkipped
    } else if variable.is_persistent() {
        Part::Keeps
    } else if variable.falls_in_itself() {
        Part::Oscillates
    } else if analysis.states().auxiliaries.contains(atom) {
        Part::Auxiliary
    } else {
        Part::Follows
    }
}

fn interlocks(variable: &Variable, analysis: &Analysis) -> Vec<Name> {
    let closed = variable.closed_contacts.iter();
    closed
        .filter_map(|atom| analysis.states().state(*atom))
        .map(|state| state.name.clone())
        .collect()
}

/// The coils that write a variable. One in a routine that is called from
/// several places is drawn once, and solved when any of them calls.
fn writes<'a>(
    variable: &'a Variable,
    analysis: &'a Analysis,
    words: &mut Words<'_>,
    budget: &Budget,
) -> Vec<Drawn<'a>> {
    let mut solved: BTreeMap<Place, Option<Function>> = BTreeMap::new();
    for write in &variable.writes {
        let here = write.solved.as_ref().ok();
        let before = solved
            .entry(write.place)
            .or_insert_with(|| Some(Function::constant(false)));
        *before = before
            .take()
            .zip(here)
            .and_then(|(before, here)| before.or(here, budget).ok());
    }
    let mut drawn = Vec::new();
    for write in &variable.writes {
        let WriteKind::Coil(kind) = write.kind else {
            continue;
        };
        let Some(solved) = solved.remove(&write.place) else {
            continue;
        };
        let Some(routine) = analysis.program.routines.get(write.place.routine) else {
            continue;
        };
        let Some(rung) = routine.rungs.get(write.place.rung) else {
            continue;
        };
        let guard = write.guard.as_ref().ok();
        drawn.push(Drawn {
            kind,
            routine,
            rung,
            guard: guard.and_then(|guard| words.say(guard)),
            solved: solved.and_then(|solved| words.say(&solved)),
            span: write.place.span(&analysis.program),
        });
    }
    drawn.sort_by_key(|write| write.span);
    drawn
}

/// The word for a kind of coil in answers.
pub fn kind_word(kind: CoilKind) -> &'static str {
    match kind {
        CoilKind::Plain => "plain",
        CoilKind::Negated => "negated",
        CoilKind::Set => "set",
        CoilKind::Reset => "reset",
        CoilKind::Rising => "rising",
        CoilKind::Falling => "falling",
    }
}
