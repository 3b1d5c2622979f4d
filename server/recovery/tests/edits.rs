//! What is recovered from a program that is edited, step by step.
//!
//! Whatever the edits were, in the end it is what is recovered from the last
//! text at once; and each edit costs what it touches.

use std::fmt::Write as _;
use std::sync::Arc;

use ladder::{Edition, Program, reread};
use logic::{Budget, Function, Stop, notation};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use recovery::{Analysis, Anew, analyse, analyse_after};

fn read(text: &str) -> Arc<Program> {
    ladder::read(text.as_bytes()).program
}

/// All that is known of a program, in words.
fn said(analysis: &Analysis) -> String {
    let (conditions, budget) = (&analysis.conditions, &Budget::default());
    let says = |function: &Function| match conditions.expr(function, budget) {
        Ok(expr) => notation::write(&expr),
        Err(stop) => format!("{stop:?}"),
    };
    let says_of = |function: &Result<Function, Stop>| match function {
        Ok(function) => says(function),
        Err(stop) => format!("{stop:?}"),
    };
    let named = |atom| conditions.atoms.atom(atom).to_string();
    let mut out = String::new();
    for (_, atom) in conditions.atoms.iter() {
        let _ = write!(out, "{atom} ");
    }
    for variable in &conditions.variables {
        let _ = write!(out, "\n{} = {}", variable.name, says_of(&variable.next));
        let closed = variable.closed_contacts.iter().map(|it| named(*it));
        let _ = write!(out, " {:?}", closed.collect::<Vec<_>>());
        for write in &variable.writes {
            let parts = [&write.guard, &write.solved, &write.zone].map(says_of);
            let _ = write!(out, "\n  {:?} {parts:?}", write.place);
        }
    }
    let mut opaque: Vec<_> = conditions.opaque.iter().map(|it| named(*it)).collect();
    opaque.sort();
    let timers = conditions.timers.iter();
    let mut timers: Vec<_> = timers
        .map(|(atom, law)| (named(*atom), law.kind, says_of(&law.input)))
        .collect();
    timers.sort_by(|a, b| a.0.cmp(&b.0));
    let _ = write!(out, "\n{opaque:?} {timers:?}");
    for write in &conditions.register_writes {
        let _ = write!(
            out,
            "\n{} at {:?} when {}",
            write.target,
            write.place,
            says_of(&write.guard)
        );
    }
    for register in &analysis.registers {
        let arcs = register.arcs.iter();
        let arcs = arcs.map(|arc| (arc.from, arc.to, says(&arc.condition)));
        let _ = write!(out, "\n{} {:?}", register.name, arcs.collect::<Vec<_>>());
    }
    for state in &analysis.states().states {
        let parts = [
            &state.plain,
            &state.next,
            &state.turns_on,
            &state.deactivation,
        ]
        .map(says);
        let interlocks = state.interlocks.iter().map(|it| named(*it));
        let interlocks: Vec<_> = interlocks.collect();
        let _ = write!(
            out,
            "\n{} {:?} {parts:?} {interlocks:?}",
            state.name, state.holding
        );
    }
    for stored in &analysis.states().stored {
        let _ = write!(
            out,
            "\n{} {} {}",
            stored.name,
            says(&stored.set),
            says(&stored.reset)
        );
    }
    for succession in analysis.successions() {
        let (from, to) = (&succession.from, &succession.to);
        let when = succession.condition.as_ref().map(says);
        let _ = write!(
            out,
            "\n{from} -> {to} {:?} {:?} {when:?}",
            succession.evidence, succession.kind
        );
    }
    for group in analysis.groups() {
        let _ = write!(out, "\n{group:?}");
    }
    for finding in analysis.findings(usize::MAX) {
        let related: Vec<_> = finding
            .related
            .iter()
            .map(|it| (it.span, &it.message))
            .collect();
        let _ = write!(
            out,
            "\n{} {:?} {} {related:?}",
            finding.code, finding.span, finding.message
        );
    }
    out
}

/// Rungs that share a few names, of every kind that conditions treat in a way
/// of its own. `#` becomes a number.
const RUNGS: &[&str] = &[
    "rung: (a# + q#) * /b# -> q#",
    "rung: (q#*a# + q#) * /q# -> q#",
    "rung: a# * /q# -> set q#",
    "rung: q# * b# -> reset q#, set q#",
    "rung: (q#*t#.Q + q#) * /q# -> q#",
    "rung: q# -> TON(t#, 5s)",
    "rung: a# * /t#.Q -> TON(t#, 5s)",
    "rung: q# * t#.Q -> y#",
    "rung: (y# + q#) * /y# -> q#",
    "rung: rise(a#*b#) * q# -> y#",
    "rung: rise(rise(a#)*/b#) -> set q#",
    "rung: Seq = # * a# -> Seq := #",
    "rung: Seq = # * q# -> Seq := Seq + 1",
    "rung: 1 -> Word := Next",
    "rung: Word.# * a# -> set Next.#",
    "rung: b# -> PID(loop#, IN := level, OUT => y#)",
    "rung: a# -> call Sub",
    "rung: b# -> MCR()",
    "rung label l#: a# -> y#",
    "rung: b# -> jump l#",
    "rung: a# -> q#, (q#*b# -> set q#)",
    "routine Sub",
    "input a# %I#",
    "output q# %Q#",
    "",
    "// nothing",
];

fn lines() -> impl Strategy<Value = String> {
    (select(RUNGS), vec(0..4_u8, 6)).prop_map(|(rung, numbers)| {
        let mut numbers = numbers.into_iter().cycle();
        let letter = |c| match c {
            '#' => numbers.next().unwrap_or(0).to_string(),
            c => c.to_string(),
        };
        rung.chars().map(letter).collect()
    })
}

/// What somebody does to a line.
#[derive(Clone, Debug)]
enum Edit {
    Insert(String),
    Replace(String),
    Remove,
    /// One of its digits becomes another, and with it a name another name.
    Type(Index, u8),
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        1 => lines().prop_map(Edit::Insert),
        1 => lines().prop_map(Edit::Replace),
        1 => Just(Edit::Remove),
        6 => (any::<Index>(), 0..5_u8).prop_map(|(at, digit)| Edit::Type(at, digit)),
    ]
}

fn typed(line: &str, digit: Index, number: u8) -> String {
    let digits: Vec<usize> = line
        .match_indices(|c: char| c.is_ascii_digit())
        .map(|it| it.0)
        .collect();
    let mut line = line.to_owned();
    if !digits.is_empty() {
        let at = digits[digit.index(digits.len())];
        line.replace_range(at..at + 1, &number.to_string());
    }
    line
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]
    #[test]
    fn any_edits_leave_what_the_last_text_says(
        mut text in vec(lines(), 0..14),
        edits in vec((any::<Index>(), edit()), 1..8),
        asked in vec(any::<bool>(), 8),
    ) {
        let budget = Budget::default();
        let mut edition = Edition::new(text.join("\n").into());
        let mut analysis = analyse(&edition.reading.program, &budget);
        for ((at, edit), asked) in edits.into_iter().zip(asked) {
            if asked {
                analysis.groups();
                analysis.findings(usize::MAX);
            }
            let at = at.index(text.len() + 1);
            match edit {
                Edit::Insert(line) => text.insert(at, line),
                Edit::Replace(line) if at < text.len() => text[at] = line,
                Edit::Remove if at < text.len() => drop(text.remove(at)),
                Edit::Type(digit, number) if at < text.len() => {
                    text[at] = typed(&text[at], digit, number);
                }
                _ => {}
            }
            edition = reread(&edition, text.join("\n").into());
            analysis = analyse_after(&analysis, &edition.reading.program, &budget);
        }
        let at_once = analyse(&read(&text.join("\n")), &budget);
        prop_assert_eq!(said(&analysis), said(&at_once));
    }
}

#[test]
fn an_output_that_only_its_timer_asks_for_any_more_stays() {
    let budget = Budget::default();
    let texts = [
        "rung: a * /t.Q -> TON(t, 5s)\nrung: t.Q -> y",
        "rung: a * /b -> TON(t, 5s)\nrung: t.Q -> y",
        "rung: a * /b -> TON(t, 5s)\nrung: b -> y",
    ];
    let mut edition = Edition::new(texts[0].into());
    let mut analysis = analyse(&edition.reading.program, &budget);
    for text in &texts[1..] {
        edition = reread(&edition, (*text).into());
        analysis = analyse_after(&analysis, &edition.reading.program, &budget);
        assert_eq!(said(&analysis), said(&analyse(&read(text), &budget)));
    }
}

/// A plant of so many machines, three rungs each, and a stop button in all.
fn plant(machines: usize) -> Vec<String> {
    let machine = |m: usize| {
        [
            format!("rung: (start{m} + fill{m}) * /full{m} * /stop -> fill{m}"),
            format!("rung: (full{m}*/fill{m} + heat{m}) * /hot{m} * /stop -> heat{m}"),
            format!("rung: (hot{m}*/heat{m} + drain{m}) * /empty{m} * /stop -> drain{m}"),
        ]
    };
    (0..machines).flat_map(machine).collect()
}

/// What an edit of one line of a plant of `machines` machines costs.
fn cost(machines: usize, line: usize, edited: &str) -> Anew {
    let budget = Budget::default();
    let mut text = plant(machines);
    let edition = Edition::new(text.join("\n").into());
    let before = analyse(&edition.reading.program, &budget);
    assert_eq!(before.anew().rungs, 3 * machines);
    text[line] = edited.to_owned();
    let edition = reread(&edition, text.join("\n").into());
    analyse_after(&before, &edition.reading.program, &budget).anew()
}

#[test]
fn an_edit_in_one_of_ten_thousand_rungs_costs_that_rung_and_what_depends_on_it() {
    let edited = "rung: (full9*/fill9*a + heat9) * /hot9 * /stop -> heat9";
    let expected = Anew {
        rungs: 1,
        variables: 1,
        states: 1,
        pairs: 0,
    };
    let found = cost(3_334, 28, edited);
    // The pairs are as many as in a plant of a few machines.
    assert_eq!(Anew { pairs: 0, ..found }, expected);
    assert_eq!(found.pairs, cost(30, 28, edited).pairs);
}

#[test]
fn an_edit_that_changes_no_condition_costs_no_more_than_its_rung() {
    let same = "rung:  (full9*/fill9 + heat9) * /hot9 * /stop -> heat9 // the same";
    let (rungs, variables, states, pairs) = (1, 0, 0, 0);
    let expected = Anew {
        rungs,
        variables,
        states,
        pairs,
    };
    assert_eq!(cost(20, 28, same), expected);
}

#[test]
fn a_rung_that_is_added_costs_itself() {
    let two = "rung: lamp1 -> lamp2\nrung: (full9*/fill9 + heat9) * /hot9 * /stop -> heat9";
    assert_eq!(cost(20, 28, two).rungs, 1);
}

#[test]
fn a_coil_with_another_name_costs_the_rungs_that_name_it() {
    let renamed = "rung: (full9*/fill9 + heat9) * /hot9 * /stop -> heat99";
    // The rung itself and the two that read the old name, now an input.
    let found = cost(20, 28, renamed);
    assert_eq!((found.rungs, found.variables), (2, 2));
}
