//! Which step follows which, one step at a time.
//!
//! In a ladder the steps are its states: a state is followed by those that were
//! accepted after it, and where nothing is decided by those that are suggested,
//! each with the evidence. In a spec the transitions say what follows.

use grafcet::{Role, Transition, Verdict};
use logic::{Budget, Name};
use recovery::successions::Succession;
use source::Span;

use crate::decided::{Decided, Standing};
use crate::navigate::{self, Pair, Side, Subject, Target};
use crate::{Ladder, Spec, Usage, legible};

/// Something that is followed by others.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// A state of the ladder.
    State(Name),
    /// A step of the spec.
    Step(Name),
}

/// A stage with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// What it is.
    pub stage: Stage,
    /// What else there is to say.
    pub detail: String,
    /// Its coil, its declaration.
    pub at: Target,
}

/// A neighbour of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neighbour {
    /// The neighbour; its detail says why it is one.
    pub item: Item,
    /// The places, in the text of the stage that is left, which lead from one
    /// to the other.
    pub from: Vec<Span>,
}

/// Before or after.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// What it follows.
    Before,
    /// What follows it.
    After,
}

/// The stage at the byte `offset` of one of the two texts.
pub fn stage_at(pair: Pair<'_>, side: Side, offset: usize) -> Option<Item> {
    if let (Side::Spec, Some(spec)) = (side, pair.spec)
        && let Some(mention) = spec.reading.places.mention_at(offset)
        && mention.role == Role::Step
    {
        return step(spec, &mention.name, None);
    }
    match navigate::subject(pair, side, offset)? {
        Subject::Variable(name) | Subject::Value(name) => state(pair.ladder?, &name, None),
        _ => None,
    }
}

/// The neighbours of a stage on one side of it, best first.
pub fn neighbours(
    pair: Pair<'_>,
    stage: &Stage,
    direction: Direction,
    budget: &Budget,
) -> Vec<Neighbour> {
    match stage {
        Stage::State(name) => of_state(pair, name, direction, budget),
        Stage::Step(name) => pair
            .spec
            .map_or(Vec::new(), |spec| of_step(spec, name, direction)),
    }
}

fn of_state(pair: Pair<'_>, name: &Name, direction: Direction, budget: &Budget) -> Vec<Neighbour> {
    let Some(ladder) = pair.ladder else {
        return Vec::new();
    };
    let all = &ladder.analysis.successions();
    let mut found = accepted(pair.spec, name, direction);
    for (_, detail, (from, to)) in &mut found {
        let known = all.iter().find(|it| it.from == *from && it.to == *to);
        if let Some(condition) = known.and_then(|it| said(ladder, it, budget)) {
            *detail += &format!(", on {condition}");
        }
    }
    if found.is_empty() {
        let decided = pair.spec.map(Decided::of).unwrap_or_default();
        let open = all.iter().filter(|it| match direction {
            Direction::Before => it.to == *name,
            Direction::After => it.from == *name,
        });
        let open = open.filter(|it| decided.standing(&it.from, &it.to) != Standing::Rejected);
        found.extend(open.map(|it| {
            let evidence = it.evidence.word();
            let detail = match said(ladder, it, budget) {
                Some(condition) => format!("{evidence}, on {condition}"),
                None => evidence.to_owned(),
            };
            let other = match direction {
                Direction::Before => &it.from,
                Direction::After => &it.to,
            };
            (other.clone(), detail, (it.from.clone(), it.to.clone()))
        }));
    }
    let neighbours = found.into_iter().filter_map(|(other, detail, (from, _))| {
        Some(Neighbour {
            item: state(ladder, &other, Some(detail))?,
            from: vec![state(ladder, &from, None)?.at.name],
        })
    });
    neighbours.collect()
}

/// The condition of a suggestion, if a person can read it.
fn said(ladder: &Ladder, succession: &Succession, budget: &Budget) -> Option<String> {
    let condition = succession.condition.as_ref()?;
    legible(condition, &ladder.analysis.conditions, budget)
}

/// The other state of each accepted pair, how it was accepted, and the pair.
type Found = Vec<(Name, String, (Name, Name))>;

fn accepted(spec: Option<&Spec>, name: &Name, direction: Direction) -> Found {
    let decisions = spec.into_iter().flat_map(|it| &it.reading.spec.decisions);
    let mut found = Found::new();
    for decision in decisions {
        let Verdict::Accept { from, to } = &decision.verdict else {
            continue;
        };
        let how = match to.len() {
            1 => "accepted".to_owned(),
            count => format!("accepted as one of {count} together"),
        };
        for to in to {
            let (own, other) = match direction {
                Direction::Before => (to, from),
                Direction::After => (from, to),
            };
            if own == name {
                found.push((other.clone(), how.clone(), (from.clone(), to.clone())));
            }
        }
    }
    found
}

/// A state with its coil; of a step register's value, with what writes it.
fn state(ladder: &Ladder, name: &Name, detail: Option<String>) -> Option<Item> {
    let at = match ladder.analysis.states().find(name) {
        Some(_) => {
            let mut mentions = ladder.names().of(name);
            let coil = mentions.find(|it| it.usage == Usage::Written)?;
            let (rung, element) = crate::element(ladder.program(), coil.place?)?;
            Target::new(Side::Ladder, rung.place(element.within), coil.span)
        }
        None => value(ladder, name)?,
    };
    let described = || {
        let described = ladder.analysis.description(name);
        described.map_or_else(|| "state".to_owned(), |it| it.to_string())
    };
    Some(Item {
        stage: Stage::State(name.clone()),
        detail: detail.unwrap_or_else(described),
        at,
    })
}

/// What writes a value of a step register, else where the register is named.
fn value(ladder: &Ladder, state: &Name) -> Option<Target> {
    let mut registers = ladder.analysis.registers.iter();
    let register = registers.find(|register| {
        let mut states = register.states.iter();
        states.any(|it| register.state_name(it.value) == *state)
    })?;
    let mut arcs = register.arcs.iter();
    let written = arcs
        .find(|arc| register.state_name(arc.to) == *state)
        .and_then(|arc| arc.written_at.first());
    let span = match written {
        Some((_, span)) => *span,
        None => ladder.names().of(&register.name).next()?.span,
    };
    Some(Target::new(Side::Ladder, span, span))
}

fn of_step(spec: &Spec, name: &Name, direction: Direction) -> Vec<Neighbour> {
    let mut found = Vec::new();
    for transition in spec.reading.spec.grafcet.transitions() {
        let (own, others) = match direction {
            Direction::Before => (&transition.to, &transition.from),
            Direction::After => (&transition.from, &transition.to),
        };
        if !own.contains(name) {
            continue;
        }
        let rule = spec.reading.places.transition(&transition.name);
        for other in others {
            if let Some(item) = step(spec, other, Some(ruled(transition))) {
                found.push(Neighbour {
                    item,
                    from: rule.map(|it| it.span).into_iter().collect(),
                });
            }
        }
    }
    found
}

fn ruled(transition: &Transition) -> String {
    format!("{}, on {}", transition.name, transition.receptivity)
}

fn step(spec: &Spec, name: &Name, detail: Option<String>) -> Option<Item> {
    let declared = spec.reading.places.declaration(name, Role::Step)?;
    let step = spec.reading.spec.grafcet.step(name)?;
    let described = || match (&step.state, &step.comment) {
        (Some(state), Some(comment)) => format!("step for {state}, {comment}"),
        (Some(state), None) => format!("step for {state}"),
        (None, Some(comment)) => comment.to_string(),
        (None, None) => "step".to_owned(),
    };
    Some(Item {
        stage: Stage::Step(name.clone()),
        detail: detail.unwrap_or_else(described),
        at: Target::new(Side::Spec, declared.span, declared.span),
    })
}

impl Stage {
    /// Its name.
    pub fn name(&self) -> &Name {
        match self {
            Self::State(name) | Self::Step(name) => name,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LADDER: &str = "\
rung: (s + v1) * /ls2 -> v1 // fill
rung: (v1*ls2 + v2) * /ls3 -> v2
rung: (v2*ls3 + v3) * /s -> v3
";

    /// `name (detail)` of what is next to `stage`, with what leads there.
    fn next_to(spec: &str, stage: &Stage, direction: Direction) -> Vec<String> {
        let budget = Budget::default();
        let ladder = Ladder::read(LADDER.into(), &budget);
        let spec = Spec::read(spec.into());
        let pair = Pair {
            ladder: Some(&ladder),
            spec: Some(&spec),
        };
        let found = neighbours(pair, stage, direction, &budget);
        let shown = found.iter().map(|it| {
            let text = match it.item.at.side {
                Side::Ladder => &ladder.text,
                Side::Spec => &spec.text,
            };
            let from: Vec<&str> = it.from.iter().map(|it| &text[it.range()]).collect();
            let item = &it.item;
            assert_eq!(&text[item.at.name.range()], &**item.stage.name());
            format!(
                "{} ({}) by {}",
                item.stage.name(),
                item.detail,
                from.join(", ")
            )
        });
        shown.collect()
    }

    fn state(name: &str) -> Stage {
        Stage::State(name.into())
    }

    #[test]
    fn where_nothing_is_decided_suggestions_follow() {
        assert_eq!(
            next_to("", &state("v1"), Direction::After),
            ["v2 (handover, on ls2*/ls3) by v1"]
        );
        assert_eq!(
            next_to("", &state("v2"), Direction::Before),
            ["v1 (handover, on ls2*/ls3) by v1"]
        );
    }

    #[test]
    fn what_is_accepted_goes_before_and_what_is_rejected_is_gone() {
        assert_eq!(
            next_to("//! accept v1 -> v3 & v2", &state("v1"), Direction::After),
            [
                "v3 (accepted as one of 2 together) by v1",
                "v2 (accepted as one of 2 together, on ls2*/ls3) by v1",
            ]
        );
        let rejected = next_to("//! reject v1 -> v2", &state("v1"), Direction::After);
        assert_eq!(rejected, [""; 0]);
    }

    #[test]
    fn in_a_spec_transitions_lead_on() {
        let spec = "\
Step X0, Xv1 for v1, Xv2
Transitions:
t1: X0*s |- @Xv1*@Xv2
t2: Xv1*Xv2 |- @X0
";
        let step = |name: &str| Stage::Step(name.into());
        assert_eq!(
            next_to(spec, &step("X0"), Direction::After),
            [
                "Xv1 (t1, on s) by t1: X0*s |- @Xv1*@Xv2",
                "Xv2 (t1, on s) by t1: X0*s |- @Xv1*@Xv2",
            ]
        );
        assert_eq!(
            next_to(spec, &step("X0"), Direction::Before),
            [
                "Xv1 (t2, on 1) by t2: Xv1*Xv2 |- @X0",
                "Xv2 (t2, on 1) by t2: Xv1*Xv2 |- @X0",
            ]
        );
    }

    #[test]
    fn stages_are_found_in_both_texts() {
        let budget = Budget::default();
        let ladder = Ladder::read(LADDER.into(), &budget);
        let spec = Spec::read("Step X1 for v1\n//! accept v1 -> v2".into());
        let pair = Pair {
            ladder: Some(&ladder),
            spec: Some(&spec),
        };
        let at = |side, offset| stage_at(pair, side, offset).map(|it| it.stage);
        let on = |text: &str, part: &str| text.find(part).expect("in the text");
        assert_eq!(at(Side::Ladder, on(LADDER, "v1)")), Some(state("v1")));
        assert_eq!(at(Side::Ladder, on(LADDER, "ls2")), None);
        let step = Some(Stage::Step("X1".into()));
        assert_eq!(at(Side::Spec, on(&spec.text, "X1")), step);
        assert_eq!(at(Side::Spec, on(&spec.text, "v2")), Some(state("v2")));
    }
}
