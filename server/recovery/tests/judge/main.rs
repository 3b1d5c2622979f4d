//! Independent judges of what is recovered from a ladder.
//!
//! Nothing here asks the code under test whether it is right. Guards are
//! judged by an interpreter that knows no diagrams, next values by a simulated
//! controller, successions by tables and by charts that the files themselves
//! hold.

mod coded_chart;
mod corpus_page;
mod guards;
mod networks;
mod next_values;
mod paper;
mod programs;
mod real_files;
mod rungs;
mod valuations;
