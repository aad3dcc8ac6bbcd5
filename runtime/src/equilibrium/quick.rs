//! The usual case of a stable equilibrium: a start in the valley of the answer, from which Newton steps lead to it. They are the
//! steps that [`descent`](super::descent) takes, as long as each passes its tests at once; from where one does not, descent
//! goes on with all that it has for hard cases.

use super::convergence::{Last, last};
use super::descent::{GROWTH, Place, Way};
use super::end::{Found, last_step};
use super::problem::{FEW_COORDINATES, Problem};
use crate::array::{Cholesky, Square, add_scaled, dot, form, largest};
use crate::{Mechanism, Real};

/// Newton's method doubles the digits: a start in the valley takes few steps.
const MAX_ITERATIONS: usize = 8;

/// The minimum of the amended potential to which Newton steps lead from `start`, all of them through states where it is
/// convex; otherwise where that ended: at the last such state, or at the start. For mechanisms without constraints.
#[inline]
pub(super) fn quick<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
) -> Result<Found<N>, Place<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let (mechanism, u, b) = (problem.mechanism, problem.inputs, problem.design);
    if const { N <= FEW_COORDINATES } {
        <f64 as Real>::run(
            #[inline(always)]
            || {
                steps(
                    problem,
                    start,
                    #[inline(always)]
                    |q| mechanism.residual_and_stiffness_inlined(q, u, b),
                )
            },
        )
    } else {
        steps(problem, start, |q| {
            mechanism.residual_and_stiffness(q, u, b)
        })
    }
}

#[inline(always)]
fn steps<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    problem: &Problem<'_, M, N, U, P, O>,
    start: &[f64; N],
    evaluate: impl Fn(&[f64; N]) -> ([f64; N], Square<N>),
) -> Result<Found<N>, Place<N>>
where
    M: Mechanism<N, U, P, O>,
{
    let mut place = Place::first(start);
    let (mut residual, mut stiffness) = evaluate(start);
    while place.iterations < MAX_ITERATIONS {
        let Ok(factors) = Cholesky::new(&stiffness) else {
            return Err(place);
        };
        let mut step = factors.solve(&residual).map(|value| -value);
        let left = last(&step, &place.q, N);
        if left != Last::More {
            // A step that changes nothing is not taken.
            let (step, taken) = match left {
                Last::Reached => ([0.0; N], 0),
                _ => (step, 1),
            };
            let displacement = |rest: &[f64; N]| factors.solve(rest);
            let end = last_step(
                problem,
                &place.q,
                (&residual, &stiffness),
                &step,
                displacement,
            );
            return end.ok_or(place).map(|end| Found {
                coordinates: end.coordinates,
                residual: end.residual,
                measured: end.measured,
                iterations: place.iterations + taken,
                left_unstable_region: false,
            });
        }
        let size = largest(&step);
        let limited = size > place.radius;
        let mut share = 1.0;
        if limited {
            share = place.radius / size;
            step = step.map(|value| value * place.radius / size);
        }
        let slope = dot(&step, &residual);
        // A Newton step has as much curvature as it has slope.
        let way = Way {
            slope,
            curvature: -share * slope,
        };
        let next = add_scaled(&place.q, 1.0, &step);
        (residual, stiffness) = evaluate(&next);
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
        place.q = next;
        place.iterations += 1;
    }
    Err(place)
}

#[cfg(test)]
mod tests {
    use super::super::descent::stable;
    use super::super::space::Whole;
    use super::*;
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
                let Ok(expected) =
                    stable::<Whole, _, 2, 1, 0, 0>(&problem, &start, &Place::first(&start))
                else {
                    panic!("no state from {start:?}")
                };
                let found = match quick(&problem, &start) {
                    Ok(found) => {
                        alone += 1;
                        assert!(!expected.left_unstable_region, "{omega} {start:?}");
                        Ok(found)
                    }
                    Err(place) => stable::<Whole, _, 2, 1, 0, 0>(&problem, &start, &place),
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
