//! Scenarios run on ladders and specs.

mod agreement;
mod running;
mod tables;
