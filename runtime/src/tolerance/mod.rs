//! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).

mod band;
mod batched;
mod cluster_sampling;
mod clusters;
mod declared;
mod distribution;
mod events;
mod first_order;
mod margin;
mod monte_carlo;
mod normal;
mod outcome;
mod outputs;
mod pool;
mod probability;
mod quadratic;
mod sample;
mod sampling;
mod second_order;
mod spread;
mod statistics;
mod summary;
mod trust;

pub use band::{Band, ModeMargin, mode_margin};
pub use cluster_sampling::{
    ClusterSampling, ClusterSpread, MemberSpread, SortedSpread, sample_cluster,
};
pub use clusters::{ClusterTolerance, MeanEigenvalue, clusters};
pub use declared::Tolerances;
pub use events::{Event, EventTolerance, critical_tolerance, crossing_tolerance};
pub use first_order::{FirstOrder, ModeTolerance, TRUSTED_DISTANCE, first_order};
pub use margin::{Margin, MarginDerivatives, margin};
pub use monte_carlo::{MonteCarlo, Sampling, monte_carlo};
pub use outcome::{Counts, Outcome};
pub use outputs::{OutputTolerances, output_tolerances};
pub use probability::Probability;
pub use quadratic::{ModelMoments, Quadratic};
pub use sample::Sample;
pub use second_order::{ModeSecondOrder, SecondOrder, SecondOrderSpread, second_order};
pub use spread::Spread;
pub use statistics::Statistics;
pub use summary::{Doubt, Summary, TRUSTED_SIGMA_ERROR, Trust, summary};
pub use trust::Nonlinearity;
