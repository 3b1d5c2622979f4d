//! The product form: what no sequence decides, as its rungs have it.
//!
//! Every memory is a partial grafcet of two steps where it can be (see
//! [`forms`](super::forms)); two more follow each variable whose last value an
//! action reads.

use grafcet::{Action, Chart, Step, Transition};
use logic::{Expr, Function, Name};

use super::forms::{Form, Forms};
use super::naming::Names;
use super::wording::Wording;
use crate::Analysis;

/// A variable that keeps its value, with its two steps.
struct Memory {
    variable: Name,
    off: Name,
    on: Name,
    /// Whether it is on before the first scan.
    is_on: bool,
    turns_on: Function,
    deactivation: Function,
}

/// What is drawn of the product form.
pub(super) struct Product<'f> {
    pub(super) forms: &'f Forms,
    memories: Vec<Memory>,
    followers: Vec<Follower>,
    /// What tells the first scan from the others, if something has to know.
    pub(super) first: Option<First>,
}

impl<'f> Product<'f> {
    /// All of it with its steps named.
    pub(super) fn new(
        analysis: &Analysis,
        forms: &'f Forms,
        names: &mut Names,
        wording: &mut Wording<'_>,
    ) -> Self {
        let memories = memories(analysis, forms, names, wording);
        let followers = followers(analysis, forms, names, wording);
        Self {
            forms,
            memories,
            first: first(forms, &followers, names, wording),
            followers,
        }
    }
}

/// The memories that no accepted succession ties to a sequence and that are
/// said by two steps.
fn memories(
    analysis: &Analysis,
    forms: &Forms,
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Vec<Memory> {
    let stored = |atom| analysis.states().stored.iter().any(|it| it.atom == atom);
    let mut found = Vec::new();
    for variable in super::actions::own_variables(analysis) {
        let next = match forms.of(variable.atom) {
            Some(Form::Steps(next)) => next.clone(),
            Some(Form::Rough) if !stored(variable.atom) => match wording.resolved(variable) {
                Some(next) if next.depends_on(variable.atom) => next,
                _ => continue,
            },
            _ => continue,
        };
        let memory = Memory {
            variable: variable.name.clone(),
            off: names.step(&format!("{}_off", variable.name)),
            on: names.step(&format!("X{}", variable.name)),
            is_on: forms.seen.is_initial(variable.atom),
            turns_on: next.restrict(variable.atom, false),
            deactivation: next.restrict(variable.atom, true).not(),
        };
        wording.stands_for(variable.atom, memory.on.clone());
        found.push(memory);
    }
    found
}

impl Product<'_> {
    /// Draws the memories. A change that can never happen has no transition.
    pub(super) fn draw(
        &self,
        analysis: &Analysis,
        names: &mut Names,
        wording: &Wording<'_>,
        chart: &mut Chart,
    ) {
        for memory in &self.memories {
            chart.steps.push(Step {
                initial: !memory.is_on,
                ..Step::new(memory.off.clone())
            });
            chart.steps.push(Step {
                initial: memory.is_on,
                state: Some(memory.variable.clone()),
                comment: analysis.description(&memory.variable),
                ..Step::new(memory.on.clone())
            });
            let (off, on) = (&memory.off, &memory.on);
            for (word, from, to, condition) in [
                ("starts", off, on, &memory.turns_on),
                ("ends", on, off, &memory.deactivation),
            ] {
                if condition.is_false() {
                    continue;
                }
                let name = names.transition(&format!("{}_{word}", memory.variable));
                let receptivity = wording.say_or_name(condition, &name);
                chart.transitions.push(Transition::new(
                    name,
                    from.clone(),
                    to.clone(),
                    receptivity,
                ));
            }
        }
    }

    /// Draws the followers. Their receptivities read the variable as the last
    /// scan has published it.
    pub(super) fn draw_followers(&self, names: &mut Names, chart: &mut Chart) {
        let begun = self.first.as_ref().map(|first| &first.begun);
        for follower in &self.followers {
            let (off, on) = (&follower.off, &follower.on);
            chart.steps.push(Step {
                initial: !follower.is_on,
                ..Step::new(off.clone())
            });
            let comment = format!(
                "{} as the last scan left it: rungs above its own see that",
                follower.variable
            );
            chart.steps.push(Step {
                initial: follower.is_on,
                comment: Some(comment.into()),
                ..Step::new(on.clone())
            });
            let followed = Expr::variable(follower.variable.clone());
            let gone = match begun.filter(|_| follower.is_on) {
                Some(begun) => {
                    let begun = Expr::variable(begun.clone());
                    Expr::And(vec![followed.clone().complement(), begun])
                }
                None => followed.clone().complement(),
            };
            for (word, from, to, receptivity) in
                [("starts", off, on, followed), ("ends", on, off, gone)]
            {
                let name = names.transition(&format!("{}_was_{word}", follower.variable));
                chart.transitions.push(Transition::new(
                    name,
                    from.clone(),
                    to.clone(),
                    receptivity,
                ));
            }
        }
    }
}

/// Two steps that follow a variable one scan late: what rungs see that stand
/// above those that write it.
struct Follower {
    variable: Name,
    off: Name,
    on: Name,
    /// Whether it is on before the first scan.
    is_on: bool,
}

/// The followers of all variables whose last value actions read.
fn followers(
    analysis: &Analysis,
    forms: &Forms,
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Vec<Follower> {
    let mut found = Vec::new();
    for &atom in &forms.followed {
        let (Some(variable), Some(before)) =
            (analysis.conditions.variable(atom), forms.seen.before(atom))
        else {
            continue;
        };
        let follower = Follower {
            off: names.step(&format!("{}_was_off", variable.name)),
            on: names.step(&format!("X{}_was", variable.name)),
            is_on: forms.seen.is_initial(atom),
            variable: variable.name.clone(),
        };
        wording.stands_for(before, follower.on.clone());
        found.push(follower);
    }
    found
}

/// What tells the first scan from the others.
pub(super) struct First {
    /// A step that is active in it only, if an action reads it.
    step: Option<Name>,
    /// An output that is on from the first scan on, and so is read as on from
    /// the second.
    begun: Name,
}

/// What tells the first scan from the others, if something has to know.
fn first(
    forms: &Forms,
    followers: &[Follower],
    names: &mut Names,
    wording: &mut Wording<'_>,
) -> Option<First> {
    let acts = forms.acts_in_first();
    if !acts && !followers.iter().any(|it| it.is_on) {
        return None;
    }
    let step = acts.then(|| names.step("First"));
    if let Some(step) = &step {
        wording.stands_for(forms.seen.first, step.clone());
    }
    let begun = names.step("begun");
    Some(First { step, begun })
}

impl First {
    /// Draws it, beside the step that is always active.
    pub(super) fn draw(&self, always: Name, names: &mut Names, chart: &mut Chart) {
        if let Some(step) = &self.step {
            chart.steps.push(Step {
                initial: true,
                comment: Some("active in the first scan only".into()),
                ..Step::new(step.clone())
            });
            let name = names.transition("First_ends");
            let receptivity = Expr::variable(self.begun.clone());
            chart.transitions.push(Transition {
                to: Vec::new(),
                ..Transition::new(name, step.clone(), step.clone(), receptivity)
            });
        }
        let action = Action::continuous(always, self.begun.clone());
        chart.actions.push(action);
    }
}
