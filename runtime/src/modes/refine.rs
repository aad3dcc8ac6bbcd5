//! Inverse iteration for the pairs that the eigensolver left inaccurate: where eigenvalues spread over many orders of
//! magnitude, the small ones come out with the rounding of the great ones.

use crate::array::{Lu, Square, add_scaled, all_finite, dot, form, largest_element, times};

const STEPS: usize = 4;
/// Eigenvalues closer than this, relative to the larger, may mix in an inverse iteration.
const NEAR: f64 = 1e-3;

/// Improves pair `r`; keeps it mass-orthogonal to the earlier pairs near it. Leaves it alone when that does not help.
#[cold]
pub(super) fn refine<const N: usize>(
    stiffness: &Square<N>,
    mass: &Square<N>,
    lambda: &mut [f64; N],
    shapes: &mut [[f64; N]; N],
    r: usize,
    residual: impl Fn(f64, &[f64; N]) -> f64,
) {
    let mut best = residual(lambda[r], &shapes[r]);
    let (mut value, mut shape) = (lambda[r], shapes[r]);
    let rounding = f64::EPSILON * largest_element(stiffness) / largest_element(mass);
    for _ in 0..STEPS {
        let shifted = |shift: f64| -> Square<N> {
            core::array::from_fn(|i| add_scaled(&stiffness[i], -shift, &mass[i]))
        };
        let Some(factors) = Lu::new(&shifted(value))
            .or_else(|| Lu::new(&shifted(value + 1e-10 * value.abs() + rounding)))
        else {
            return;
        };
        shape = factors.solve(&times(mass, &shape));
        for s in 0..r {
            if (lambda[s] - value).abs() <= NEAR * lambda[s].abs().max(value.abs()) {
                let part = form(&shapes[s], mass, &shape);
                shape = add_scaled(&shape, -part, &shapes[s]);
            }
        }
        let size = form(&shape, mass, &shape).sqrt();
        shape = shape.map(|component| component / size);
        value = dot(&shape, &times(stiffness, &shape));
        if !all_finite(&shape) || !value.is_finite() {
            return;
        }
        let reached = residual(value, &shape);
        if reached < best {
            best = reached;
            lambda[r] = value;
            shapes[r] = shape;
        }
    }
}
