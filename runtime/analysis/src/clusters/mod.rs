//! Clusters: frequencies so close that their modes mix within the tolerances.

mod couplings;
mod directional;
mod sampling;
mod tolerance;

pub(crate) use couplings::common_slopes;
pub use couplings::{ModalCouplings, modal_couplings};
pub use directional::{DirectionalDerivatives, directional_derivatives};
pub use sampling::{ClusterSampling, ClusterSpread, MemberSpread, SortedSpread, sample_cluster};
pub(crate) use tolerance::groups;
pub use tolerance::{ClusterTolerance, MeanEigenvalue, clusters};
