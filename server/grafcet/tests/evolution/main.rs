//! How grafcets run.

mod actions;
mod bounds;
mod charts;
mod hierarchy;
mod page;
mod random;
mod reference;
mod rules;
mod run;
mod specs;
