//! Stepped shafts in the language: exact solutions (`tests/truth/flexible`), what they must be equal to, and derivatives
//! against differences.

mod exact;
mod hard;
mod parts;
pub(crate) mod random;
