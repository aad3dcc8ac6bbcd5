//! Eigenvalues of a matrix polynomial in doubles: the Ehrlich-Aberth method applied to its determinant (O. Aberth,
//! Iteration methods for finding all zeros of a polynomial simultaneously, 1973). The iteration count is bounded, and
//! the method is unlike the product's solvers.

use nalgebra::{Complex, DMatrix};

/// The most sweeps over all eigenvalues.
const SWEEPS: usize = 2000;

/// `A(s) = sum_k s^k coefficients[k]` and its derivative by `s`.
pub(super) fn evaluate(coefficients: &[DMatrix<Complex<f64>>], s: Complex<f64>) -> [DMatrix<Complex<f64>>; 2] {
    let n = coefficients[0].nrows();
    let mut value = DMatrix::zeros(n, n);
    let mut slope = DMatrix::zeros(n, n);
    for coefficient in coefficients.iter().rev() {
        slope = slope * s + &value;
        value = value * s + coefficient;
    }
    [value, slope]
}

/// All eigenvalues; repeated ones only to a root of the working accuracy. The leading coefficient must be regular.
pub(super) fn eigenvalues(coefficients: &[DMatrix<Complex<f64>>]) -> Vec<Complex<f64>> {
    let mut complexes = starts(coefficients);
    let mut settled = vec![false; complexes.len()];
    for _ in 0..SWEEPS {
        if settled.iter().all(|&settled| settled) {
            break;
        }
        let most = complexes.iter().map(|s| s.norm()).fold(0.0, f64::max);
        for i in 0..complexes.len() {
            if settled[i] {
                continue;
            }
            let Some(step) = newton_step(coefficients, complexes[i]) else {
                settled[i] = true;
                continue;
            };
            let others = (0..complexes.len()).filter(|&j| j != i);
            let pull: Complex<f64> = others.map(|j| (complexes[i] - complexes[j]).inv()).sum();
            let step = step / (Complex::from(1.0) - step * pull);
            if step.is_finite() {
                complexes[i] -= step;
                settled[i] = step.norm() <= 1e-14 * complexes[i].norm() + 1e-16 * most;
            } else {
                // Two approximations have met, or the step is not finite: move away.
                complexes[i] *= Complex::new(1.01, 0.01);
            }
        }
    }
    complexes
}

/// Eigenvalues of a real quadratic pencil with `Im s >= 0`, by magnitude. The sum of all eigenvalues is checked: it
/// must be `-tr(M^-1 C)`.
///
/// # Panics
/// When the sum differs.
pub(super) fn upper_half(coefficients: &[DMatrix<Complex<f64>>]) -> Vec<Complex<f64>> {
    let mut all = eigenvalues(coefficients);
    let most = all.iter().map(|s| s.norm()).fold(0.0, f64::max);
    let ratio = coefficients[2].clone().lu().solve(&coefficients[1]);
    let trace = ratio.expect("a regular mass matrix").trace();
    let sum: Complex<f64> = all.iter().sum();
    assert!((sum + trace).norm() <= 1e-6 * most, "{all:?} and {trace}");
    for s in &mut all {
        // Real up to rounding.
        if s.im.abs() <= 1e-10 * s.norm() {
            s.im = 0.0;
        }
    }
    all.retain(|s| s.im >= 0.0);
    all.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
    all
}

/// `p / p'` of `p = det A`, from `p' / p = tr(A^-1 A')`; `None` where `A` is singular.
fn newton_step(coefficients: &[DMatrix<Complex<f64>>], s: Complex<f64>) -> Option<Complex<f64>> {
    let [value, slope] = evaluate(coefficients, s);
    let quotient = value.lu().solve(&slope)?;
    Some(quotient.trace().inv())
}

/// Start values: magnitudes estimated from the diagonals, in different directions.
fn starts(coefficients: &[DMatrix<Complex<f64>>]) -> Vec<Complex<f64>> {
    let (n, degree) = (coefficients[0].nrows(), coefficients.len() - 1);
    let sizes: Vec<f64> =
        (0..n).map(|i| coefficients[0][(i, i)].norm() / coefficients[degree][(i, i)].norm()).collect();
    let typical = sizes.iter().copied().fold(1e-6, f64::max);
    (0..n * degree)
        .map(|k| {
            let size = sizes[k % n].max(1e-6 * typical).powf(1.0 / degree as f64);
            let angle = 0.4 + 2.0 * std::f64::consts::PI * 0.618_033_988_75 * k as f64;
            Complex::from_polar(size * (1.0 + 0.03 * k as f64), angle)
        })
        .collect()
}
