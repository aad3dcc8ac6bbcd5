//! Tolerances and doubts as text.

mod doubts;
mod tolerance;

pub use doubts::{doubt_sentences, doubted, standing};
pub use tolerance::{far, spread_of, unmoved};
