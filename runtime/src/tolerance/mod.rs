//! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).
#![doc = include_str!("where_first_order_fails.md")]

mod batched;
mod first_order;
mod law;
mod monte_carlo;
mod normal_sampling;
mod outcome;
mod outputs;
pub(crate) mod pool;
mod sample;
mod sampling;
#[cfg(feature = "serde")]
mod serial;
mod spread;
mod standard_normal;
mod statistics;
mod tolerances;

/// Distributions of one variable and of several, from [`eigentol_statistics`].
pub use eigentol_statistics::{Distribution, Joint};
pub use first_order::{FirstOrder, ModeTolerance, TRUSTED_DISTANCE, first_order};
pub use law::distribution;
pub use monte_carlo::{MonteCarlo, Sampling, monte_carlo};
pub use outcome::{Counts, Outcome};
pub use outputs::{OutputTolerances, output_tolerances};
pub use sample::Sample;
pub use spread::Spread;
pub use statistics::Statistics;
pub use tolerances::Tolerances;

pub(crate) use sample::Solution;
pub(crate) use sampling::Draw;
pub(crate) use statistics::Moments;
