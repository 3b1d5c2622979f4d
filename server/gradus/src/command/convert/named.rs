//! The states that somebody names on the command line.

use grafcet::Decision;
use ide::decide;
use logic::Name;
use recovery::Analysis;

use crate::report::printable;

/// The state that somebody calls `text`: by its name, or by its address. The
/// error names some that there are.
pub fn state(text: &str, analysis: &Analysis) -> Result<Name, String> {
    if let Some(state) = analysis.states().find(text) {
        return Ok(state.name.clone());
    }
    if let Some(value) = value(text, analysis) {
        return Ok(value);
    }
    let mut declarations = analysis.program.declarations.iter();
    let of_address = declarations.find(|it| it.address.as_deref() == Some(text));
    if let Some(state) = of_address.and_then(|it| analysis.states().find(&it.name)) {
        return Ok(state.name.clone());
    }
    let known: Vec<&str> = names(analysis).take(8).collect();
    Err(if known.is_empty() {
        format!(
            "there is no state `{}`: this ladder has none",
            printable(text)
        )
    } else {
        format!(
            "there is no state `{}`; there are {} ... (`gradus suggest` lists all)",
            printable(text),
            printable(&known.join(", "))
        )
    })
}

fn names(analysis: &Analysis) -> impl Iterator<Item = &str> {
    let groups = analysis.groups().iter();
    groups.flat_map(|group| group.states.iter().map(|name| &**name))
}

/// A value of a register: `Seq=10`.
fn value(text: &str, analysis: &Analysis) -> Option<Name> {
    let (register, value) = text.split_once('=')?;
    let value: i64 = value.trim().parse().ok()?;
    let mut registers = analysis.registers.iter();
    let register = registers.find(|it| *it.name == *register.trim())?;
    let mut states = register.states.iter();
    states
        .any(|state| state.value == value)
        .then(|| register.state_name(value))
}

/// Decides that sequences start in the states called `names`. In a group of
/// states that depend on each other they take the place of those decided
/// before.
pub fn start_in(
    names: &[String],
    analysis: &Analysis,
    decisions: &mut Vec<Decision>,
) -> Result<(), String> {
    let mut states = Vec::new();
    for text in names {
        let name = state(text, analysis)?;
        if analysis.states().find(&name).is_none() {
            return Err(format!(
                "`{}` cannot be made initial: where a step register starts is what the ladder \
                 moves into it",
                printable(&name)
            ));
        }
        states.push(name);
    }
    decide::start_in(&states, analysis, decisions);
    Ok(())
}
