//! The usual case of a stable equilibrium: a start in the valley of the answer, from which Newton steps lead to it. They are the
//! steps that [`descent`](super::descent) takes, as long as each passes its tests at once; from where one does not, descent
//! goes on with all that it has for hard cases.

use super::convergence::{Last, last};
use super::descent::{GROWTH, Place, Way};
use super::end::{Found, last_step};
use super::problem::Problem;
use crate::algebra::{Cholesky, Matrix, Vector, dot, form, largest};

/// Newton's method doubles the digits: a start in the valley takes few steps.
const MAX_ITERATIONS: usize = 8;

/// The minimum of the amended potential to which Newton steps lead from `start`, all of them through states where it is
/// convex; otherwise where that ended: at the last such state, or at the start. For mechanisms without constraints.
pub(super) fn quick(problem: &Problem<'_>, start: &[f64]) -> Result<Found, Place> {
    let n = problem.size();
    let evaluate = |q: &[f64], residual: &mut Vector, stiffness: &mut Matrix| {
        let (u, b) = (problem.inputs, problem.design);
        problem
            .mechanism
            .residual_and_stiffness_into(q, u, b, residual, stiffness);
    };
    let mut place = Place::first(start);
    let (mut residual, mut stiffness) = (Vector::zeros(n), Matrix::zeros(n, n));
    let mut factors = Cholesky::zeros(n);
    let (mut step, mut next) = (Vector::zeros(n), Vector::zeros(n));
    evaluate(start, &mut residual, &mut stiffness);
    while place.iterations < MAX_ITERATIONS {
        if factors.factor(&stiffness).is_err() {
            return Err(place);
        }
        step.copy_from_slice(&residual);
        factors.solve_in_place(&mut step);
        step.iter_mut().for_each(|value| *value = -*value);
        let left = last(&step, &place.q, n);
        if left != Last::More {
            // A step that changes nothing is not taken.
            let taken = left != Last::Reached;
            if !taken {
                step.fill(0.0);
            }
            let at = (&residual[..], &stiffness);
            let displacement = |rest: &[f64]| factors.solve(rest);
            return match last_step(problem, &place.q, at, &step, displacement) {
                Some(end) => Ok(Found::new(end, place.iterations + usize::from(taken))),
                None => Err(place),
            };
        }
        let size = largest(&step);
        let limited = size > place.radius;
        let mut share = 1.0;
        if limited {
            share = place.radius / size;
            step.iter_mut()
                .for_each(|value| *value = *value * place.radius / size);
        }
        let slope = dot(&step, &residual);
        // A Newton step has as much curvature as it has slope.
        let way = Way {
            slope,
            curvature: -share * slope,
        };
        for ((next, q), step) in next.iter_mut().zip(&place.q).zip(&step) {
            *next = q + step;
        }
        evaluate(&next, &mut residual, &mut stiffness);
        // NaN, infinite and overflowing values fail one of the two.
        let slope = dot(&step, &residual);
        let curvature = form(&step, &stiffness, &step);
        let finite = slope.is_finite() && curvature.is_finite();
        if !(way.slope < 0.0 && finite && way.falls(1.0, slope, curvature)) {
            return Err(place);
        }
        if limited && way.predicts(1.0, slope) {
            place.radius *= GROWTH;
        }
        core::mem::swap(&mut place.q, &mut next);
        place.iterations += 1;
    }
    Err(place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::add_scaled;
    use crate::equilibrium::descent::stable;
    use crate::equilibrium::space::Whole;
    use crate::mechanism;

    mechanism! {
        mechanism DoublePendulum {
            input  omega: rad/s;
            gravity 9.81 m/s^2 along -z;
            body shaft: massless;
            body bar1: rod(mass: 3 kg, length: 1 m, along: -z);
            body bar2: rod(mass: 3 kg, length: 1 m, along: -z);
            joint spin:   revolute(z) from ground to shaft, driven at omega;
            joint theta1: revolute(y) from shaft to bar1;
            joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -1 m];
        }
    }

    #[test]
    fn the_way_is_that_of_descent() {
        let mut alone = 0;
        for omega in [0.0, 1.0, 3.0, 3.3, 5.0, 9.0] {
            let inputs = [omega];
            let problem = Problem::unchecked(&DoublePendulum, &inputs, &[]);
            for k in 0..400_i32 {
                let start = [0.47 * f64::from(k % 20 - 10), 0.41 * f64::from(k / 20 - 10)];
                let Ok(expected) = stable::<Whole>(&problem, &start, &Place::first(&start)) else {
                    panic!("no state from {start:?}")
                };
                let found = match quick(&problem, &start) {
                    Ok(found) => {
                        alone += 1;
                        assert!(!expected.left_unstable_region, "{omega} {start:?}");
                        Ok(found)
                    }
                    Err(place) => stable::<Whole>(&problem, &start, &place),
                };
                let Ok(found) = found else {
                    panic!("nothing from {start:?}")
                };
                let apart = add_scaled(&found.coordinates, -1.0, &expected.coordinates);
                assert!(largest(&apart) < 1e-9, "{omega} {start:?}: {apart:?}");
            }
        }
        assert!(alone > 300, "{alone}");
    }
}
