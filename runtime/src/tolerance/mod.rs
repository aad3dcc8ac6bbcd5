//! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).

mod batched;
mod declared;
mod first_order;
mod monte_carlo;
mod normal;
mod outcome;
mod outputs;
mod pool;
mod sample;
mod sampling;
mod spread;
mod statistics;

pub use declared::Tolerances;
pub use first_order::{FirstOrder, ModeTolerance, TRUSTED_DISTANCE, first_order};
pub use monte_carlo::{MonteCarlo, Sampling, monte_carlo};
pub use outcome::{Counts, Outcome};
pub use outputs::{OutputTolerances, output_tolerances};
pub use sample::Sample;
pub use spread::Spread;
pub use statistics::Statistics;

pub(crate) use sampling::Draw;
pub(crate) use statistics::Moments;
