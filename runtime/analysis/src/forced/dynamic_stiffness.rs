//! The dynamic stiffness `D(w) = Khat + i w Chat - w^2 Mhat`, factored once for everything at one frequency.
//!
//! # Where it is singular
//!
//! Rows and columns are scaled by powers of two, by the sizes of the terms `|Khat|`, `w |Chat|`, `w^2 |Mhat|`: rounding
//! of `D` is then the same everywhere, and inverse iteration says whether it hides a direction in which `D` vanishes, as
//! that of an undamped mode at its natural frequency. With `D r = 0`, `l^T D = 0` and `D' = dD/ds`, the matrix
//! `D + (D' r)(l^T D')`, scaled, is regular, and its solution is the limit of the solutions at frequencies nearby,
//! `l^T D' z = 0`, provided that the force does not drive the direction, `l^T F = 0`. If it does, there is no response.

use crate::Complex;
use crate::algebra::{Lu, Matrix, Vector};
use crate::kernels::Linear;

/// Rounding errors of a scaled element that a vanishing direction may hide behind, times the number of unknowns.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Share of a force along a vanishing direction that counts as none.
const NOT_DRIVEN: f64 = 1e-9;
/// Steps of inverse iteration: each gains as many digits as the direction is separated by.
const STEPS: usize = 3;
/// Rounds of scaling.
const ROUNDS: usize = 4;

pub(super) struct DynamicStiffness {
    /// Powers of two.
    rows: Vector,
    columns: Vector,
    /// The scaled matrix, with borders for directions in which it vanishes.
    matrix: Matrix<Complex>,
    factors: Lu<Complex>,
    vanishing: Vec<Vanishing>,
}

/// A direction in which the scaled matrix vanishes to working accuracy: unit vectors `l` and `r`.
struct Vanishing {
    left: Vector<Complex>,
    right: Vector<Complex>,
}

impl DynamicStiffness {
    /// At `s = i w`; `None` if it is singular beyond what single modes explain.
    pub(super) fn new(linear: &Linear, s: Complex) -> Option<Self> {
        let (c, m) = (&linear.damping, &linear.mass);
        let Scaled {
            rows,
            columns,
            mut matrix,
        } = Scaled::new(linear, s);
        let n = rows.len();
        let slope = Matrix::from_fn(n, n, |i, j| {
            (2.0 * s * m[i][j] + c[i][j]) * (rows[i] * columns[j])
        });
        let mut vanishing = Vec::new();
        for _ in 0..=n {
            let (factors, regular) = factored(&matrix)?;
            let (size, direction) = weakest(&factors, n);
            if regular && size > ROUNDING * n as f64 {
                return Some(Self {
                    rows,
                    columns,
                    matrix,
                    factors,
                    vanishing,
                });
            }
            let column = unit(&times(&slope, &direction.right))?;
            let row = unit(&times(&slope.transpose(), &direction.left))?;
            for i in 0..n {
                for j in 0..n {
                    matrix[i][j] += column[i] * row[j];
                }
            }
            vanishing.push(direction);
        }
        None
    }

    /// `D^-1 force`; `None` if the force drives a direction in which `D` vanishes.
    pub(super) fn solve(&self, force: &[Complex]) -> Option<Vector<Complex>> {
        let right = product(force, &self.rows);
        let mut directions = self.vanishing.iter();
        if directions.any(|own| drives(&right, &own.left)) {
            return None;
        }
        let x = refined(
            &right,
            |right| self.factors.solve(right),
            |x| times(&self.matrix, x),
        );
        Some(product(&x, &self.columns))
    }

    /// `D^-T weights`; `None` if the weights see a direction in which `D` vanishes.
    pub(super) fn solve_transposed(&self, weights: &[Complex]) -> Option<Vector<Complex>> {
        let right = product(weights, &self.columns);
        let mut directions = self.vanishing.iter();
        if directions.any(|own| drives(&right, &own.right)) {
            return None;
        }
        let x = refined(
            &right,
            |right| self.factors.solve_transposed(right),
            |x| times_transposed(&self.matrix, x),
        );
        Some(product(&x, &self.rows))
    }
}

/// The dynamic stiffness with scaled rows and columns.
pub(super) struct Scaled {
    /// Powers of two.
    pub(super) rows: Vector,
    pub(super) columns: Vector,
    pub(super) matrix: Matrix<Complex>,
}

impl Scaled {
    pub(super) fn new(linear: &Linear, s: Complex) -> Self {
        let (k, c, m) = (&linear.stiffness, &linear.damping, &linear.mass);
        let (n, w) = (k.row_count(), s.norm());
        let terms = Matrix::from_fn(n, n, |i, j| {
            k[i][j].abs() + w * (c[i][j].abs() + w * m[i][j].abs())
        });
        let (rows, columns) = scales(&terms);
        let matrix = Matrix::from_fn(n, n, |i, j| {
            (s * (s * m[i][j] + c[i][j]) + k[i][j]) * (rows[i] * columns[j])
        });
        Self {
            rows,
            columns,
            matrix,
        }
    }
}

/// Powers of two that bring the largest element of every row and column near one.
fn scales(terms: &Matrix) -> (Vector, Vector) {
    let n = terms.row_count();
    let (mut rows, mut columns) = (Vector::filled(n, 1.0), Vector::filled(n, 1.0));
    let root = |most: f64| match most > 0.0 && most.is_finite() {
        true => (-0.5 * most.log2()).round().exp2(),
        false => 1.0,
    };
    for _ in 0..ROUNDS {
        let size = |i: usize, j: usize| terms[i][j] * rows[i] * columns[j];
        let most = |of: &dyn Fn(usize) -> f64| root((0..n).map(of).fold(0.0, f64::max));
        let by_row = Vector::from_fn(n, |i| most(&|j| size(i, j)));
        let by_column = Vector::from_fn(n, |j| most(&|i| size(i, j)));
        for i in 0..n {
            rows[i] *= by_row[i];
            columns[i] *= by_column[i];
        }
    }
    (rows, columns)
}

/// Factors of a matrix; if elimination finds it singular, of one that differs by rounding.
pub(super) fn factored(matrix: &Matrix<Complex>) -> Option<(Lu<Complex>, bool)> {
    if let Some(factors) = Lu::new(matrix) {
        return Some((factors, true));
    }
    let n = matrix.row_count();
    let size = 2.0 * ROUNDING * n as f64;
    let mut number = Numbers(1);
    let near = Matrix::from_fn(n, n, |i, j| matrix[i][j] + size * number.next());
    Some((Lu::of(near)?, false))
}

/// The smallest singular value and its directions, by inverse iteration.
fn weakest(factors: &Lu<Complex>, n: usize) -> (f64, Vanishing) {
    let mut number = Numbers(n as u64);
    let mut left = Vector::from_fn(n, |_| number.next());
    let (mut right, mut size) = (Vector::zeros(n), 0.0);
    for _ in 0..STEPS {
        let conjugate = left.map(|value: Complex| value.conj());
        right = unit(&factors.solve(&conjugate)).unwrap_or(conjugate);
        let image = factors.solve_transposed(&right.map(|value| value.conj()));
        size = 1.0 / norm(&image);
        left = unit(&image).unwrap_or(left);
    }
    (size, Vanishing { left, right })
}

/// Whether a force has a share along a direction.
fn drives(force: &[Complex], direction: &[Complex]) -> bool {
    let along: Complex = force.iter().zip(direction).map(|(f, l)| f * l).sum();
    along.norm() > NOT_DRIVEN * norm(force)
}

/// The solution, improved once by its residual.
fn refined(
    right: &[Complex],
    solve: impl Fn(&[Complex]) -> Vector<Complex>,
    image: impl Fn(&[Complex]) -> Vector<Complex>,
) -> Vector<Complex> {
    let x = solve(right);
    let image = image(&x);
    let correction = solve(&Vector::from_fn(x.len(), |i| right[i] - image[i]));
    Vector::from_fn(x.len(), |i| x[i] + correction[i])
}

pub(super) fn times(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    let row = |row: &[Complex]| row.iter().zip(x).map(|(a, x)| a * x).sum();
    matrix.iter().map(row).collect()
}

fn times_transposed(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    let mut sum = Vector::zeros(matrix.column_count());
    for (row, x) in matrix.iter().zip(x) {
        for (sum, a) in sum.iter_mut().zip(row) {
            *sum += a * x;
        }
    }
    sum
}

fn product(x: &[Complex], scales: &[f64]) -> Vector<Complex> {
    Vector::from_fn(x.len(), |i| x[i] * scales[i])
}

fn norm(x: &[Complex]) -> f64 {
    x.iter().map(Complex::norm_sqr).sum::<f64>().sqrt()
}

/// The vector divided by its length, if it has one.
fn unit(x: &[Complex]) -> Option<Vector<Complex>> {
    let size = norm(x);
    let usable = size > 0.0 && size.is_finite();
    usable.then(|| x.iter().map(|value| value / size).collect())
}

/// Numbers without a pattern, between -1 and 1, always the same.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> Complex {
        let mut part = || {
            self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005))
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        Complex::new(part(), part())
    }
}
