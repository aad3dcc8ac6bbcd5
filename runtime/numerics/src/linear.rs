//! Mass, damping and stiffness as matrices.

use crate::algebra::Matrix;

/// Mass, damping and stiffness.
pub type Linear<T = f64> = eigentol_contract::Linear<Matrix<T>>;
