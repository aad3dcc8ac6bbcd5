//! Two masses on a spring, in the place of the first and the distance of the second: `s^2 + c s / m + k / m = 0` with
//! `1 / m = 1 / m1 + 1 / m2`.

use super::{constrained, deflation};
use crate::Complex;
use crate::algebra::Matrix;
use crate::constraints::Structure;
use crate::eigenproblem::{Eigenproblem, Pairs, roots_of};
use crate::kernels::Linear;

/// A small mass beside a large one is the rest of sums in which it hardly appears: the errors know it.
#[test]
fn errors_hold_what_cancels_while_zeros_are_taken_out() {
    let square = |rows: [[f64; 2]; 2]| Matrix::from_fn(2, 2, |i, j| rows[i][j]);
    let structure = Structure { coordinates: 2, speeds: 0, position_constraints: 0, velocity_constraints: 0 };
    let mut cancelled = 0;
    for k in 0..400 {
        let decade = |n: usize| 10.0_f64.powf(((k * n) % 97) as f64 * 12.0 / 97.0 - 6.0);
        let (first, second, stiffness) = (decade(1), decade(29), decade(53));
        let per_mass = 1.0 / first + 1.0 / second;
        let damping = 0.1 * (stiffness / per_mass).sqrt();
        let linear = |damping: f64| Linear {
            mass: square([[first + second, second], [second, second]]),
            damping: square([[0.0, 0.0], [0.0, damping]]),
            stiffness: square([[0.0, 0.0], [0.0, stiffness]]),
        };
        let whole = linear(0.0);
        let mut pairs = Pairs::default();
        deflation::pairs(&whole.stiffness, &whole.mass, 1, &mut pairs).expect("pairs");
        let off = (pairs.lambda[1] - stiffness * per_mass).abs();
        assert!(off <= pairs.errors[1], "{k}: {off:e} {:e}", pairs.errors[1]);
        cancelled += usize::from(off > 1e-12 * pairs.lambda[1]);

        let whole = linear(damping);
        let roots = deflation::roots(&whole, 1, |rest| roots_of(Eigenproblem::Quadratic(rest))).expect("roots");
        let roots = constrained::measured(&whole, structure, &roots);
        let half = 0.5 * damping * per_mass;
        let exact = Complex::new(-half, (stiffness * per_mass - half * half).sqrt());
        let root = roots.last().expect("a root");
        let off = (root.s - exact).norm();
        assert!(off <= root.error, "{k}: {off:e} {:e}", root.error);
    }
    assert!(cancelled > 50, "{cancelled}");
}
