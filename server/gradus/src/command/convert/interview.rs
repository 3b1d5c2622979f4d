//! `--interactive`: the expert is asked state by state.
//!
//! Questions and answers are plain lines, so that they work on any terminal,
//! over any connection and with a screen reader. Every answer is saved before
//! the next question: whoever stops, by `quit`, the end of input or Ctrl-C, goes
//! on there the next time.

use std::collections::BTreeSet;

use ide::decide;
use logic::Name;
use recovery::successions::{Evidence, Kind, Succession};

use super::conversion::Conversion;
use super::named;
use crate::condition::broken;
use crate::input::numbered;
use crate::io::Io;
use crate::program;
use crate::report::printable;
use crate::status::Status;

const HELP: &str = concat!(
    "  a  accept     the state on the right follows the one on the left\n",
    "  t  together   it follows, and starts together with others\n",
    "  r  reject     it does not follow\n",
    "  l  later      not now; ask the next time\n",
    "  n  next       nothing more about the state on the left this time\n",
    "  i  initial    a sequence starts in the state on the left\n",
    "  q  quit       stop here; all answers are saved\n",
);

const PROMPT: &str = "  [a]ccept [t]ogether [r]eject [l]ater [n]ext [i]nitial [q]uit [?] > ";

/// An answer to a question.
enum Answer {
    Accept,
    Together,
    Reject,
    Later,
    Next,
    Initial,
    Quit,
    Help,
}

impl Answer {
    /// The answer that begins with the first letter of `line`.
    fn parse(line: &str) -> Option<Self> {
        Some(match line.trim().chars().next()?.to_ascii_lowercase() {
            'a' => Self::Accept,
            't' => Self::Together,
            'r' => Self::Reject,
            'l' => Self::Later,
            'n' => Self::Next,
            'i' => Self::Initial,
            'q' => Self::Quit,
            'h' | '?' => Self::Help,
            _ => return None,
        })
    }
}

/// Asks about every open suggestion, and saves every answer.
pub fn hold(conversion: &mut Conversion<'_>, io: &mut Io) -> std::io::Result<Status> {
    if let Err(failure) = conversion.save() {
        io.complain(&failure);
        return Ok(Status::Usage);
    }
    // What was put off is not asked again in this run.
    let mut later: BTreeSet<(Name, Name)> = BTreeSet::new();
    let mut shown: Option<Name> = None;
    while let Some(succession) = next(conversion, &later) {
        if io.cancel().is_cancelled() {
            return Ok(Status::Interrupted);
        }
        let pair = (succession.from.clone(), succession.to.clone());
        if shown.as_ref() != Some(&pair.0) {
            io.aside(&introduction(&pair.0, conversion))?;
            shown = Some(pair.0.clone());
        }
        io.aside(&question(succession, conversion))?;
        match ask(io)? {
            Answer::Accept => decide::accept(&mut conversion.decisions, &pair.0, &[pair.1]),
            Answer::Together => {
                let Some(company) = company(succession, conversion, io)? else {
                    continue;
                };
                decide::accept(&mut conversion.decisions, &pair.0, &company);
            }
            Answer::Reject => decide::reject(&mut conversion.decisions, &pair.0, &pair.1),
            Answer::Initial => {
                let analysis = conversion.analysis;
                let states = std::slice::from_ref(&pair.0);
                decide::start_in(states, analysis, &mut conversion.decisions);
            }
            Answer::Later => {
                later.insert(pair);
                continue;
            }
            Answer::Next => {
                let open = conversion.open().into_iter();
                let of_state = open.filter(|it| it.from == pair.0);
                later.extend(of_state.map(|it| (it.from.clone(), it.to.clone())));
                continue;
            }
            Answer::Help => {
                io.aside(HELP)?;
                continue;
            }
            Answer::Quit => break,
        }
        if let Err(failure) = conversion.save() {
            io.complain(&failure);
            return Ok(Status::Usage);
        }
        io.aside("  saved\n")?;
    }
    io.aside("\n")?;
    Ok(Status::Done)
}

/// The next suggestion to ask about: states in the order of the ladder, for
/// each the best first.
fn next<'a>(conversion: &Conversion<'a>, later: &BTreeSet<(Name, Name)>) -> Option<&'a Succession> {
    let states = &conversion.analysis.states();
    let is_now = |it: &&Succession| !later.contains(&(it.from.clone(), it.to.clone()));
    let place = |it: &&Succession| {
        states
            .find(&it.from)
            .and_then(|from| states.place(from.atom))
    };
    let open = conversion.open().into_iter().filter(is_now);
    // The first of equal ones: they stand best first.
    open.min_by_key(place)
}

fn introduction(state: &Name, conversion: &Conversion<'_>) -> String {
    let mut text = format!("\n{}", printable(state));
    if let Some(description) = program::description(conversion.analysis, state) {
        text += &format!("  {}", printable(&description));
    }
    if let Some(condition) = conversion.ends_on(state) {
        text += &format!("\n  ends when {}", broken(&printable(&condition), 12));
    }
    let open = conversion.open();
    let here = open.iter().filter(|it| it.from == *state).count();
    let here = numbered(here, "suggestion");
    text + &format!("\n  {here}, of {} open\n", open.len())
}

fn question(succession: &Succession, conversion: &Conversion<'_>) -> String {
    let (from, to) = (printable(&succession.from), printable(&succession.to));
    let mut text = format!("\n  {from} -> {to}");
    if let Some(description) = program::description(conversion.analysis, &succession.to) {
        text += &format!("  {}", printable(&description));
    }
    text += match succession.evidence {
        Evidence::Written => "\n  written: a write says so",
        Evidence::Handover => "\n  handover: what ends the one is what starts the other",
        Evidence::Witnessed => {
            "\n  witnessed: the one was seen to end in the scan that starts the other"
        }
        Evidence::Delayed => {
            "\n  delayed: the one was seen to start after a wait, once the other had ended"
        }
        Evidence::Possible => "\n  possible: both conditions can hold together",
    };
    let others = usual_company(succession, conversion);
    if !others.is_empty() {
        text += &format!(", together with {}", printable(&others.join(", ")));
    }
    let condition = conversion.condition(succession);
    let condition = condition
        .as_deref()
        .unwrap_or("a condition too long to show");
    text += &format!("\n  when {}\n", broken(&printable(condition), 7));
    if let Some(witness) = &succession.witness {
        text += &format!("  seen after {}\n", printable(&witness.in_words()));
    }
    text
}

/// Asks until there is an answer. The end of input is one.
fn ask(io: &mut Io) -> std::io::Result<Answer> {
    loop {
        io.aside(PROMPT)?;
        match io.line()? {
            None => return Ok(Answer::Quit),
            Some(line) => match Answer::parse(&line) {
                Some(answer) => return Ok(answer),
                None => io.aside(HELP)?,
            },
        }
    }
}

/// The states that are to start together with the one suggested, itself first.
/// `None` if nobody is named.
fn company(
    succession: &Succession,
    conversion: &Conversion<'_>,
    io: &mut Io,
) -> std::io::Result<Option<Vec<Name>>> {
    let usual = usual_company(succession, conversion);
    loop {
        let offer = match usual.is_empty() {
            true => String::new(),
            false => format!(" [{}]", printable(&usual.join(", "))),
        };
        io.aside(&format!("  together with which{offer} > "))?;
        let Some(line) = io.line()? else {
            return Ok(None);
        };
        let mut company = vec![succession.to.clone()];
        if line.trim().is_empty() {
            company.extend(usual.iter().cloned());
            return Ok((company.len() > 1).then_some(company));
        }
        let named: Result<Vec<Name>, String> = line
            .split([',', '&', ' '])
            .filter(|name| !name.is_empty())
            .map(|name| named::state(name, conversion.analysis))
            .collect();
        match named {
            Ok(named) => {
                for name in named {
                    if !company.contains(&name) && name != succession.from {
                        company.push(name);
                    }
                }
                return Ok((company.len() > 1).then_some(company));
            }
            Err(reason) => io.aside(&format!("  {reason}\n"))?,
        }
    }
}

/// The other followers that start together with the one suggested, as far as
/// they are not rejected.
fn usual_company(succession: &Succession, conversion: &Conversion<'_>) -> Vec<Name> {
    if succession.kind != Kind::And {
        return Vec::new();
    }
    let is_rejected = |to: &Name| {
        conversion.decisions.iter().any(|decision| {
            matches!(&decision.verdict, grafcet::Verdict::Reject { from, to: rejected }
                if *from == succession.from && rejected == to)
        })
    };
    let all = conversion.analysis.successions().iter();
    all.filter(|it| it.kind == Kind::And && it.evidence == succession.evidence)
        .filter(|it| it.from == succession.from && it.to != succession.to)
        .map(|it| it.to.clone())
        .filter(|to| !is_rejected(to))
        .collect()
}
