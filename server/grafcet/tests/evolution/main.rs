//! How grafcets run.

mod actions;
mod bounds;
mod hierarchy;
mod page;
mod random;
mod reference;
mod rules;
mod run;
mod specs;
