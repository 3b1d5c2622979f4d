//! Grafcets: one model, and the rule text that is kept beside a ladder.
//!
//! * [`model`] is a chart as IEC 60848 sees it, with what belongs to a spec
//!   around it: environment rules, properties, and the expert's decisions.
//! * [`evolution`] runs it, scan by scan.
//! * [`rules`] reads the text of a `.grafcet` file, writes it, formats it, and
//!   [rewrites](rules::rewrite) it so that it says something new while every
//!   line that still holds stays as a person left it.
//!
//! A spec's text is the only state of a conversion, so the two must agree
//! exactly: what is written reads back as it was, and nothing that a person
//! typed is lost.
//!
//! This crate knows no ladder. A step merely remembers the name of the state
//! it stands for, as the ladder spells it.

pub mod evolution;
pub mod model;
pub mod rules;

pub use model::*;
pub use rules::{
    Formatted, Mention, Places, Reading, Role, RulePlace, SectionPlace, action_rule, action_text,
    decision_text, format, read, rewrite, spelled, spelled_state, transition_rule, write,
};
