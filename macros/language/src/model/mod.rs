//! The mechanism in the user's terms: names resolved to ids, values in SI, every rule checked.

pub mod beam;
pub mod constraint;
pub mod doubts;
pub mod elements;
pub mod evaluate;
pub mod excitation;
pub mod expression;
pub mod inertia;
pub mod mechanism;
mod print;
pub mod resolve;
pub mod rotor;
mod rules;
pub mod shaft;
pub mod shape;
mod simplify;
pub mod superelement;
pub mod tolerance;
pub mod unit;
#[cfg(feature = "locations")]
mod warnings;
pub mod welded;
