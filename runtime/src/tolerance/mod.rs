//! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).

mod declared;
mod events;
mod first_order;
mod monte_carlo;
mod pool;
mod sampling;
mod statistics;

pub use declared::Tolerances;
pub use events::{Event, EventSpread, EventTolerance, critical_tolerance, crossing_tolerance};
pub use first_order::{
    FirstOrder, ModeTolerance, OutputTolerance, OutputTolerances, Spread, TRUSTED_DISTANCE,
    first_order, output_tolerances,
};
pub use monte_carlo::{Counts, MonteCarlo, Outcome, Sample, Sampling, monte_carlo};
pub use statistics::Statistics;
