use grafcet::{Action, ActionKind, Effect, Grafcet, Situation, StepKind, Transition, Trigger};
use logic::Name;
use logic::notation::{quoted, write};
use serde_json::{Value, json};

/// The grafcet as the JSON of `gradus generate --to json`.
///
/// ```text
/// {"name",
///  "steps": [{"name", "initial", "state", "macro"}],
///  "transitions": [{"name", "from": [], "to": [], "receptivity"}],
///  "actions": [{"step", "kind", "output", "condition"}],
///  "inputs": [], "outputs": []}
/// ```
///
/// * The steps, transitions and actions are those of all charts; instances are
///   written out, and reusable grafcets are left out.
/// * `state` is the state of the ladder that the step stands for, and `macro`
///   the name of a macro-step's expansion; `null` where there is none.
/// * `receptivity` and `condition` are in the notation of expressions; a
///   condition is `null` where the action has none.
/// * `kind` is one of the words of [`action_kind`].
/// * A delay or a limit is part of the condition (`5s/p2*/9s/p2`); the event
///   of a stored action is its condition, beside any other.
/// * `output` of an assignment is `C := C + 1`, of a forcing order
///   `G2{p20, p21}`.
/// * `inputs` and `outputs` are names.
pub fn to_json(grafcet: &Grafcet) -> Value {
    let grafcet = grafcet.instantiated();
    let steps = grafcet.steps().map(|step| {
        let expansion = match &step.kind {
            StepKind::Macro(expansion) => Some(&**expansion),
            StepKind::Plain | StepKind::Enclosing(_) => None,
        };
        json!({
            "name": &*step.name,
            "initial": step.initial,
            "state": step.state.as_deref(),
            "macro": expansion,
        })
    });
    json!({
        "name": grafcet.name.as_deref(),
        "steps": steps.collect::<Vec<Value>>(),
        "transitions": grafcet.transitions().map(transition).collect::<Vec<Value>>(),
        "actions": grafcet.actions().map(action).collect::<Vec<Value>>(),
        "inputs": names(grafcet.inputs.iter().map(|variable| &variable.name)),
        "outputs": names(grafcet.outputs.iter().map(|variable| &variable.name)),
    })
}

fn names<'n>(names: impl Iterator<Item = &'n Name>) -> Value {
    names.map(|name| Value::from(&**name)).collect()
}

fn transition(transition: &Transition) -> Value {
    json!({
        "name": &*transition.name,
        "from": names(transition.from.iter()),
        "to": names(transition.to.iter()),
        "receptivity": write(&transition.receptivity),
    })
}

fn action(action: &Action) -> Value {
    let condition = match &action.kind {
        ActionKind::Stored {
            on: Trigger::Event(event),
            ..
        } => {
            let condition = action.condition.iter().cloned();
            let mut parts: Vec<_> = [event.clone()].into_iter().chain(condition).collect();
            match parts.len() {
                1 => parts.pop(),
                _ => Some(logic::Expr::And(parts)),
            }
        }
        _ => action.whole_condition(),
    };
    json!({
        "step": &*action.step,
        "kind": action_kind(&action.kind),
        "output": output(action),
        "condition": condition.as_ref().map(write),
    })
}

fn output(action: &Action) -> String {
    match &action.kind {
        ActionKind::Stored {
            effect: Effect::Assign(term),
            ..
        } => format!("{} := {term}", quoted(&action.output)),
        ActionKind::Forcing(situation) => {
            let inside = match situation {
                Situation::Steps(steps) => {
                    let steps: Vec<String> = steps.iter().map(|step| quoted(step)).collect();
                    steps.join(", ")
                }
                Situation::Current => "*".to_owned(),
                Situation::Initial => "INIT".to_owned(),
            };
            format!("{}{{{inside}}}", quoted(&action.output))
        }
        _ => action.output.to_string(),
    }
}

/// The word for a kind of action, stable for ever: `continuous`, `set`,
/// `reset`, `assign`, these three followed by `-on-deactivation` or
/// `-on-event` where that is when they act, and `force`.
pub fn action_kind(kind: &ActionKind) -> &'static str {
    match kind {
        ActionKind::Continuous { .. } => "continuous",
        ActionKind::Forcing(_) => "force",
        ActionKind::Stored { effect, on } => match (effect, on) {
            (Effect::Set, Trigger::Activation) => "set",
            (Effect::Set, Trigger::Deactivation) => "set-on-deactivation",
            (Effect::Set, Trigger::Event(_)) => "set-on-event",
            (Effect::Reset, Trigger::Activation) => "reset",
            (Effect::Reset, Trigger::Deactivation) => "reset-on-deactivation",
            (Effect::Reset, Trigger::Event(_)) => "reset-on-event",
            (Effect::Assign(_), Trigger::Activation) => "assign",
            (Effect::Assign(_), Trigger::Deactivation) => "assign-on-deactivation",
            (Effect::Assign(_), Trigger::Event(_)) => "assign-on-event",
        },
    }
}
