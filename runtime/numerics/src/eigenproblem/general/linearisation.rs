//! The balanced companion form of a scaled pencil, whose eigenvalues are the starting values for all other steps.

use num_complex::Complex64;

use super::hessenberg;
use super::pencil::{Degree, Pencil, modulus};
use super::shifted::Parts;
use crate::eigenproblem::dense;
use crate::eigenproblem::symmetric::{EigenproblemError, factor_into};

/// `x' = A x` for `x = D^-1 (y, s y)`, `phi = L^-T y`, `M = L L^T`, with
/// `A = D^-1 [[0, I], [-L^-1 K L^-T, -L^-1 C L^-T]] D`; for a first-order pencil `A = -K`, which is already balanced.
pub(super) struct Linearisation<'a> {
    pub(super) n: usize,
    degree: Degree,
    lower: &'a [f64],
    /// `L^-1 C L^-T` and `L^-1 K L^-T`.
    damping: &'a [f64],
    stiffness: &'a [f64],
    /// Diagonal of `D`.
    scales: &'a [f64],
    /// Frobenius norm of `A`.
    pub(super) size: f64,
}

/// Which vectors of a pencil: those it maps to zero, or those that map it to zero.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Right,
    Left,
}

impl<'a> Linearisation<'a> {
    /// Builds `A` in `companion`, using `3 n^2 + 2 n` numbers of `store`.
    pub(super) fn new(pencil: &Pencil, companion: &mut [f64], store: &'a mut [f64]) -> Result<Self, EigenproblemError> {
        let n = pencil.n;
        let (lower, store) = store.split_at_mut(n * n);
        let (damping, store) = store.split_at_mut(n * n);
        let (stiffness, store) = store.split_at_mut(n * n);
        let scales = &mut store[..2 * n];
        if pencil.degree == Degree::One {
            for (a, k) in companion.iter_mut().zip(pencil.stiffness) {
                *a = -k;
            }
            stiffness.copy_from_slice(pencil.stiffness);
            return Ok(Self {
                n,
                degree: pencil.degree,
                lower,
                damping,
                size: frobenius(companion),
                stiffness,
                scales,
            });
        }
        factor_into(n, pencil.mass, lower)?;
        damping.copy_from_slice(pencil.damping);
        stiffness.copy_from_slice(pencil.stiffness);
        reduce(n, lower, damping);
        reduce(n, lower, stiffness);
        companion.fill(0.0);
        for i in 0..n {
            companion[i * 2 * n + n + i] = 1.0;
            for j in 0..n {
                companion[(n + i) * 2 * n + j] = -stiffness[i * n + j];
                companion[(n + i) * 2 * n + n + j] = -damping[i * n + j];
            }
        }
        hessenberg::balance(2 * n, companion, scales);
        let size = frobenius(companion);
        Ok(Self { n, degree: pencil.degree, lower, damping, stiffness, scales, size })
    }

    /// Rounding error of an eigenvalue, per condition number.
    pub(super) fn noise(&self) -> f64 {
        8.0 * f64::EPSILON * self.size
    }

    /// The same with what `L^-1` adds to the rounding of `C` and `K`, and the factors to that of `M`, which counts by the
    /// size of `s`.
    pub(super) fn noise_of_masses(&self, s: Complex64) -> f64 {
        let pivots = (0..self.n).map(|i| self.lower[i * (self.n + 1)]);
        let (least, most) = pivots.fold((f64::INFINITY, 0.0_f64), |(least, most), x| (least.min(x), most.max(x)));
        let spread = most / least;
        self.noise() * spread * (1.0 + modulus(s) / self.size * spread)
    }

    /// The sum of all eigenvalues: `-tr(M^-1 C)`, or `-tr K` for a first-order pencil.
    pub(super) fn sum(&self) -> f64 {
        let matrix = match self.degree {
            Degree::One => self.stiffness,
            Degree::Two => self.damping,
        };
        -(0..self.n).map(|i| matrix[i * (self.n + 1)]).sum::<f64>()
    }

    /// Vectors of the pencil from those of `A`: columns in fours, real and imaginary parts of a right vector, then of
    /// a left one.
    pub(super) fn shapes(&self, columns: usize, block: &[f64], shapes: &mut [f64]) {
        let n = self.n;
        if self.degree == Degree::One {
            shapes.copy_from_slice(block);
            return;
        }
        let (upper, lower) = block.split_at(n * columns);
        let (up, down) = self.scales.split_at(n);
        for q in (0..columns).step_by(4) {
            let size = |half: &[f64]| {
                half.chunks_exact(columns).map(|row| row[q] * row[q] + row[q + 1] * row[q + 1]).sum::<f64>()
            };
            // Both halves hold the right vector; the larger one is better known.
            let (half, scales) = if size(upper) >= size(lower) { (upper, up) } else { (lower, down) };
            for i in 0..n {
                let (from, to) = (i * columns + q, &mut shapes[i * columns + q..]);
                for part in 0..2 {
                    to[part] = half[from + part] * scales[i];
                    to[part + 2] = lower[from + part + 2] / down[i];
                }
            }
        }
        dense::solve_lower_transposed(n, self.lower, columns, shapes);
    }

    /// The right-hand side of the system for `A - s` in place of `Q(s) d = -rest`.
    pub(super) fn load(&self, side: Side, rest: &[Complex64], into: &mut Parts) {
        let n = self.n;
        let [filled, empty] = match (self.degree, side) {
            (Degree::One, _) => [0..n, 0..0],
            (Degree::Two, Side::Right) => [n..2 * n, 0..n],
            (Degree::Two, Side::Left) => [0..n, n..2 * n],
        };
        for (into, part) in into.both().into_iter().zip([|x: &Complex64| x.re, |x: &Complex64| x.im]) {
            into[empty.clone()].fill(0.0);
            let into = &mut into[filled.clone()];
            for (into, x) in into.iter_mut().zip(rest) {
                *into = part(x);
            }
            if self.degree == Degree::Two {
                dense::solve_lower(n, self.lower, 1, into);
                for (i, x) in into.iter_mut().enumerate() {
                    *x *= match side {
                        Side::Right => 1.0 / self.scales[n + i],
                        Side::Left => self.scales[i],
                    };
                }
            }
        }
    }

    /// The vector `d` of the pencil from a solution of that system, which is destroyed.
    pub(super) fn unload(&self, side: Side, solution: &mut Parts, into: &mut [Complex64]) {
        let n = self.n;
        let half = match (self.degree, side) {
            (Degree::Two, Side::Left) => n..2 * n,
            _ => 0..n,
        };
        let [re, im] = solution.both().map(|part| &mut part[half.clone()]);
        if self.degree == Degree::Two {
            for part in [&mut *re, &mut *im] {
                for (i, x) in part.iter_mut().enumerate() {
                    *x *= match side {
                        Side::Right => self.scales[i],
                        Side::Left => 1.0 / self.scales[n + i],
                    };
                }
                dense::solve_lower_transposed(n, self.lower, 1, part);
            }
        }
        for (into, (re, im)) in into.iter_mut().zip(re.iter().zip(im)) {
            *into = Complex64::new(*re, *im);
        }
    }

    /// Condition number of `s` as an eigenvalue of `A`, from the vectors of the pencil and
    /// `slope = psi^T (2 s M + C) phi`. `work` needs `2 n` numbers.
    pub(super) fn condition(
        &self,
        s: Complex64,
        right: &[Complex64],
        left: &[Complex64],
        slope: Complex64,
        work: &mut [Complex64],
    ) -> f64 {
        let n = self.n;
        if self.degree == Degree::One {
            let square = |x: &[Complex64]| x.iter().map(Complex64::norm_sqr).sum::<f64>();
            return at_least_one((square(right) * square(left)).sqrt() / modulus(slope));
        }
        let s_square = s.norm_sqr();
        let (mut x, mut w) = (0.0, 0.0);
        let (up, down) = self.scales.split_at(n);
        transformed(n, self.lower, right, work);
        for j in 0..n {
            let y = work[j].norm_sqr();
            x += y / (up[j] * up[j]) + s_square * y / (down[j] * down[j]);
        }
        let (work, product) = work.split_at_mut(n);
        transformed(n, self.lower, left, work);
        for j in 0..n {
            w += work[j].norm_sqr() * (down[j] * down[j]);
        }
        // The upper half of the left vector is (s + C^T) w2 = -K^T w2 / s; use the form with less cancellation.
        let small = s_square < 1e-2;
        let matrix = if small { self.damping } else { self.stiffness };
        let product = &mut product[..n];
        product.fill(Complex64::ZERO);
        for (x, row) in work.iter().zip(matrix.chunks_exact(n)) {
            for (sum, element) in product.iter_mut().zip(row) {
                *sum += x * element;
            }
        }
        for j in 0..n {
            let square = if small { (product[j] + s * work[j]).norm_sqr() } else { product[j].norm_sqr() / s_square };
            w += square * (up[j] * up[j]);
        }
        at_least_one((x * w).sqrt() / modulus(slope))
    }
}

fn at_least_one(condition: f64) -> f64 {
    if condition.is_nan() { f64::INFINITY } else { condition.max(1.0) }
}

fn frobenius(matrix: &[f64]) -> f64 {
    matrix.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `L^T x`.
fn transformed(n: usize, lower: &[f64], x: &[Complex64], into: &mut [Complex64]) {
    into[..n].fill(Complex64::ZERO);
    for (i, x) in x.iter().enumerate() {
        for (sum, element) in into.iter_mut().zip(&lower[i * n..=i * (n + 1)]) {
            *sum += x * element;
        }
    }
}

/// `L^-1 matrix L^-T` in place.
fn reduce(n: usize, lower: &[f64], matrix: &mut [f64]) {
    for _ in 0..2 {
        dense::solve_lower(n, lower, n, matrix);
        dense::transpose(n, matrix);
    }
}
