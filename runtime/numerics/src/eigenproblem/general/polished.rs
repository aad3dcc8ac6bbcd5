//! One eigenvalue whose vectors come from inverse iteration on the linearisation: Newton's method on the Rayleigh
//! functional improves the value, and corrections the vectors. Their residuals are those of the pencil; only the system
//! solved for a correction is that of the linearisation (Dongarra, Moler and Wilkinson, "Improving the accuracy of
//! computed eigenvalues and eigenvectors", 1983).

use num_complex::Complex64;

use super::linearisation::Side;
use super::measure::Pair;
use super::pencil::{Pencil, Products, modulus};
use super::solver::PairSolver;

/// Residual of vectors that need no correction.
const CLEAN: f64 = 2e-14;
/// Maximum number of corrections.
const CORRECTIONS: usize = 3;
/// Newton steps with the same vectors.
const STEPS: usize = 2;

impl PairSolver<'_> {
    /// The pair near `start`, at a distance `gap` from the next eigenvalue, with vectors of the linearisation to start
    /// from. Its second-order error is left open.
    pub(super) fn polished(
        &mut self,
        (start, gap): (Complex64, f64),
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        let n = self.pencil.n;
        let mut pair = self.rayleigh_newton((start, start), gap, right, left);
        for _ in 0..CORRECTIONS {
            let Some(iteration) = &mut self.iteration else {
                break;
            };
            if pair.residual <= CLEAN || !pair.residual.is_finite() {
                break;
            }
            iteration.factor_shifted(start);
            let mut vectors = [vec![Complex64::ZERO; n], vec![Complex64::ZERO; n]];
            let sides = [(Side::Right, &*right), (Side::Left, &*left)];
            for ((side, x), corrected) in sides.into_iter().zip(&mut vectors) {
                let products = match side {
                    Side::Right => &self.of_right,
                    Side::Left => &self.of_left,
                };
                for (i, rest) in corrected.iter_mut().enumerate() {
                    *rest = products.value(pair.s, i);
                }
                iteration.correct(&self.linearisation, side, corrected);
                let along = along(&self.pencil, products, corrected);
                for (d, x) in corrected.iter_mut().zip(x) {
                    *d += x - along * x;
                }
            }
            let [new_right, new_left] = &mut vectors;
            let better = self.rayleigh_newton((start, pair.s), gap, new_right, new_left);
            let enough = better.residual <= 0.5 * pair.residual;
            if better.residual < pair.residual {
                right.copy_from_slice(new_right);
                left.copy_from_slice(new_left);
                pair = better;
            }
            if !enough {
                break;
            }
        }
        if start.im == 0.0 {
            pair = self.or_zero(pair, left);
        }
        pair.conjugate = start.im > 0.0;
        pair.condition = self.condition(&pair, right, left);
        pair
    }

    /// The second-order error of a pair: the product of its right residual with the correction of its left vector.
    pub(super) fn second_order(&mut self, pair: &Pair, right: &[Complex64], left: &[Complex64]) -> f64 {
        let n = self.pencil.n;
        self.pencil.multiply(right, false, &mut self.of_right);
        self.pencil.multiply(left, true, &mut self.of_left);
        let mut change: Vec<_> = (0..n).map(|i| self.of_left.value(pair.s, i)).collect();
        if let Some(iteration) = &mut self.iteration {
            iteration.factor_shifted(pair.s);
            iteration.correct(&self.linearisation, Side::Left, &mut change);
        }
        let along = along(&self.pencil, &self.of_left, &change);
        change
            .iter()
            .zip(left)
            .enumerate()
            .map(|(i, (d, x))| modulus(d - along * x) * modulus(self.of_right.value(pair.s, i)))
            .sum::<f64>()
            / modulus(pair.slope)
    }

    /// Newton steps from `s`, within a quarter of the gap about `start`.
    fn rayleigh_newton(
        &mut self,
        (start, s): (Complex64, Complex64),
        gap: f64,
        right: &mut [Complex64],
        left: &mut [Complex64],
    ) -> Pair {
        let mut pair = self.examine(s, right, left);
        for _ in 0..STEPS {
            let mut next = pair.s - pair.newton;
            if start.im == 0.0 {
                next.im = 0.0;
            }
            let far = modulus(next - start);
            let is_rounding = modulus(pair.newton) <= pair.doubt() && pair.doubt() > 1e-3 * gap;
            let leaves = far.is_nan() || far > 0.25 * gap || start.im > 0.0 && next.im <= 0.0;
            if pair.is_settled() || is_rounding || leaves {
                break;
            }
            pair = self.measure(next, left);
        }
        pair
    }
}

/// The component of `d` along the normalised vector with these products.
fn along(pencil: &Pencil, products: &Products, d: &[Complex64]) -> Complex64 {
    pencil.weighed(products).iter().zip(d).map(|(x, d)| x.conj() * d).sum()
}
