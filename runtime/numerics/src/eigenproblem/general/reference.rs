//! A reference pencil, in the form from which the pairs of many nearby pencils are found at once.

use num_complex::Complex64;

use super::lu::Lu;
use super::powers::{exponent, power_of_two};
use super::prediction::ApproximatePair;
use super::scaling::largest;
use crate::algebra::{Matrix, Vector};
use crate::linear::Linear;

/// The units of a pencil, and all of its pairs in these units.
pub struct Reference {
    /// Units of vectors: powers of two.
    pub units: Vector,
    /// Unit of eigenvalues, 1/s.
    pub rate: f64,
    pub pairs: Vec<ReferencePair>,
}

/// An eigenvalue, `Im s >= 0`, with its vectors and the order of elimination.
pub struct ReferencePair {
    pub s: Complex64,
    pub right: Vector<Complex64>,
    pub left: Vector<Complex64>,
    /// Rows and columns of `Q(s)` in the order of complete pivoting: the singular ones come last.
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
}

impl Reference {
    /// The reference for a pencil whose first `motions` unknowns have masses and whose others are the reactions of as
    /// many constraints; `None` unless the pairs represent all eigenvalues, conjugates included.
    pub fn new(linear: &Linear, motions: usize, pairs: &[ApproximatePair]) -> Option<Self> {
        let n = linear.mass.row_count();
        let values = pairs.iter().map(|pair| 1 + usize::from(pair.s.im > 0.0));
        let wanted = (4 * motions).checked_sub(2 * n)?;
        let fits = |pair: &ApproximatePair| pair.right.len() == n && pair.left.len() == n;
        if values.sum::<usize>() != wanted || !pairs.iter().all(fits) {
            return None;
        }
        let (units, rate) = units(linear, motions)?;
        let in_units = |x: &[Complex64]| x.iter().zip(&units).map(|(x, unit)| x / unit).collect();
        let mut matrix = vec![Complex64::ZERO; n * n];
        let mut order = vec![0; 2 * n];
        let pairs = pairs.iter().map(|pair| {
            for (k, q) in matrix.iter_mut().enumerate() {
                let (i, j) = (k / n, k % n);
                let (m, c) = (linear.mass[i][j], linear.damping[i][j]);
                let value = pair.s * (pair.s * m + c) + linear.stiffness[i][j];
                *q = value * (units[i] * units[j] / rate / rate);
            }
            Lu::new(n, &mut matrix, &mut order);
            ReferencePair {
                s: pair.s / rate,
                right: in_units(pair.right),
                left: in_units(pair.left),
                rows: order[..n].to_vec(),
                columns: order[n..].to_vec(),
            }
        });
        Some(Self { pairs: pairs.collect(), units, rate })
    }
}

/// Powers of two that bring masses, interactions between motions, and constraints to order one, followed by the unit of
/// eigenvalues. `None` if a motion has no mass of its own, or a reaction acts on nothing.
fn units(linear: &Linear, motions: usize) -> Option<(Vector, f64)> {
    let n = linear.mass.row_count();
    let mut units = Vector::filled(n, 1.0);
    for i in 0..motions {
        let mass = linear.mass[i][i];
        if !(mass >= f64::MIN_POSITIVE && mass.is_finite()) {
            return None;
        }
        units[i] = power_of_two(-(exponent(mass).div_euclid(2)));
    }
    let of_motions = |matrix: &Matrix| {
        let elements = (0..motions * motions).map(|k| (k / motions, k % motions));
        largest(&elements.map(|(i, j)| matrix[i][j] * units[i] * units[j]).collect::<Vec<_>>())
    };
    let size = of_motions(&linear.damping).max(of_motions(&linear.stiffness).sqrt());
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let rate = power_of_two(exponent(size));
    for j in motions..n {
        let column: Vec<f64> = (0..motions).map(|i| linear.stiffness[i][j] * units[i]).collect();
        let size = largest(&column);
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        units[j] = rate * rate * power_of_two(-exponent(size));
    }
    Some((units, rate))
}
