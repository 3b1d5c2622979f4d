//! Reading PLCopen XML, from outside.
//!
//! * `fixtures`: every `fixtures/plcopen/NAME.xml` gives what `NAME.txt` beside
//!   it says. Adding a test is adding two files.
//! * `neutralization`: the ladder of the case study means what its table says.
//! * `spans`: every element and operand stands where its span says.
//! * `properties`: drawings mean the same however they are written down, and
//!   no text makes the reader fall.
//! * `corpus`: real files, read in place.

mod corpus;
mod evaluation;
mod fixtures;
mod neutralization;
mod picture;
mod places;
mod properties;
mod spans;
