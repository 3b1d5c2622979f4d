//! Netlists as files for tools of others.

pub mod aiger;
pub mod blif;
