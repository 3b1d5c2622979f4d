//! Settings as one place gives them: some of all that there are.

use std::fmt;

use serde_json::{Map, Value};

use super::Config;

/// What one place sets, as far as it was understood.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer(Map<String, Value>);

/// Something in a layer that was not understood.
#[derive(Clone, Debug, PartialEq)]
pub struct Complaint {
    /// The keys that lead to it, from the outside.
    pub keys: Vec<String>,
    /// Which element of the list that is there.
    pub element: Option<usize>,
    /// Why.
    pub wrong: Wrong,
}

/// Why something was not understood.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// There is no such key.
    Key {
        /// Those that there are in its place.
        known: Vec<String>,
    },
    /// The value is none that the key can have.
    Value {
        /// What could be there.
        expected: String,
        /// What is there.
        found: Value,
    },
}

impl Layer {
    /// What of `settings` is understood, and what is not. One mistake costs
    /// only itself.
    pub fn read(settings: &Map<String, Value>) -> (Self, Vec<Complaint>) {
        let mut reading = Reading::default();
        let known = all();
        let understood = reading.table(settings, &known);
        (Self(understood), reading.complaints)
    }

    /// What holds where both say something is what `upper` says.
    pub fn under(&self, upper: &Self) -> Self {
        let mut both = self.0.clone();
        put_over(&mut both, &upper.0);
        Self(both)
    }

    /// The settings, with what is usual where nothing was set.
    pub fn config(&self) -> Config {
        // Nothing was understood but what can be read alone, so all can.
        serde_json::from_value(Value::Object(self.0.clone())).unwrap_or_default()
    }
}

fn put_over(lower: &mut Map<String, Value>, upper: &Map<String, Value>) {
    for (key, value) in upper {
        match (lower.get_mut(key), value) {
            (Some(Value::Object(below)), Value::Object(above)) => put_over(below, above),
            _ => {
                lower.insert(key.clone(), value.clone());
            }
        }
    }
}

/// All settings as they are usually.
fn all() -> Map<String, Value> {
    match serde_json::to_value(Config::default()) {
        Ok(Value::Object(all)) => all,
        _ => Map::new(),
    }
}

/// Settings that are being read.
#[derive(Debug, Default)]
struct Reading {
    /// The keys that lead to what is read now.
    keys: Vec<String>,
    complaints: Vec<Complaint>,
}

impl Reading {
    fn table(
        &mut self,
        given: &Map<String, Value>,
        known: &Map<String, Value>,
    ) -> Map<String, Value> {
        let mut understood = Map::new();
        for (key, value) in given {
            self.keys.push(key.clone());
            let read = match known.get(key) {
                Some(usual) => self.value(value, usual),
                None => {
                    let known = known.keys().cloned().collect();
                    self.complain(None, Wrong::Key { known });
                    None
                }
            };
            self.keys.pop();
            understood.extend(read.map(|value| (key.clone(), value)));
        }
        understood
    }

    fn value(&mut self, given: &Value, usual: &Value) -> Option<Value> {
        match (given, usual) {
            (Value::Object(given), Value::Object(known)) => {
                Some(Value::Object(self.table(given, known)))
            }
            (Value::Array(given), Value::Array(_)) => {
                let mut understood = Vec::new();
                for (at, element) in given.iter().enumerate() {
                    let found = element.clone();
                    if self.can_be(Value::Array(vec![found.clone()])) {
                        understood.push(found);
                    } else {
                        let expected = "the code of a finding, such as \"G2004\"".to_owned();
                        self.complain(Some(at), Wrong::Value { expected, found });
                    }
                }
                Some(Value::Array(understood))
            }
            _ if !usual.is_object() && self.can_be(given.clone()) => Some(given.clone()),
            _ => {
                let expected = self.expected(usual);
                let found = given.clone();
                self.complain(None, Wrong::Value { expected, found });
                None
            }
        }
    }

    /// Why `value` cannot stand where the keys lead.
    fn refusal(&self, value: Value) -> Option<serde_json::Error> {
        let keys = self.keys.iter().rev();
        let whole = keys.fold(value, |inner, key| {
            Value::Object(Map::from_iter([(key.clone(), inner)]))
        });
        serde_json::from_value::<Config>(whole).err()
    }

    fn can_be(&self, value: Value) -> bool {
        self.refusal(value).is_none()
    }

    /// What could stand where the keys lead, and usually is `usual`.
    fn expected(&self, usual: &Value) -> String {
        match usual {
            Value::Object(known) => {
                let keys: Vec<_> = known.keys().map(|key| format!("`{key}`")).collect();
                format!("a table of {}", keys.join(", "))
            }
            Value::Bool(_) => "true or false".to_owned(),
            Value::Number(_) => "a whole number, 1 or more".to_owned(),
            Value::Array(_) => "a list of codes, such as [\"G2004\"]".to_owned(),
            // A word that is none of the choices: the error lists them.
            Value::String(_) | Value::Null => {
                let error = self.refusal(Value::String(String::new()));
                let error = error.map(|it| it.to_string()).unwrap_or_default();
                let choices = error.split_once("expected ").map_or("", |(_, it)| it);
                choices.replace('`', "\"")
            }
        }
    }

    fn complain(&mut self, element: Option<usize>, wrong: Wrong) {
        self.complaints.push(Complaint {
            keys: self.keys.clone(),
            element,
            wrong,
        });
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = self.keys.join(".");
        match &self.wrong {
            Wrong::Key { .. } => write!(f, "there is no setting `{key}`"),
            Wrong::Value { expected, found } => {
                let found = shortened(&found.to_string());
                let verb = if self.element.is_some() {
                    "holds"
                } else {
                    "is"
                };
                write!(f, "`{key}` {verb} {found}; expected {expected}")
            }
        }
    }
}

/// The beginning of a value that may be long.
fn shortened(text: &str) -> String {
    const LONG: usize = 40;
    match text.char_indices().nth(LONG) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
