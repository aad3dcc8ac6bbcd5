//! How tolerances spread frequencies and outputs: first order, samples, and states side by side in vectors.
//!
//! An internal part of `eigentol`, which re-exports what its users need. It promises nothing to others.

#[doc(hidden)]
pub mod batched;
pub mod tolerance;

use eigentol_contract::{DampingKind, Description, Input, Shared};
use eigentol_contract::{mechanism, scalar};
use eigentol_numerics::{Complex, algebra, eigenproblem};
use eigentol_results::setters;
pub use eigentol_solve::Error;
use eigentol_solve::{Behaviour, Equilibrium, Mode, Modes, Policy, Sensitivities, Stability, Watch};
use eigentol_solve::{constraints, equilibrium, kernels, modes, rounding, sensitivity};

pub use tolerance::{FirstOrder, MonteCarlo, Tolerances};
