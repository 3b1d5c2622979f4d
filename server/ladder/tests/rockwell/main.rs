//! The Rockwell readers: neutral text, L5X and L5K.

mod corpus;
mod fixtures;
mod linear;
mod neutral_text;
mod properties;
mod shown;
