//! Frequencies of given vectors by their energies, and rigorous bounds on the errors.
//!
//! For `x = (R^T phi, i omega L^T phi)` the residual of the skew-symmetric problem is `(0, -L^-1 Q(i omega) phi)`, and
//! `|x|^2 = omega^2 phi^H M phi + phi^H K phi`. Because the matrix is normal, some frequency is within the quotient of
//! their lengths; where only one is, the square of that over the distance of the next one is a bound, too (Kato and
//! Temple; Parlett, The Symmetric Eigenvalue Problem, section 11.7).

use num_complex::Complex64;

use super::Oscillation;
use crate::eigenproblem::dense;
use crate::eigenproblem::general::pencil::{Pencil, bound};

/// Residual above which the general method serves the pencil better.
const INACCURATE: f64 = 1e-13;
/// Accepted error of the sum of the squares of the frequencies, relative to it.
const SUM: f64 = 1e-9;

/// Columns of numbers, one for each vector, row by row.
struct Columns<T> {
    count: usize,
    rows: Vec<T>,
}

impl<T: Copy + Default> Columns<T> {
    fn new(rows: usize, count: usize) -> Self {
        let rows = vec![T::default(); rows * count];
        Self { count, rows }
    }

    fn column(&self, r: usize) -> impl Iterator<Item = T> {
        self.rows.iter().skip(r).step_by(self.count).copied()
    }

    fn set(&mut self, r: usize, values: impl Iterator<Item = T>) {
        for (row, value) in self.rows.chunks_exact_mut(self.count).zip(values) {
            row[r] = value;
        }
    }
}

/// The products of a matrix with all vectors, and of its absolute values with the sizes of their components.
struct Products {
    values: Columns<Complex64>,
    terms: Columns<f64>,
}

impl Products {
    fn new(matrix: &[f64], phi: &[f64]) -> Self {
        let n = matrix.len().isqrt();
        let mut parts = vec![0.0; 2 * n * n];
        dense::multiply(n, 2 * n, matrix, phi, &mut parts);
        let mut terms = Columns::new(n, n);
        let sizes: Vec<f64> = complex(phi).map(bound).collect();
        let matrix: Vec<f64> = matrix.iter().map(|x| x.abs()).collect();
        dense::multiply(n, n, &matrix, &sizes, &mut terms.rows);
        let values = Columns { count: n, rows: complex(&parts).collect() };
        Self { values, terms }
    }
}

/// Numbers whose parts are interleaved.
fn complex(parts: &[f64]) -> impl Iterator<Item = Complex64> {
    parts.chunks_exact(2).map(|pair| Complex64::new(pair[0], pair[1]))
}

/// A frequency before its bound is known.
struct Measured {
    omega: f64,
    /// `|x|`
    length: f64,
    /// Sum of the absolute terms in `phi^H Q(i omega) phi`.
    terms: f64,
    residual: f64,
    phi: Vec<Complex64>,
}

/// Measures all vectors, given as columns of complex numbers, interleaved. `None` unless they solve the pencil, whose
/// squared frequencies have this `sum`.
pub(super) fn measured(pencil: &Pencil, lower: &[f64], phi: &[f64], sum: f64) -> Option<Vec<Oscillation>> {
    let n = pencil.n;
    let [mass, damping, stiffness] =
        [pencil.mass, pencil.damping, pencil.stiffness].map(|matrix| Products::new(matrix, phi));
    let vectors = Columns { count: n, rows: complex(phi).collect() };
    let mut rest = Columns::<Complex64>::new(n, n);
    let mut terms = Columns::<f64>::new(n, n);
    let mut oscillations = Vec::with_capacity(n);
    for r in 0..n {
        let phi: Vec<_> = vectors.column(r).collect();
        let product = |of: &Products| phi.iter().zip(of.values.column(r)).map(|(x, y)| x.conj() * y).sum::<Complex64>();
        let (inertia, elastic) = (product(&mass).re, product(&stiffness).re);
        let omega = positive_root(inertia, product(&damping).im, elastic);
        let unit = 1.0 / inertia.sqrt();
        let s = Complex64::new(0.0, omega);
        let values = mass.values.column(r).zip(damping.values.column(r));
        rest.set(r, values.zip(stiffness.values.column(r)).map(|((m, c), k)| (s * (s * m + c) + k) * unit));
        let sizes = mass.terms.column(r).zip(damping.terms.column(r));
        let sizes = sizes.zip(stiffness.terms.column(r));
        terms.set(r, sizes.map(|((m, c), k)| (omega * (omega * m + c) + k) * unit));
        let most = rest.column(r).map(bound).fold(0.0, f64::max);
        let largest = terms.column(r).fold(0.0, f64::max);
        let residual = if most == 0.0 { 0.0 } else { most / largest };
        if !(residual <= INACCURATE && omega > 0.0 && omega.is_finite()) {
            return None;
        }
        let sizes = phi.iter().map(|x| bound(*x) * unit);
        oscillations.push(Measured {
            omega,
            length: (omega * omega + elastic * unit * unit).sqrt(),
            terms: sizes.zip(terms.column(r)).map(|(x, terms)| x * terms).sum(),
            residual,
            phi: phi.iter().map(|x| x * unit).collect(),
        });
    }
    let squares: f64 = oscillations.iter().map(|x| x.omega * x.omega).sum();
    if (squares - sum).abs() > SUM * sum {
        return None;
    }
    let lengths = lengths(n, lower, &rest, &terms);
    Some(bounded(n, oscillations, &lengths))
}

/// The positive root of `omega^2 m + omega c - k = 0`, without cancellation.
fn positive_root(m: f64, c: f64, k: f64) -> f64 {
    let root = (c * c + 4.0 * m * k).sqrt();
    if c > 0.0 { 2.0 * k / (c + root) } else { (root - c) / (2.0 * m) }
}

/// Upper bounds on the lengths of `L^-1` times the residuals, given as computed and by the terms in them.
fn lengths(n: usize, lower: &[f64], rest: &Columns<Complex64>, terms: &Columns<f64>) -> Vec<f64> {
    let mut inverse = super::identity(n);
    dense::solve_lower(n, lower, n, &mut inverse);
    inverse.iter_mut().for_each(|x| *x = x.abs());
    let mut rounding = Columns::<f64>::new(n, n);
    dense::multiply(n, n, &inverse, &terms.rows, &mut rounding.rows);
    let mut parts: Vec<f64> = rest.rows.iter().flat_map(|x| [x.re, x.im]).collect();
    dense::solve_lower(n, lower, 2 * n, &mut parts);
    let reduced = Columns { count: n, rows: complex(&parts).collect() };
    let length = |r: usize| {
        let of_rest = reduced.column(r).map(|x| x.norm_sqr()).sum::<f64>();
        of_rest.sqrt() + relative(n) * rounding.column(r).map(|x| x * x).sum::<f64>().sqrt()
    };
    (0..n).map(length).collect()
}

/// Relative rounding error of a component of `Q(s) x`.
fn relative(n: usize) -> f64 {
    (n as f64 + 4.0) * f64::EPSILON
}

/// Adds the bounds, and sorts.
fn bounded(n: usize, mut measured: Vec<Measured>, lengths: &[f64]) -> Vec<Oscillation> {
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| measured[a].omega.total_cmp(&measured[b].omega));
    let radius: Vec<f64> = order.iter().map(|&r| lengths[r] / measured[r].length).collect();
    let omega: Vec<f64> = order.iter().map(|&r| measured[r].omega).collect();
    // Where intervals meet, as many frequencies as intervals are within the root of the sum of squares of each.
    let mut bounds = vec![0.0; n];
    let mut first = 0;
    for last in 0..n {
        if last + 1 < n && omega[last] + radius[last] >= omega[last + 1] - radius[last + 1] {
            continue;
        }
        let group = first..last + 1;
        let joint = radius[group.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
        let below = first.checked_sub(1).map(|k| omega[first] - omega[k] - bounds[k]);
        let above = (last + 1 < n).then(|| omega[last + 1] - radius[last + 1] - omega[last]);
        let gap = below.unwrap_or(f64::INFINITY).min(above.unwrap_or(f64::INFINITY));
        for k in group.clone() {
            bounds[k] = match group.len() {
                1 => joint.min(joint * joint / gap),
                _ => joint,
            };
        }
        first = last + 1;
    }
    let finished = order.iter().zip(bounds).map(|(&r, bound)| {
        let own = &mut measured[r];
        // The slope `2 omega m + c` is `|x|^2 / omega`.
        let of_elements = relative(n) * own.terms * own.omega / (own.length * own.length);
        Oscillation {
            omega: own.omega,
            phi: std::mem::take(&mut own.phi),
            residual: own.residual,
            error: bound + of_elements + f64::EPSILON * own.omega,
        }
    });
    finished.collect()
}
