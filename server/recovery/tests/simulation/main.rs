//! Scenarios run on ladders and specs.

mod agreement;
mod moments;
mod running;
mod tables;
