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
use crate::algebra::{Lu, Matrix, Vector, product_complex};
use crate::kernels::Linear;
use crate::scalar::Real as _;
use crate::shafts::Shafts;

/// Rounding errors of a scaled element that a vanishing direction may hide behind, times the number of unknowns.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Share of a force along a vanishing direction that counts as none.
const NOT_DRIVEN: f64 = 1e-9;
/// Length that the inverse gives to a unit vector without a pattern, below which no direction vanishes: with one, the
/// vector grows by the inverse of rounding, times its share along the direction.
const REGULAR: f64 = 1e6;
/// Steps of inverse iteration: each gains as many digits as the direction is separated by.
const STEPS: usize = 3;
/// Most rounds of scaling.
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
    /// At `s = i w`, with the shafts if there are any; `None` if it is singular beyond what single modes explain.
    pub(super) fn new(linear: &Linear, shafts: Option<&Shafts>, s: Complex) -> Option<Self> {
        let Scaled { rows, columns, mut matrix } = match shafts {
            None => Scaled::new(linear, s),
            Some(shafts) => Scaled::of_matrix(shafts.matrix(s)),
        };
        let n = rows.len();
        let mut vanishing = Vec::new();
        for _ in 0..=n {
            let (factors, regular) = factored(&matrix)?;
            let Some(direction) = vanishing_direction(&factors, regular, n) else {
                return Some(Self { rows, columns, matrix, factors, vanishing });
            };
            let (c, m) = (&linear.damping, &linear.mass);
            let slope = match shafts {
                None => Matrix::from_fn(n, n, |i, j| 2.0 * s * m[i][j] + c[i][j]),
                Some(shafts) => shafts.slope(s),
            };
            let slope = Matrix::from_fn(n, n, |i, j| slope[i][j] * (rows[i] * columns[j]));
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

    /// Whether a force drives a direction in which `D` vanishes: then there is no response to it.
    pub(super) fn driven_by(&self, force: &[Complex]) -> bool {
        let mut directions = self.vanishing.iter();
        directions.any(|direction| drives(&scaled(force, &self.rows), &direction.left))
    }

    /// Whether weights see a direction in which `D` vanishes: then `D^-T weights` is infinite.
    pub(super) fn seen_by(&self, weights: &[Complex]) -> bool {
        let mut directions = self.vanishing.iter();
        directions.any(|direction| drives(&scaled(weights, &self.columns), &direction.right))
    }

    /// `D^-1 forces`, for forces that do not drive a direction in which `D` vanishes; one column each.
    pub(super) fn solve(&self, forces: &Matrix<Complex>) -> Matrix<Complex> {
        let scales = [&self.rows[..], &self.columns];
        refined(
            (&self.matrix, forces, scales),
            #[inline(always)]
            |right| self.factors.solve_columns(right),
        )
    }

    /// `D^-T weights`, for weights that do not see a direction in which `D` vanishes; one column each.
    pub(super) fn solve_transposed(&self, weights: &Matrix<Complex>) -> Matrix<Complex> {
        let scales = [&self.columns[..], &self.rows];
        refined(
            (&self.matrix.transpose(), weights, scales),
            #[inline(always)]
            |right| self.factors.solve_transposed_columns(right),
        )
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
        f64::run(
            #[inline(always)]
            || Self::of(linear, s),
        )
    }

    pub(super) fn of_matrix(mut matrix: Matrix<Complex>) -> Self {
        let n = matrix.row_count();
        let sizes: Vec<i32> = matrix.as_flattened().iter().map(|value| twice_log2(value.norm())).collect();
        let (rows, columns) = scales(n, &sizes);
        for (row, by_row) in matrix.iter_mut().zip(&rows) {
            row.iter_mut().zip(&columns).for_each(|(value, by_column)| *value *= by_row * by_column);
        }
        Self { rows, columns, matrix }
    }

    #[inline(always)]
    fn of(linear: &Linear, s: Complex) -> Self {
        let (k, c, m) = (&linear.stiffness, &linear.damping, &linear.mass);
        let (n, w) = (k.row_count(), s.norm());
        let entries = || {
            let [k, c, m] = [k, c, m].map(Matrix::as_flattened);
            k.iter().zip(c).zip(m).map(|((k, c), m)| (k, c, m))
        };
        let terms = entries().map(|(k, c, m)| k.abs() + w * (c.abs() + w * m.abs()));
        let (rows, columns) = scales(n, &terms.map(twice_log2).collect::<Vec<i32>>());
        let mut matrix = Matrix::from_rows(n, entries().map(|(k, c, m)| s * (s * m + c) + k).collect());
        for (row, by_row) in matrix.iter_mut().zip(&rows) {
            for (value, by_column) in row.iter_mut().zip(&columns) {
                *value *= by_row * by_column;
            }
        }
        Self { rows, columns, matrix }
    }
}

/// The logarithm of an element that is zero or not finite.
const NONE: i32 = i32::MIN / 2;

/// Twice the logarithm to base two of a number that is not negative; odd between two powers.
#[inline(always)]
fn twice_log2(value: f64) -> i32 {
    const DIGITS: u64 = (1 << 52) - 1;
    let bits = value.to_bits();
    if value > 0.0 && value.is_finite() {
        2 * ((bits >> 52) as i32 - 1023) + i32::from(bits & DIGITS != 0)
    } else {
        NONE
    }
}

/// Powers of two that bring the largest element of every row and column near one, from twice the logarithms.
#[inline(always)]
fn scales(n: usize, logarithms: &[i32]) -> (Vector, Vector) {
    let (mut rows, mut columns) = (vec![0; n], vec![0; n]);
    let mut by_column = vec![NONE; n];
    // Half of the logarithm, rounded.
    let root = |most: i32| if most > NONE / 2 { (most + 2 * most.signum()) / 4 * 2 } else { 0 };
    for _ in 0..ROUNDS {
        let mut changed = false;
        by_column.fill(NONE);
        for (row, logarithms) in rows.iter_mut().zip(logarithms.chunks_exact(n.max(1))) {
            let mut by_row = NONE;
            for ((size, column), most) in logarithms.iter().zip(&columns).zip(&mut by_column) {
                by_row = by_row.max(size + column);
                *most = (*most).max(size + *row);
            }
            let change = root(by_row + *row);
            changed |= change != 0;
            *row -= change;
        }
        for (column, most) in columns.iter_mut().zip(&by_column) {
            let change = root(most + *column);
            changed |= change != 0;
            *column -= change;
        }
        if !changed {
            break;
        }
    }
    let powers = |twice: Vec<i32>| twice.into_iter().map(|k| 2_f64.powi(k / 2)).collect();
    (powers(rows), powers(columns))
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

/// A direction in which a matrix vanishes to working accuracy, by inverse iteration; `regular` says that elimination found
/// none.
fn vanishing_direction(factors: &Lu<Complex>, regular: bool, n: usize) -> Option<Vanishing> {
    let mut number = Numbers(n as u64);
    let start = Vector::from_fn(n, |_| number.next());
    let mut left = unit(&start).unwrap_or(start);
    let (mut right, mut size) = (Vector::zeros(n), 0.0);
    for _ in 0..STEPS {
        let conjugate = left.map(|value| value.conj());
        let image = factors.solve(&conjugate);
        if regular && norm(&image) < REGULAR {
            return None;
        }
        right = unit(&image).unwrap_or(conjugate);
        let image = factors.solve_transposed(&right.map(|value| value.conj()));
        size = 1.0 / norm(&image);
        left = unit(&image).unwrap_or(left);
    }
    let is_singular = !(regular && size > ROUNDING * n as f64);
    is_singular.then_some(Vanishing { left, right })
}

/// Whether a force excites a direction.
fn drives(force: &[Complex], direction: &[Complex]) -> bool {
    let along: Complex = force.iter().zip(direction).map(|(f, l)| f * l).sum();
    along.norm() > NOT_DRIVEN * norm(force)
}

/// The solutions of a scaled system, each improved once by its residual, for columns that are not scaled; `scales` are
/// those of the right-hand sides and of the solutions.
fn refined(
    (matrix, right, [of_right, of_solution]): (&Matrix<Complex>, &Matrix<Complex>, [&[f64]; 2]),
    solve: impl Fn(&Matrix<Complex>) -> Matrix<Complex>,
) -> Matrix<Complex> {
    f64::run(
        #[inline(always)]
        || {
            let mut residual = right.clone();
            scale_rows(&mut residual, of_right);
            let mut x = solve(&residual);
            let image = product_complex(matrix, &x);
            combine(&mut residual, &image, |a, b| a - b);
            combine(&mut x, &solve(&residual), |a, b| a + b);
            scale_rows(&mut x, of_solution);
            x
        },
    )
}

#[inline(always)]
fn scale_rows(matrix: &mut Matrix<Complex>, scales: &[f64]) {
    for (row, scale) in matrix.iter_mut().zip(scales) {
        row.iter_mut().for_each(|value| *value *= scale);
    }
}

#[inline(always)]
fn combine(a: &mut Matrix<Complex>, b: &Matrix<Complex>, f: impl Fn(Complex, Complex) -> Complex) {
    a.as_flattened_mut().iter_mut().zip(b.as_flattened()).for_each(|(a, b)| *a = f(*a, *b));
}

pub(super) fn times(matrix: &Matrix<Complex>, x: &[Complex]) -> Vector<Complex> {
    matrix.iter().map(|row: &[Complex]| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
}

fn scaled(x: &[Complex], scales: &[f64]) -> Vector<Complex> {
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
            self.0 = (self.0.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        Complex::new(part(), part())
    }
}
