//! What the linearised mechanism says about the stability of an equilibrium.

use super::problem::Failure;
use crate::array::{Cholesky, Lu, Square, asymmetry};
use crate::constraints::{Structure, Tangent, reduce};
use crate::modes::{Family, SYMMETRIC, neutral_threshold, solve_modes, symmetric};
use crate::{Behaviour, DampingKind, Description, Linear};

/// Stability of an equilibrium against small disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Stable: no small disturbance grows.
    Stable,
    /// Stable by gyroscopic forces alone, which hold directions without stiffness; the least dissipation destroys it.
    GyroscopicallyStabilised {
        /// Number of directions with negative stiffness.
        negative: usize,
    },
    /// Some oscillation neither grows nor decays to working accuracy, and no theorem says that it does not grow.
    Marginal,
    /// Not unstable, but this many directions have no stiffness: the mechanism rests anywhere along them.
    Neutral {
        /// Number of eigenvalues that are zero to working accuracy.
        zero: usize,
    },
    /// A disturbance grows without oscillation (static instability).
    Divergent {
        /// Number of negative eigenvalues `lambda`, or of growing real eigenvalues `s`.
        negative: usize,
    },
    /// A disturbance grows in an oscillation (dynamic instability).
    Flutter {
        /// Number of growing oscillations.
        growing: usize,
    },
    /// The general eigenvalues, which would decide it, were not found to working accuracy.
    Undecided,
}

impl Stability {
    /// Whether small disturbances stay small as far as the linearised mechanism tells, neutral directions included.
    pub fn holds(self) -> bool {
        matches!(
            self,
            Self::Stable
                | Self::GyroscopicallyStabilised { .. }
                | Self::Marginal
                | Self::Neutral { .. }
        )
    }
}

/// Judges by theorems where they decide: a positive definite symmetric `Khat` with dissipative or gyroscopic `Chat` is
/// stable (Kelvin, Tait, Chetaev), `det Khat < 0` has a growing real solution whatever `Chat` is. Otherwise, also with an odd
/// number of negative directions beside free ones, by the general eigenvalues. With constraints on positions the theorems
/// hold for the directions they leave free; with speeds or constraints on velocities the general eigenvalues decide.
pub(super) fn judge<const N: usize>(
    description: &'static Description,
    linear: &Linear<f64, N>,
) -> Result<Stability, Failure<N>> {
    let structure = Structure::of(description);
    if structure.open() {
        return judge_free(description, linear, linear);
    }
    let tangent = Tangent::new(linear, structure);
    if structure.holonomic() && tangent.freedom == 0 {
        return Ok(Stability::Stable);
    }
    if !structure.holonomic() {
        return Ok(by_eigenvalues(description, linear, 0, 0));
    }
    judge_free(description, linear, &reduce(linear, &tangent)).map_err(|failure| match failure {
        Failure::SingularMass(direction) => Failure::SingularMass(tangent.foremost(direction)),
        other => other,
    })
}

/// As [`judge`], by the matrices over free directions; `whole` are those of all unknowns.
fn judge_free<const N: usize>(
    description: &'static Description,
    whole: &Linear<f64, N>,
    linear: &Linear<f64, N>,
) -> Result<Stability, Failure<N>> {
    if let Err(row) = Cholesky::new(&linear.mass) {
        return Err(Failure::SingularMass(row));
    }
    if !description.symmetric_stiffness && asymmetry(&linear.stiffness) > SYMMETRIC {
        let negative =
            Lu::new(&linear.stiffness).is_some_and(|factors| factors.negative_determinant());
        return Ok(if negative {
            Stability::Divergent { negative: 1 }
        } else {
            by_eigenvalues(description, whole, 0, 0)
        });
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
    Ok(
        if negative > 0 && (!damped || (zero == 0 && negative % 2 == 1)) {
            Stability::Divergent { negative }
        } else if negative > 0 || (damped && feeds_energy(linear)?) {
            by_eigenvalues(description, whole, negative, zero)
        } else if zero > 0 {
            Stability::Neutral { zero }
        } else {
            Stability::Stable
        },
    )
}

/// What the general eigenvalues say, where `negative` directions have negative stiffness and `free` ones none.
fn by_eigenvalues<const N: usize>(
    description: &'static Description,
    linear: &Linear<f64, N>,
    negative: usize,
    free: usize,
) -> Stability {
    let Ok(found) = solve_modes(linear, Family::General, description) else {
        return Stability::Undecided;
    };
    let count = |wanted: fn(Behaviour) -> bool| {
        let behaviours = found.modes.iter().map(|mode| mode.behaviour);
        behaviours.filter(|&behaviour| wanted(behaviour)).count()
    };
    let divergent = count(|behaviour| matches!(behaviour, Behaviour::Divergent(_)));
    let growing = count(|behaviour| matches!(behaviour, Behaviour::Flutter(_)));
    let zero = count(|behaviour| matches!(behaviour, Behaviour::Neutral));
    let constant = count(|behaviour| matches!(behaviour, Behaviour::Oscillating(_)));
    if divergent > 0 {
        Stability::Divergent {
            negative: divergent,
        }
    } else if growing > 0 {
        Stability::Flutter { growing }
    } else if zero > 0 {
        // A direction that nothing resists has two zero eigenvalues `s`.
        Stability::Neutral {
            zero: if free > 0 { free } else { zero },
        }
    } else if constant == 0 {
        Stability::Stable
    } else if negative > 0 && skew(&linear.damping) {
        Stability::GyroscopicallyStabilised { negative }
    } else {
        Stability::Marginal
    }
}

/// Whether a matrix is skew-symmetric to rounding.
fn skew<const N: usize>(matrix: &Square<N>) -> bool {
    let threshold = SYMMETRIC * crate::array::largest_element(matrix);
    (0..N).all(|i| (0..=i).all(|j| (matrix[i][j] + matrix[j][i]).abs() <= threshold))
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
