//! Flexible beams: closed forms and reference values, and random trees of them against the oracle.

mod beams;
mod flexible;
mod shafts;
mod superelements;
