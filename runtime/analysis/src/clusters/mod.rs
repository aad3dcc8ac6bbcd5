//! Clusters: frequencies so close that their modes mix within the tolerances.
//!
//! # Modes that tolerances mix are a cluster
//!
//! A pair belongs together when its gap is less than 4.5 standard deviations of what moves and mixes it
//! (`clusters/tolerance.rs`); no single-mode sigma is right there. Instead, one function for any size and family
//! samples the small matrix of couplings (`clusters/sampling.rs`), as often as a number of operations allows:
//! eigenvalues without vectors, by the tridiagonal form from eight members on. The spreads of all pairs are summed
//! while the couplings pass by, one variable at a time; only those of a cluster are kept. Roots that have merged have
//! no couplings and say so. First order stays free of allocation and looks at each mode alone; `Study::summary`
//! compares it with second order and clusters, and gives each mode a verdict.
//!
//! # Modes that are equal at the nominal design are known by their order
//!
//! Their shapes are an arbitrary basis, so a sample that is matched to them by shape would be assigned at random.
//! Samples and responses sort the values within the group. Derivatives of a member exist only if all variables move the
//! members alike (`clusters::common_slopes`); otherwise it has none, and what needs one says so.

mod answer;
mod couplings;
mod directional;
mod sampling;
mod tolerance;

pub(crate) use couplings::common_slopes;
pub use couplings::{ModalCouplings, modal_couplings};
pub use directional::{DirectionalDerivatives, directional_derivatives};
pub use sampling::{ClusterSpread, MemberSpread, SortedSpread, sample_cluster};
#[doc(hidden)]
pub use tolerance::groups;
pub use tolerance::{ClusterTolerance, MeanEigenvalue, clusters};
