//! The highest response of any blade at any frequency.

use std::f64::consts::TAU;

use crate::algebra::{Lu, Matrix, Vector};
use crate::eigenproblem::{Eigenproblem, roots_near};
use crate::kernels::Linear;
use crate::{Complex, Error};

/// A highest response.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BladePeak {
    /// The frequency, rad/s.
    pub frequency: f64,
    /// The amplitude of the blade, per unit of the force on each.
    pub amplitude: f64,
    /// The blade, counted from 0.
    pub blade: usize,
    /// How many others vibrate as much.
    pub others: usize,
}

/// Blades under the force of an engine order.
pub(super) struct Driven {
    linear: Linear,
    /// By unknown.
    force: Vector<Complex>,
    /// By blade, the weights of the unknowns in its coordinate.
    seen: Matrix,
}

impl Driven {
    pub(super) fn new(linear: &Linear, slots: &[usize], order: usize) -> Self {
        let n = linear.mass.row_count();
        let basis = Matrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { 0.0 });
        Self::in_basis(linear.clone(), &basis, slots, order)
    }

    /// With the unknowns of a basis, one row for each, of the coordinates.
    pub(super) fn in_basis(linear: Linear, basis: &Matrix, slots: &[usize], order: usize) -> Self {
        let (m, blades) = (basis.row_count(), slots.len());
        let phase = |k: usize| Complex::cis(TAU * ((order % blades * k) % blades) as f64 / blades as f64);
        let force = Vector::from_fn(m, |r| slots.iter().enumerate().map(|(k, &slot)| phase(k) * basis[r][slot]).sum());
        let seen = Matrix::from_fn(blades, m, |k, r| basis[r][slots[k]]);
        Self { linear, force, seen }
    }

    pub(super) fn force(&self) -> Vector<Complex> {
        self.force.clone()
    }

    /// `z^2 M + z C + K`.
    pub(super) fn stiffness(&self, z: Complex) -> Matrix<Complex> {
        let Linear { mass, damping, stiffness } = &self.linear;
        let n = mass.row_count();
        Matrix::from_fn(n, n, |i, j| (z * mass[i][j] + damping[i][j]) * z + stiffness[i][j])
    }

    /// `left^T (z^2 M + z C + K) right`.
    pub(super) fn form(&self, z: Complex, left: &[Complex], right: &[Complex]) -> Complex {
        let matrix = self.stiffness(z);
        left.iter().enumerate().map(|(i, l)| l * matrix[i].iter().zip(right).map(|(a, x)| a * x).sum::<Complex>()).sum()
    }

    /// The largest amplitude of a blade at a frequency.
    fn at(&self, frequency: f64) -> Option<BladePeak> {
        let x = Lu::of(self.stiffness(Complex::new(0.0, frequency)))?.solve(&self.force);
        let amplitude = |k: usize| self.seen[k].iter().zip(&x).map(|(weight, x)| x * weight).sum::<Complex>().norm();
        let all: Vec<f64> = (0..self.seen.row_count()).map(amplitude).collect();
        let (blade, &amplitude) = all.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
        let others = all.iter().filter(|other| **other >= amplitude * (1.0 - EQUAL)).count() - 1;
        amplitude.is_finite().then_some(BladePeak { frequency, amplitude, blade, others })
    }
}

/// Relative difference of equal amplitudes.
const EQUAL: f64 = 1e-9;
/// Poles near which a peak is refined: those with the largest responses.
const REFINED: usize = 3;
/// Steps of each refinement, which leave a millionth of the width of a resonance.
const STEPS: usize = 30;
/// `Re s` below this, relative to the frequency, is no damping.
const UNDAMPED: f64 = 1e-9;

/// The highest response: at the frequencies of the poles and half a width beside them, then by golden section near the
/// largest.
pub(super) fn highest(driven: &Driven) -> Result<BladePeak, Error> {
    let roots = roots_near(Eigenproblem::Quadratic(&driven.linear), &[])
        .map_err(|_| Error::ModesNotFound { mode: 0, residual: f64::INFINITY })?;
    let mut candidates: Vec<(BladePeak, f64)> = Vec::new();
    for root in roots.iter().filter(|root| root.s.im > 0.0) {
        let (frequency, width) = (root.s.im, root.s.re.abs());
        if width < UNDAMPED * frequency {
            // It matters only if the order drives it: then the response grows inversely with the distance.
            let beside = |share: f64| driven.at(frequency * (1.0 + share)).map_or(f64::INFINITY, |peak| peak.amplitude);
            if beside(1e-6) > 10.0 * beside(1e-4) {
                return Err(undamped());
            }
            continue;
        }
        for place in [frequency - width, frequency, frequency + width] {
            candidates.extend(driven.at(place).map(|peak| (peak, width)));
        }
    }
    candidates.sort_by(|a, b| b.0.amplitude.total_cmp(&a.0.amplitude));
    let refined = candidates.iter().take(REFINED).filter_map(|(peak, width)| refine(driven, peak, *width));
    refined.max_by(|a, b| a.amplitude.total_cmp(&b.amplitude)).ok_or_else(undamped)
}

fn refine(driven: &Driven, peak: &BladePeak, width: f64) -> Option<BladePeak> {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let [mut low, mut high] = [peak.frequency - width, peak.frequency + width];
    let mut best = peak.clone();
    for _ in 0..STEPS {
        let step = golden * (high - low);
        let (left, right) = (driven.at(high - step)?, driven.at(low + step)?);
        if left.amplitude > right.amplitude {
            high = low + step;
        } else {
            low = high - step;
        }
        for point in [left, right] {
            if point.amplitude > best.amplitude {
                best = point;
            }
        }
    }
    Some(best)
}

/// That blades without damping have no highest response.
pub(super) fn undamped() -> Error {
    Error::setting("engine order", "nothing damps the vibration of the blades, so it has no highest amplitude")
}
