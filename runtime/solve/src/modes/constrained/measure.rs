//! How accurate an eigenvalue of the bordered pencil is, judged from its pair of vectors.

use crate::Complex;
use crate::algebra::{Lu, Matrix, Vector, dot, dot_complex, largest_element, times};
use crate::kernels::Linear;
use crate::modes::pencil::{pencil_slope_times, pencil_times, pencil_transposed_times, transposed};

/// Largest residual that is accepted.
pub(crate) const ACCEPTED: f64 = 1e-9;
/// Residual above which vectors are improved.
pub(super) const INACCURATE: f64 = 1e-13;
/// Residual of vectors that are exact up to rounding.
pub(crate) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A measured pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    /// Largest component of `P(s) phi` and of `psi^T P(s)`, relative to the largest sum of absolute terms in one;
    /// equations of motion and constraints are measured separately.
    pub(super) residual: f64,
    /// Whether rounding of the vectors alone explains the residual.
    pub(super) rounding_only: bool,
    /// Newton step from `s`: `psi^T P phi / psi^T P' phi`.
    pub(super) newton: Complex,
    /// Error of `s` caused by rounding in `P`.
    pub(super) doubt: f64,
}

impl Measure {
    /// The first `motions` equations are equations of motion.
    pub(super) fn new(linear: &Linear, motions: usize, s: Complex, right: &[Complex], left: &[Complex]) -> Self {
        let of_right = pencil_times(linear, s, right);
        let of_left = pencil_transposed_times(linear, s, left);
        let sizes = sizes(linear, s.norm());
        let (of_rows, of_columns) = (lengths(right), lengths(left));
        let by_right = Residual::of(motions, &of_rows, &of_right, &sizes);
        let by_left = Residual::of(motions, &of_columns, &of_left, &sizes.transpose());
        let slope = dot_complex(left, &pencil_slope_times(linear, s, right));
        let value = dot_complex(left, &of_right);
        let terms = dot(&of_columns, &times(&sizes, &of_rows));
        let rounding = (right.len() as f64 + 4.0) * f64::EPSILON * terms;
        Self {
            residual: by_right.relative.max(by_left.relative),
            rounding_only: by_right.rounding_only && by_left.rounding_only,
            newton: if value == Complex::default() { value } else { value / slope },
            doubt: if rounding == 0.0 { 0.0 } else { rounding / slope.norm() },
        }
    }
}

/// Sums of the absolute terms in the elements of `P(s)`.
fn sizes(linear: &Linear, s: f64) -> Matrix {
    let n = linear.mass.row_count();
    let mut sizes = Matrix::zeros(n, n);
    let elements = sizes.as_flattened_mut().iter_mut();
    let (m, c, k) = (linear.mass.as_flattened(), linear.damping.as_flattened(), linear.stiffness.as_flattened());
    for (size, ((m, c), k)) in elements.zip(m.iter().zip(c).zip(k)) {
        *size = s * (s * m.abs() + c.abs()) + k.abs();
    }
    sizes
}

fn lengths(x: &[Complex]) -> Vector {
    x.iter().map(|x| x.norm()).collect()
}

/// The residual `P(s) x`.
struct Residual {
    relative: f64,
    rounding_only: bool,
}

impl Residual {
    /// Takes the absolute values of the components as `x` and `P(s) x` as `product`.
    fn of(motions: usize, x: &[f64], product: &[Complex], sizes: &Matrix) -> Self {
        let n = x.len();
        let greatest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let (of_motion, of_reactions) = x.split_at(motions);
        let most_of = [greatest(of_motion), greatest(of_reactions)];
        let mut relative = 0.0_f64;
        let mut rounding_only = true;
        for rows in [0..motions, motions..n] {
            let (mut most, mut terms, mut possible) = (0.0_f64, 0.0_f64, 0.0_f64);
            let constraints = rows.start == motions;
            for i in rows {
                let (moving, reacting) = sizes[i].split_at(motions);
                let elements = [greatest(moving), greatest(reacting)];
                let largest = elements[0].max(elements[1]);
                // Constraints in their own units are of order one.
                let unit = if constraints && largest > 0.0 { largest } else { 1.0 };
                let value = product[i].norm() / unit;
                most = if value.is_finite() { most.max(value) } else { f64::INFINITY };
                terms = terms.max(dot(&sizes[i], x) / unit);
                // A vector that the matrix maps to zero has nothing but rounding in the active terms. Motions are
                // therefore measured by the largest active term, and so are reactions.
                let acting = (elements[0] * most_of[0]).max(elements[1] * most_of[1]);
                possible = possible.max(acting / unit);
            }
            rounding_only &= most <= ROUNDING * n as f64 * possible;
            if most > 0.0 {
                relative = relative.max(most / terms);
            }
        }
        Self { relative, rounding_only }
    }
}

/// One step of inverse iteration on the bordered pencil for both vectors.
#[cold]
pub(super) fn inverse_iteration(
    linear: &Linear,
    s: Complex,
    right: &[Complex],
    left: &[Complex],
) -> Option<(Vector<Complex>, Vector<Complex>)> {
    let rate = largest_element(&linear.stiffness) / largest_element(&linear.mass).max(f64::MIN_POSITIVE);
    let rate = rate.sqrt();
    let rate = if rate.is_finite() && rate < 1e150 { rate } else { 1.0 };
    let nearby = s + 1e-11 * s.norm() + 1e-14 * rate;
    let solve = |linear: &Linear, start: &[Complex]| {
        let factors = factors(linear, s).or_else(|| factors(linear, nearby))?;
        let solution = factors.solve(&pencil_slope_times(linear, s, start));
        let most = solution.iter().fold(0.0_f64, |most, x| most.max(x.norm()));
        let normalised = solution.map(|x| x / most);
        normalised.iter().all(|x| x.is_finite()).then_some(normalised)
    };
    Some((solve(linear, right)?, solve(&transposed(linear), left)?))
}

/// Factors of `P(s)`.
fn factors(linear: &Linear, s: Complex) -> Option<Lu<Complex>> {
    let n = linear.mass.row_count();
    Lu::new(&Matrix::from_fn(n, n, |i, j| s * (s * linear.mass[i][j] + linear.damping[i][j]) + linear.stiffness[i][j]))
}
