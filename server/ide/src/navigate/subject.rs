use ::ladder::{Comparison, ElementKind, Role as RoutineRole, Value};
use grafcet::{Mention, Role};
use logic::{Name, Relation};
use recovery::conditions::Place;
use source::Span;

use super::{Access, Pair, Side};
use crate::{Ladder, Spec, Usage, element};

/// A thing that texts name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A variable of the ladder or of the spec: an input, a coil, a state.
    Variable(Name),
    /// A value of a step register, as a state of the ladder: `Seq=10`.
    Value(Name),
    /// A step that stands for no state, or for one of a ladder that is not
    /// there.
    Step(Name),
    /// A routine, as a place in the program.
    Routine(usize),
    /// A label of a routine.
    Label {
        /// The routine, as a place in the program.
        routine: usize,
        /// The label.
        name: Name,
    },
    /// What only the spec knows: a transition, a part, an instance.
    InSpec(Mention),
}

/// A subject where it is named.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Named {
    pub(super) subject: Subject,
    pub(super) span: Span,
    pub(super) access: Access,
}

/// What is named at the byte `offset` of one of the two texts.
pub fn subject(pair: Pair<'_>, side: Side, offset: usize) -> Option<Subject> {
    named(pair, side, offset).map(|it| it.subject)
}

pub(super) fn named(pair: Pair<'_>, side: Side, offset: usize) -> Option<Named> {
    match side {
        Side::Ladder => in_ladder(pair.ladder?, offset),
        Side::Spec => in_spec(pair.spec?, offset),
    }
}

fn in_ladder(ladder: &Ladder, offset: usize) -> Option<Named> {
    if let Some(mention) = ladder.names().at(offset)
        && ladder.is_variable(&mention.name)
    {
        return Some(Named {
            subject: Subject::Variable(mention.name.clone()),
            span: mention.span,
            access: mention.usage.into(),
        });
    }
    if let Some(place) = ladder.names().element_at(offset) {
        return in_element(ladder, place);
    }
    let mut routines = ladder.program().routines.iter().enumerate();
    routines.find_map(|(at, routine)| {
        let span = ladder.routine_name(routine)?;
        span.touches(offset).then_some(Named {
            subject: Subject::Routine(at),
            span,
            access: Access::Declared,
        })
    })
}

/// What an element is about where no variable in it is pointed at.
fn in_element(ladder: &Ladder, place: Place) -> Option<Named> {
    let (rung, element) = element(ladder.program(), place)?;
    let whole = rung.place(element.within);
    let (subject, span) = match &element.kind {
        ElementKind::Call(call) => (
            Subject::Routine(callee(ladder, place.routine, &call.routine.name)?),
            rung.place(call.routine.within),
        ),
        ElementKind::Jump(label) | ElementKind::Label(label) => (
            Subject::Label {
                routine: place.routine,
                name: label.name.clone(),
            },
            rung.place(label.within),
        ),
        ElementKind::Block(block) => (Subject::Routine(definition_of(ladder, &block.name)?), whole),
        kind => match state_of(ladder, kind) {
            Some(state) => (Subject::Value(state), whole),
            None => {
                let operand = match kind {
                    ElementKind::Contact(contact) => &contact.operand,
                    ElementKind::Coil(coil) => &coil.operand,
                    _ => return None,
                };
                let place = rung.place(operand.within);
                (Subject::Variable(operand.name.clone()), place)
            }
        },
    };
    let access = match &element.kind {
        ElementKind::Label(_) => Access::Declared,
        ElementKind::Coil(_) | ElementKind::Assign(_) => Access::Written,
        _ => Access::Read,
    };
    Some(Named {
        subject,
        span,
        access,
    })
}

/// The routine that a call in the routine at `caller` leads to.
pub(super) fn callee(ladder: &Ladder, caller: usize, name: &str) -> Option<usize> {
    let routines = &ladder.program().routines;
    let unit = &routines.get(caller)?.unit;
    routines
        .iter()
        .position(|it| it.unit == *unit && &*it.name == name)
}

/// The body of the block called `name` that the file defines.
pub(super) fn definition_of(ladder: &Ladder, name: &str) -> Option<usize> {
    let mut routines = ladder.program().routines.iter();
    routines.position(|it| it.role == RoutineRole::Definition && it.unit.eq_ignore_ascii_case(name))
}

/// The value of a step register that an element compares with or writes.
pub(crate) fn state_of(ladder: &Ladder, kind: &ElementKind) -> Option<Name> {
    let (number, value) = match kind {
        ElementKind::Comparison(Comparison {
            left,
            relation: Relation::Equal,
            right,
        }) => match (left.name.parse(), right.name.parse()) {
            (_, Ok(value)) => (&left.name, value),
            (Ok(value), _) => (&right.name, value),
            _ => return None,
        },
        kind => written(kind)?,
    };
    let mut registers = ladder.analysis.registers.iter();
    let register = registers.find(|it| it.name == *number)?;
    let known = register.states.iter().any(|it| it.value == value);
    known.then(|| register.state_name(value))
}

/// The number that an element writes a constant to, and that constant.
pub(crate) fn written(kind: &ElementKind) -> Option<(&Name, i64)> {
    let ElementKind::Assign(assignment) = kind else {
        return None;
    };
    match assignment.value {
        Value::Constant(value) => Some((&assignment.target.name, value)),
        _ => None,
    }
}

fn in_spec(spec: &Spec, offset: usize) -> Option<Named> {
    let mention = spec.reading.places.mention_at(offset)?;
    let subject = match mention.role {
        Role::Step => {
            let step = spec.reading.spec.grafcet.step(&mention.name);
            match step.and_then(|step| step.state.as_ref()) {
                Some(state) => of_state(state),
                None => Subject::Step(mention.name.clone()),
            }
        }
        Role::State => of_state(&mention.name),
        Role::Variable => Subject::Variable(mention.name.clone()),
        _ => Subject::InSpec(mention.clone()),
    };
    Some(Named {
        subject,
        span: mention.span,
        access: access(mention),
    })
}

/// A state as a ladder spells it: a coil, or a register and its value.
pub(crate) fn of_state(state: &Name) -> Subject {
    match state.split_once('=') {
        Some(_) => Subject::Value(state.clone()),
        None => Subject::Variable(state.clone()),
    }
}

pub(super) fn access(mention: &Mention) -> Access {
    match (mention.declares, mention.written) {
        (true, _) => Access::Declared,
        (false, true) => Access::Written,
        (false, false) => Access::Read,
    }
}

impl From<Usage> for Access {
    fn from(usage: Usage) -> Self {
        match usage {
            Usage::Declared => Self::Declared,
            Usage::Read => Self::Read,
            Usage::Written => Self::Written,
        }
    }
}
