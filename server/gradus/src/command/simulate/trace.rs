//! Inputs that somebody recorded, as a table: a column for each input, a row
//! for each moment.

use std::collections::HashMap;

use logic::notation::milliseconds;
use logic::{Datum, Name};
use scenario::{Change, Passing, Scenario, Step};
use source::Span;

/// The name of the column that says when.
const TIME: &str = "time";

/// The scenario that gives the inputs of a table in CSV, with commas,
/// semicolons or tabs, or what is wrong with it.
///
/// The first row names the inputs. A column called `time` holds milliseconds,
/// or times such as `1.5s`; a row then lasts until that of the next, and the
/// last one for a scan. Without it every row is a scan. A value is 0 or 1,
/// another number, `true` or `false`; an empty field leaves its input as it is.
pub fn read(bytes: &[u8]) -> Result<Scenario, String> {
    let mut table = csv::ReaderBuilder::new()
        .delimiter(delimiter(bytes))
        .trim(csv::Trim::All)
        .from_reader(bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes));
    let heads = table.headers().map_err(|error| error.to_string())?.clone();
    let is_time = |head: &str| head.eq_ignore_ascii_case(TIME);
    let names: Vec<Name> = heads.iter().map(Name::from).collect();
    if !names.iter().any(|name| !is_time(name)) {
        return Err("the first row names no input".to_owned());
    }
    let mut values: HashMap<Name, Datum> = HashMap::new();
    let mut steps: Vec<Step> = Vec::new();
    let mut last_time: Option<u64> = None;
    for record in table.records() {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let wrong = |text: &str| format!("line {line}: `{text}` is no value");
        let mut step = Step::default();
        for (name, field) in names.iter().zip(&record) {
            if is_time(name) {
                let now = field.parse().ok().or_else(|| milliseconds(field));
                let now: u64 = now.ok_or_else(|| wrong(field))?;
                let passed = now.checked_sub(last_time.unwrap_or(now));
                let passed = passed.ok_or_else(|| format!("line {line}: time runs backwards"))?;
                if let Some(before) = steps.last_mut() {
                    before.passing = Passing::Wait(passed);
                }
                last_time = Some(now);
            } else if !field.is_empty() {
                let value = value(field).ok_or_else(|| wrong(field))?;
                let before = values.insert(name.clone(), value).unwrap_or_default();
                if before.key() != value.key() {
                    step.changes.push(Change {
                        name: name.clone(),
                        value,
                        span: Span::default(),
                    });
                }
            }
        }
        steps.push(step);
    }
    Ok(Scenario {
        steps: joined(steps),
        ..Scenario::default()
    })
}

/// The scenario without the changes of inputs that nothing knows: recorders
/// write more than a program reads.
pub fn without(scenario: Scenario, is_known: impl Fn(&str) -> bool) -> Scenario {
    let mut steps = scenario.steps;
    for step in &mut steps {
        step.changes.retain(|change| is_known(&change.name));
    }
    Scenario {
        steps: joined(steps),
        ..scenario
    }
}

/// Rows that change nothing are one step with the row before them.
fn joined(steps: Vec<Step>) -> Vec<Step> {
    let mut joined: Vec<Step> = Vec::new();
    for step in steps {
        let together = match (joined.last(), step.changes.is_empty()) {
            (Some(last), true) => match (last.passing, step.passing) {
                (Passing::Wait(one), Passing::Wait(other)) => {
                    Some(Passing::Wait(one.saturating_add(other)))
                }
                (Passing::Scans(one), Passing::Scans(other)) => {
                    Some(Passing::Scans(one.saturating_add(other)))
                }
                _ => None,
            },
            _ => None,
        };
        match (joined.last_mut(), together) {
            (Some(last), Some(together)) => last.passing = together,
            _ => joined.push(step),
        }
    }
    joined
}

/// 0 and 1 are off and on, as most recorders write bits.
fn value(field: &str) -> Option<Datum> {
    match Datum::constant(field)? {
        Datum::Integer(0) => Some(false.into()),
        Datum::Integer(1) => Some(true.into()),
        other => Some(other),
    }
}

/// The sign that the first row has most of.
fn delimiter(bytes: &[u8]) -> u8 {
    let head = bytes.split(|byte| *byte == b'\n').next().unwrap_or(bytes);
    let count = |sign: u8| head.iter().filter(|byte| **byte == sign).count();
    let signs = [b'\t', b';', b','];
    signs
        .into_iter()
        .max_by_key(|sign| count(*sign))
        .unwrap_or(b',')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The scenario that a table gives, as text.
    fn scenario(table: &str) -> Result<String, String> {
        read(table.as_bytes()).map(|scenario| scenario::write(&scenario))
    }

    #[test]
    fn a_row_is_a_scan() {
        let table = "s,ls1,Level\n1,0,\n0,1,50\n0,1,50\n0,1,50\n1,1,7.5\n";
        let expected = "on s\noff s, on ls1, Level = 50, scan 3\non s, Level = 7.5\n";
        assert_eq!(scenario(table).as_deref(), Ok(expected));
    }

    #[test]
    fn a_row_lasts_until_the_time_of_the_next() {
        let table = "\u{feff}Time;s;\"a;b\"\r\n100;true;\r\n1.5s;;1\r\n2s;;\r\n2500;0;\r\n";
        let expected = "on s, wait 1s400ms\non \"a;b\", wait 1s\noff s\n";
        assert_eq!(scenario(table).as_deref(), Ok(expected));
    }

    #[test]
    fn what_is_no_table_is_said() {
        let cases = [
            ("", "the first row names no input"),
            ("time\n1\n", "the first row names no input"),
            ("s\nyes\n", "line 2: `yes` is no value"),
            ("time,s\n5,1\n4,0\n", "line 3: time runs backwards"),
        ];
        for (table, expected) in cases {
            assert_eq!(scenario(table), Err(expected.to_owned()), "{table}");
        }
    }
}
