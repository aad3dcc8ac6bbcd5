//! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).

mod answers;
mod batched;
mod distances;
mod doubt;
mod fingerprint;
mod first_order;
#[doc(hidden)]
pub mod gather;
mod law;
mod monte_carlo;
mod normal_sampling;
mod outcome;
mod outputs;
mod partial;
#[doc(hidden)]
pub mod pool;
mod result;
#[doc(hidden)]
pub mod run;
mod sample;
mod sampling;
#[cfg(feature = "serde")]
mod serial;
mod settings;
#[doc(hidden)]
pub mod side_by_side;
mod solver;
mod spread;
mod standard_normal;
mod tolerances;

#[doc(hidden)]
pub use answers::{doubt_sentences, doubted, far, joined, outcomes, spread_of, standing, statistics, unmoved};
pub use answers::{numbered_samples_table, samples_table};
pub use doubt::{Doubt, Measured};
/// Statistics of samples with their quantiles and histograms, from [`eigentol_statistics`].
pub use eigentol_statistics::summary::{Histogram, Sketch, Statistics};
/// Distributions of one and of several variables, from [`eigentol_statistics`].
pub use eigentol_statistics::{Distribution, Joint};
pub use fingerprint::Fingerprint;
pub use first_order::{FirstOrder, ModeTolerance, TRUSTED_DISTANCE, first_order};
pub use law::distribution;
pub use monte_carlo::{monte_carlo, partial_monte_carlo};
pub use outcome::{Counts, Outcome};
pub use outputs::{OutputTolerances, output_tolerances};
pub use partial::PartialMonteCarlo;
pub use result::MonteCarlo;
pub use sample::Sample;
pub use settings::{Points, Sampling};
pub use spread::Spread;
pub use tolerances::Tolerances;

#[doc(hidden)]
pub use batched::possible as side_by_side_possible;
#[doc(hidden)]
pub use sample::Solution;
#[doc(hidden)]
pub use sampling::Draw;
