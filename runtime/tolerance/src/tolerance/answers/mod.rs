//! What tolerances do to frequencies and outputs, as text and tables.

mod doubts;
mod first_order;
mod monte_carlo;
mod outputs;
mod samples;
mod statistics;

pub use doubts::{doubt_sentences, doubted, joined, standing};
pub use first_order::{far, spread_of, unmoved};
pub use samples::{numbered_samples_table, samples_table};
pub use statistics::{outcomes, statistics};
