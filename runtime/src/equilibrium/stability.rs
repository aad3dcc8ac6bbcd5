//! What the linearised mechanism says about the stability of an equilibrium, and where it says nothing.

use super::problem::Failure;
use crate::array::{Cholesky, Lu, Square, asymmetry};
use crate::modes::{neutral_threshold, symmetric};
use crate::{DampingKind, Description, Linear};

/// Stability of an equilibrium against small disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Stable: `Khat` symmetric and positive definite, and `Chat` feeds in no energy.
    Stable,
    /// Not unstable, but this many directions have no stiffness: the mechanism rests anywhere along them.
    Neutral {
        /// Number of eigenvalues that are zero to working accuracy.
        zero: usize,
    },
    /// A disturbance grows without oscillation (static instability).
    Divergent {
        /// Number of negative eigenvalues `lambda`; at least one when `Khat` is not symmetric.
        negative: usize,
    },
    /// The undamped symmetric problem does not decide it.
    Unverified(Doubt),
}

/// Why stability was not decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// `Khat` is not symmetric: flutter is possible.
    NonsymmetricStiffness,
    /// An even number of negative eigenvalues that gyroscopic forces may stabilise, or not.
    GyroscopicStabilisation {
        /// How many.
        negative: usize,
    },
    /// `Chat` has a part that feeds in energy.
    NegativeDamping,
}

impl Stability {
    /// Whether small disturbances stay small, neutral directions included.
    pub fn holds(self) -> bool {
        matches!(self, Self::Stable | Self::Neutral { .. })
    }
}

/// Judges by theorems only: positive definite symmetric `Khat` with dissipative or gyroscopic `Chat` is stable
/// (Kelvin, Tait, Chetaev); `det Khat < 0` has a growing real solution whatever `Chat` is.
pub(super) fn judge<const N: usize>(
    description: &Description,
    linear: &Linear<f64, N>,
) -> Result<Stability, Failure<N>> {
    if !description.symmetric_stiffness && asymmetry(&linear.stiffness) > 1e-11 {
        let negative =
            Lu::new(&linear.stiffness).is_some_and(|factors| factors.negative_determinant());
        return Ok(if negative {
            Stability::Divergent { negative: 1 }
        } else {
            Stability::Unverified(Doubt::NonsymmetricStiffness)
        });
    }
    if let Err(row) = Cholesky::new(&linear.mass) {
        return Err(Failure::SingularMass(row));
    }
    let (mut negative, mut zero) = (0, 0);
    if Cholesky::new(&linear.stiffness).is_err() {
        let lambda = symmetric::solve(&linear.stiffness, &linear.mass)?.lambda;
        let threshold = neutral_threshold(&lambda);
        negative = lambda.iter().filter(|&&value| value < -threshold).count();
        zero = lambda
            .iter()
            .filter(|&&value| value.abs() <= threshold)
            .count();
    }
    let damped = description.damping != DampingKind::Zero
        && linear.damping.iter().flatten().any(|&value| value != 0.0);
    Ok(if negative % 2 == 1 || (negative > 0 && !damped) {
        Stability::Divergent { negative }
    } else if negative > 0 {
        Stability::Unverified(Doubt::GyroscopicStabilisation { negative })
    } else if damped && feeds_energy(linear)? {
        Stability::Unverified(Doubt::NegativeDamping)
    } else if zero > 0 {
        Stability::Neutral { zero }
    } else {
        Stability::Stable
    })
}

/// Whether the symmetric part of `Chat` has a negative eigenvalue beyond rounding.
fn feeds_energy<const N: usize>(linear: &Linear<f64, N>) -> Result<bool, Failure<N>> {
    let damping = &linear.damping;
    let symmetric_part: Square<N> =
        core::array::from_fn(|i| core::array::from_fn(|j| 0.5 * (damping[i][j] + damping[j][i])));
    let rates = symmetric::solve(&symmetric_part, &linear.mass)?.lambda;
    let scale = crate::array::largest_element(damping);
    let least_mass = (0..N).fold(f64::INFINITY, |least, i| least.min(linear.mass[i][i]));
    let threshold = 16.0 * N as f64 * f64::EPSILON * scale / least_mass;
    Ok(rates.iter().any(|&rate| rate < -threshold))
}
