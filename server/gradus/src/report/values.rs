use logic::{Datum, Name};
use serde_json::{Value, json};

use super::printable;

/// The variables that are on, numbers with their values, in the cell of a table;
/// `-` if none is.
pub fn on<'v>(values: impl Iterator<Item = (&'v Name, &'v Datum)>) -> String {
    let on: Vec<String> = values
        .filter(|(_, value)| value.is_on())
        .map(|(name, value)| match value {
            Datum::Bool(_) => printable(name),
            number => format!("{}={number}", printable(name)),
        })
        .collect();
    match on.is_empty() {
        true => "-".to_owned(),
        false => on.join(" "),
    }
}

/// A value in JSON.
pub fn value(value: Datum) -> Value {
    match value {
        Datum::Bool(on) => json!(on),
        Datum::Integer(number) => json!(number),
        Datum::Real(number) => json!(number),
    }
}
