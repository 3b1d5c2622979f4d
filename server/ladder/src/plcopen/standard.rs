//! The catalogue: functions and function blocks of IEC 61131-3 by their type
//! names, with what they do to a rung.
//!
//! It says what a block is, not how it is drawn. A name that is not here is
//! the project's own or a library's; such a block is kept opaque.

use logic::Relation;

use crate::{CounterKind, Edge, Gate, TimerKind};

/// What a block of the standard does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standard {
    /// `TON`, `TOF`, `TP`.
    Timer(TimerKind),
    /// `CTU`, `CTD`, `CTUD`.
    Counter(CounterKind),
    /// `R_TRIG`, `F_TRIG`.
    Trigger(Edge),
    /// `SR`, `RS`.
    Bistable(Dominance),
    /// `GT`, `EQ` and so on.
    Compare(Relation),
    /// `AND`, `OR`, `XOR`: over bits, or bitwise over words.
    Gate(Gate),
    /// `NOT`: of a bit, or bitwise of a word.
    Not,
    /// `MOVE`.
    Move,
    /// A function written with an infix sign: `ADD` is `+`.
    Infix(&'static str),
    /// Another function: its result depends on its inputs alone.
    Function,
    /// Another function block: it remembers, and its outputs are atoms.
    Remembering,
}

/// Which input of a bistable wins when both are on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dominance {
    /// `SR`
    Set,
    /// `RS`
    Reset,
}

impl Standard {
    /// Whether a block of this kind has instances.
    pub(super) fn remembers(self) -> bool {
        matches!(
            self,
            Self::Timer(_)
                | Self::Counter(_)
                | Self::Trigger(_)
                | Self::Bistable(_)
                | Self::Remembering
        )
    }
}

/// What the standard says of the type called `name`; typed forms such as
/// `ADD_INT` and `CTU_ULINT` are what their plain form is.
pub(super) fn standard(name: &str) -> Option<Standard> {
    let name = name.trim().to_ascii_uppercase();
    plain(&name).or_else(|| {
        let (stem, ending) = name.split_once('_')?;
        let typed = DATA_TYPES.contains(&ending);
        let found = if typed { plain(stem)? } else { return None };
        (!matches!(found, Standard::Timer(_) | Standard::Bistable(_))).then_some(found)
    })
}

const DATA_TYPES: [&str; 25] = [
    "BOOL",
    "SINT",
    "INT",
    "DINT",
    "LINT",
    "USINT",
    "UINT",
    "UDINT",
    "ULINT",
    "REAL",
    "LREAL",
    "BYTE",
    "WORD",
    "DWORD",
    "LWORD",
    "TIME",
    "LTIME",
    "DATE",
    "TOD",
    "DT",
    "STRING",
    "WSTRING",
    "CHAR",
    "DATE_AND_TIME",
    "TIME_OF_DAY",
];

const FUNCTIONS: [&str; 37] = [
    "ABS",
    "SQRT",
    "LN",
    "LOG",
    "EXP",
    "SIN",
    "COS",
    "TAN",
    "ASIN",
    "ACOS",
    "ATAN",
    "ATAN2",
    "SHL",
    "SHR",
    "ROR",
    "ROL",
    "SEL",
    "MAX",
    "MIN",
    "LIMIT",
    "MUX",
    "LEN",
    "LEFT",
    "RIGHT",
    "MID",
    "CONCAT",
    "INSERT",
    "DELETE",
    "REPLACE",
    "FIND",
    "TRUNC",
    "ROUND",
    "MULTIME",
    "DIVTIME",
    "CONCAT_DATE_TOD",
    "SIZEOF",
    "ADR",
];

const REMEMBERING: [&str; 7] = [
    "SEMA",
    "RTC",
    "INTEGRAL",
    "DERIVATIVE",
    "PID",
    "RAMP",
    "HYSTERESIS",
];

fn plain(name: &str) -> Option<Standard> {
    Some(match name {
        "TON" => Standard::Timer(TimerKind::OnDelay),
        "TOF" => Standard::Timer(TimerKind::OffDelay),
        "TP" => Standard::Timer(TimerKind::Pulse),
        "TONR" => Standard::Timer(TimerKind::Retentive),
        "CTU" => Standard::Counter(CounterKind::Up),
        "CTD" => Standard::Counter(CounterKind::Down),
        "CTUD" => Standard::Counter(CounterKind::UpDown),
        "R_TRIG" => Standard::Trigger(Edge::Rising),
        "F_TRIG" => Standard::Trigger(Edge::Falling),
        "SR" => Standard::Bistable(Dominance::Set),
        "RS" => Standard::Bistable(Dominance::Reset),
        "GT" => Standard::Compare(Relation::Greater),
        "GE" => Standard::Compare(Relation::GreaterOrEqual),
        "EQ" => Standard::Compare(Relation::Equal),
        "NE" => Standard::Compare(Relation::NotEqual),
        "LE" => Standard::Compare(Relation::LessOrEqual),
        "LT" => Standard::Compare(Relation::Less),
        "AND" => Standard::Gate(Gate::And),
        "OR" => Standard::Gate(Gate::Or),
        "XOR" => Standard::Gate(Gate::Xor),
        "NOT" => Standard::Not,
        "MOVE" => Standard::Move,
        "ADD" => Standard::Infix("+"),
        "SUB" => Standard::Infix("-"),
        "MUL" => Standard::Infix("*"),
        "DIV" => Standard::Infix("/"),
        "MOD" => Standard::Infix("MOD"),
        "EXPT" => Standard::Infix("**"),
        _ if FUNCTIONS.contains(&name) || is_conversion(name) => Standard::Function,
        _ if REMEMBERING.contains(&name) => Standard::Remembering,
        _ => return None,
    })
}

/// `INT_TO_REAL`, `TO_INT`, `REAL_TRUNC_INT`, `BCD_TO_UINT`, `UINT_TO_BCD`.
fn is_conversion(name: &str) -> bool {
    let known = |part: &str| part.is_empty() || part == "BCD" || DATA_TYPES.contains(&part);
    let parts = name
        .split_once("_TO_")
        .or_else(|| name.split_once("_TRUNC_"))
        .or_else(|| Some(("", name.strip_prefix("TO_")?)));
    parts.is_some_and(|(from, to)| known(from) && !to.is_empty() && known(to))
}

/// The type of an input or output of a standard type, as far as the type
/// settles it.
pub(super) fn pin_type(type_name: &str, pin: &str) -> Option<&'static str> {
    let pin = pin.to_ascii_uppercase();
    let pin = pin.as_str();
    if matches!(pin, "EN" | "ENO") {
        return Some("BOOL");
    }
    let upper = type_name.trim().to_ascii_uppercase();
    Some(match (standard(type_name)?, pin) {
        (Standard::Timer(_), "IN" | "Q" | "R") => "BOOL",
        (Standard::Timer(_), "PT" | "ET") => "TIME",
        (Standard::Counter(_), "PV" | "CV") => "INT",
        (Standard::Counter(_) | Standard::Trigger(_) | Standard::Bistable(_), _) => "BOOL",
        (Standard::Compare(_), "OUT" | "") => "BOOL",
        (Standard::Function, "G") if upper == "SEL" => "BOOL",
        (Standard::Function, "IN") if upper.starts_with("BOOL_TO_") => "BOOL",
        (Standard::Function, "OUT") if upper.ends_with("TO_BOOL") => "BOOL",
        (Standard::Function, "OUT") => *DATA_TYPES.iter().find(|found| {
            upper
                .strip_suffix(**found)
                .is_some_and(|head| head.ends_with("TO_"))
        })?,
        (Standard::Remembering, _) => return remembering_pin(&upper, pin),
        _ => return None,
    })
}

fn remembering_pin(type_name: &str, pin: &str) -> Option<&'static str> {
    let boolean = match type_name {
        "SEMA" => matches!(pin, "CLAIM" | "RELEASE" | "BUSY"),
        "RTC" => matches!(pin, "IN" | "Q"),
        "INTEGRAL" => matches!(pin, "RUN" | "R1" | "Q"),
        "DERIVATIVE" => pin == "RUN",
        "PID" => pin == "AUTO",
        "RAMP" => matches!(pin, "RUN" | "BUSY"),
        "HYSTERESIS" => pin == "Q",
        _ => return None,
    };
    Some(if boolean { "BOOL" } else { "REAL" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typed_forms_and_conversions_are_known_and_other_names_are_not() {
        assert_eq!(standard("ADD_INT"), Some(Standard::Infix("+")));
        assert_eq!(
            standard("ctu_ulint"),
            Some(Standard::Counter(CounterKind::Up))
        );
        assert_eq!(standard("DWORD_TO_UINT"), Some(Standard::Function));
        assert_eq!(standard("SR_INT"), None);
        assert_eq!(standard("scale_to_real"), None);
        assert_eq!(standard("TIME_TO_GO"), None);
    }

    #[test]
    fn types_of_pins_are_known() {
        assert_eq!(pin_type("TON", "q"), Some("BOOL"));
        assert_eq!(pin_type("CTUD", "QD"), Some("BOOL"));
        assert_eq!(pin_type("INT_TO_REAL", "OUT"), Some("REAL"));
        assert_eq!(pin_type("INT_TO_BOOL", "OUT"), Some("BOOL"));
        assert_eq!(pin_type("LIMIT", "OUT"), None);
    }
}
