//! `gradus.toml`: settings for the programs in a folder and below it.
//!
//! Of several such files the nearest counts, alone: who opens it sees all that
//! it says.

use std::collections::HashMap;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::{Map, Number, Value};
use source::{Diagnostic, Span, codes};
use toml::de::{DeTable, DeValue};

use super::{Complaint, Layer, Wrong};
use crate::file::Unreadable;

/// What such a file is called.
pub const NAME: &str = "gradus.toml";

/// The most bytes that are read of one.
const LONGEST: u64 = 1 << 20;

/// The settings file for what lies in `folder`: the one there, or in the
/// nearest folder above it, but none above `top`.
pub fn nearest(folder: &Path, top: Option<&Path>) -> Option<PathBuf> {
    for folder in folder.ancestors() {
        let file = folder.join(NAME);
        if file.is_file() {
            return Some(file);
        }
        if top == Some(folder) {
            break;
        }
    }
    None
}

/// What a settings file says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// What it holds.
    pub text: Vec<u8>,
    /// What was understood of it.
    pub layer: Layer,
    /// What was not.
    pub findings: Vec<Diagnostic>,
}

/// Reads the settings file at `path`.
pub fn open(path: &Path) -> File {
    let mut text = Vec::new();
    let opened = std::fs::File::open(path);
    match opened.and_then(|file| file.take(LONGEST + 1).read_to_end(&mut text)) {
        Ok(_) => read(text),
        Err(error) => File {
            findings: vec![Unreadable::from(error).diagnostic()],
            ..File::default()
        },
    }
}

/// Reads what a settings file holds. What cannot be understood is as usual, and
/// a finding.
pub fn read(text: Vec<u8>) -> File {
    let unreadable = |message: String| {
        let finding = Diagnostic::new(codes::SETTINGS_SYNTAX, Span::at(0), message);
        (Layer::default(), vec![finding])
    };
    let (layer, findings) = match std::str::from_utf8(&text) {
        _ if text.len() as u64 > LONGEST => unreadable(format!("{NAME} is larger than 1 MiB")),
        Ok(text) => read_text(text),
        Err(error) => unreadable(format!(
            "{NAME} must be UTF-8; byte {} is not",
            error.valid_up_to()
        )),
    };
    File {
        text,
        layer,
        findings,
    }
}

fn read_text(text: &str) -> (Layer, Vec<Diagnostic>) {
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut findings: Vec<Diagnostic> = errors
        .iter()
        .map(|error| {
            let place = error.span().map_or(Span::at(0), |range| span(text, range));
            Diagnostic::new(codes::SETTINGS_SYNTAX, place, error.message())
        })
        .collect();
    let mut places = Places::default();
    places.note(table.get_ref(), &mut Vec::new());
    let (layer, complaints) = Layer::read(&settings(table.get_ref()));
    // Where nothing could be read there is some value all the same.
    let broken: Vec<Span> = findings.iter().map(|it| it.span).collect();
    let complaints = complaints.iter().map(|it| finding(text, it, &places));
    let is_read = |it: &Diagnostic| !broken.iter().any(|at| touch(*at, it.span));
    findings.extend(complaints.filter(is_read));
    findings.sort_by_key(|found| (found.span, found.code));
    findings.dedup();
    (layer, findings)
}

/// Where the keys, values and elements of a text are, by what leads to them.
#[derive(Debug, Default)]
struct Places(HashMap<(Vec<String>, Option<usize>), Place>);

#[derive(Debug)]
struct Place {
    key: Range<usize>,
    value: Range<usize>,
}

impl Places {
    /// Notes where everything below `path` is.
    fn note(&mut self, table: &DeTable<'_>, path: &mut Vec<String>) {
        for (key, value) in table.iter() {
            path.push(key.get_ref().to_string());
            self.put(path, None, key.span(), value.span());
            match value.get_ref() {
                DeValue::Table(table) => self.note(table, path),
                DeValue::Array(array) => {
                    for (at, element) in array.iter().enumerate() {
                        self.put(path, Some(at), element.span(), element.span());
                    }
                }
                _ => {}
            }
            path.pop();
        }
    }

    fn put(
        &mut self,
        path: &[String],
        element: Option<usize>,
        key: Range<usize>,
        value: Range<usize>,
    ) {
        self.0
            .insert((path.to_vec(), element), Place { key, value });
    }
}

/// A table as a client would send it.
fn settings(table: &DeTable<'_>) -> Map<String, Value> {
    let entries = table.iter();
    entries
        .map(|(key, value)| (key.get_ref().to_string(), setting(value.get_ref())))
        .collect()
}

/// A value as a client would send it; one that JSON does not know, by its text.
fn setting(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::Table(table) => Value::Object(settings(table)),
        DeValue::Array(array) => array.iter().map(|it| setting(it.get_ref())).collect(),
        DeValue::String(text) => text.to_string().into(),
        DeValue::Boolean(is_on) => (*is_on).into(),
        DeValue::Integer(number) => {
            let parsed = i64::from_str_radix(number.as_str(), number.radix());
            parsed.map_or_else(|_| number.to_string().into(), Value::from)
        }
        DeValue::Float(number) => {
            let parsed = number.as_str().parse().ok().and_then(Number::from_f64);
            parsed.map_or_else(|| number.to_string().into(), Value::Number)
        }
        DeValue::Datetime(time) => time.to_string().into(),
    }
}

fn finding(text: &str, complaint: &Complaint, places: &Places) -> Diagnostic {
    let place = places.0.get(&(complaint.keys.clone(), complaint.element));
    let at = |range: Option<&Range<usize>>| range.map_or(Span::at(0), |it| span(text, it.clone()));
    match &complaint.wrong {
        Wrong::Key { known } => {
            let known: Vec<_> = known.iter().map(|key| format!("`{key}`")).collect();
            Diagnostic::new(
                codes::SETTING_UNKNOWN,
                at(place.map(|it| &it.key)),
                complaint.to_string(),
            )
            .help(format!("known here: {}", known.join(", ")))
        }
        Wrong::Value { .. } => Diagnostic::new(
            codes::SETTING_WRONG,
            at(place.map(|it| &it.value)),
            complaint.to_string(),
        ),
    }
}

fn touch(a: Span, b: Span) -> bool {
    a.start <= b.end && b.start <= a.end
}

/// A place of the text.
fn span(text: &str, range: Range<usize>) -> Span {
    let end = range.end.min(text.len());
    Span::new(range.start.min(end), end)
}
