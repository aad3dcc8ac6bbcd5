//! Natural modes of small vibrations about an equilibrium.

mod assurance;
#[allow(dead_code)]
mod general;
mod refine;
pub(crate) mod symmetric;

pub use assurance::{assurance, clusters, match_modes};

use crate::array::asymmetry;
use crate::{DampingKind, Description, Equilibrium, Error, Linear};
use symmetric::Trouble;

/// How a disturbance along a mode develops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behaviour {
    /// It oscillates: `lambda = omega^2 > 0`; angular frequency, rad/s.
    Oscillating(f64),
    /// Nothing resists it: `lambda` is zero to working accuracy.
    Neutral,
    /// It grows (static instability): `lambda = -rate^2 < 0`; rate, 1/s.
    Divergent(f64),
}

/// One undamped mode: `Khat phi = lambda Mhat phi`, `phi^T Mhat phi = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<const N: usize> {
    /// Eigenvalue, 1/s^2: the square of the frequency, negative for divergence.
    pub lambda: f64,
    /// `phi`, by coordinate, normalised by the mass matrix; its largest component is positive.
    pub shape: [f64; N],
    /// What `lambda` means.
    pub behaviour: Behaviour,
    /// Greatest component of `Khat phi - lambda Mhat phi` relative to the terms in it.
    pub residual: f64,
}

impl<const N: usize> Mode<N> {
    /// Natural angular frequency, rad/s; `None` for a mode that does not oscillate.
    pub fn frequency(&self) -> Option<f64> {
        match self.behaviour {
            Behaviour::Oscillating(omega) => Some(omega),
            Behaviour::Neutral | Behaviour::Divergent(_) => None,
        }
    }
}

/// All modes at one equilibrium, ascending in `lambda` unless they follow another set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modes<const N: usize> {
    /// The modes.
    pub modes: [Mode<N>; N],
    /// `Chat` is not zero here and was left out: these are the modes of `Mhat` and `Khat` alone.
    pub damping_ignored: bool,
    /// The mechanism they belong to.
    pub description: &'static Description,
}

impl<const N: usize> Modes<N> {
    /// Frequencies of the modes in their order, rad/s.
    pub fn frequencies(&self) -> [Option<f64>; N] {
        self.modes.map(|mode| mode.frequency())
    }

    /// The same modes reordered: position `i` of the result is position `order[i]` of these.
    pub(crate) fn reordered(&self, order: &[usize; N]) -> Self {
        let modes = core::array::from_fn(|i| self.modes[order[i].min(N.saturating_sub(1))]);
        Self { modes, ..*self }
    }
}

/// Undamped modes about an equilibrium.
///
/// # Errors
/// [`Error::NonsymmetricStiffness`] when `Khat` is not symmetric, [`Error::SingularMass`] when a coordinate moves no
/// mass, [`Error::ModesNotFound`] when a pair fails its residual check.
pub fn modes<const N: usize, const U: usize, const P: usize>(
    equilibrium: &Equilibrium<N, U, P>,
) -> Result<Modes<N>, Error> {
    modes_of(&equilibrium.linear, equilibrium.description)
}

/// Undamped modes of given matrices, which belong to the mechanism that `description` describes.
///
/// # Errors
/// As [`modes`].
pub fn modes_of<const N: usize>(
    linear: &Linear<f64, N>,
    description: &'static Description,
) -> Result<Modes<N>, Error> {
    solve_modes(linear, description).map_err(|trouble| trouble.explain(description))
}

/// A failure that owns nothing.
pub(crate) enum ModesFailure {
    Asymmetric(f64),
    Pencil(Trouble),
}

impl ModesFailure {
    pub(crate) fn explain(self, description: &'static Description) -> Error {
        match self {
            Self::Asymmetric(asymmetry) => Error::NonsymmetricStiffness { asymmetry },
            Self::Pencil(Trouble::SingularMass(row)) => Error::SingularMass {
                coordinate: description
                    .coordinates
                    .get(row)
                    .map_or("?", |info| info.name),
            },
            Self::Pencil(Trouble::Inaccurate { mode, residual }) => {
                Error::ModesNotFound { mode, residual }
            }
        }
    }
}

/// `Khat` counts as symmetric up to this relative difference.
const SYMMETRIC: f64 = 1e-11;

pub(crate) fn solve_modes<const N: usize>(
    linear: &Linear<f64, N>,
    description: &'static Description,
) -> Result<Modes<N>, ModesFailure> {
    if !description.symmetric_stiffness {
        let asymmetry = asymmetry(&linear.stiffness);
        if asymmetry.is_nan() || asymmetry > SYMMETRIC {
            return Err(ModesFailure::Asymmetric(asymmetry));
        }
    }
    let pairs = symmetric::solve(&linear.stiffness, &linear.mass).map_err(ModesFailure::Pencil)?;
    let threshold = neutral_threshold(&pairs.lambda);
    let modes = core::array::from_fn(|r| {
        let lambda = pairs.lambda[r];
        let behaviour = if lambda > threshold {
            Behaviour::Oscillating(lambda.sqrt())
        } else if lambda < -threshold {
            Behaviour::Divergent((-lambda).sqrt())
        } else {
            Behaviour::Neutral
        };
        Mode {
            lambda,
            shape: pairs.shapes[r],
            behaviour,
            residual: pairs.residuals[r],
        }
    });
    let damping_ignored = description.damping != DampingKind::Zero
        && linear.damping.iter().flatten().any(|&value| value != 0.0);
    Ok(Modes {
        modes,
        damping_ignored,
        description,
    })
}

/// Below this size an eigenvalue cannot be told from zero: the rounding of the greatest one.
pub(crate) fn neutral_threshold<const N: usize>(lambda: &[f64; N]) -> f64 {
    if N < 2 {
        return 0.0;
    }
    4.0 * N as f64 * f64::EPSILON * crate::array::largest(lambda)
}
