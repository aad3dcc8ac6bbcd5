//! The usual case of a stable equilibrium: the start lies in the valley of the answer, and Newton steps lead to it.
//!
//! These are the steps that [`descent`](super::descent) takes, as long as each passes its tests immediately. At the
//! first one that fails, descent takes over with its methods for hard cases.
//!
//! # The straight way first
//!
//! Nearly every solve starts in the valley of its answer. `equilibrium/newton_fast_path.rs`, a short loop around the
//! kernel, takes full Newton steps as long as each passes the tests of the descent. The descent continues from where
//! they end, and hands back once it has left a region where the potential is not convex (from such a start the double
//! pendulum takes 1.4 us, against 2.2 by descent alone). A sweep starts where its last states point (`prediction.rs`);
//! only a state near the prediction counts, otherwise it starts from the last one. Between smoothly successive states
//! whose least eigenvalue is far from zero, no critical state is sought.

use super::Equilibrium;
use super::convergence::{StepsLeft, TOLERANCE, is_rounding, last, relative_of};
use super::descent::{GROWTH, LineModel, SearchState};
use super::operating_point::OperatingPoint;
use crate::algebra::{Cholesky, Vector, all_finite, dot, factor_rows, for_size, largest, solve_rows, unless_finite};
use crate::kernels::RestParts;

/// Newton's method doubles the digits: a start in the valley needs few steps.
const MAX_ITERATIONS: usize = 8;

/// Finds the minimum of the amended potential by Newton steps from `progress`, all of them through states where it is
/// convex. For mechanisms without constraints.
///
/// Overwrites `state` except for its stability, and returns whether it is solved; otherwise `progress` is the last convex
/// state, and what `state` holds is unspecified.
pub(super) fn newton_fast_path(
    point: &OperatingPoint<'_>,
    progress: &mut SearchState,
    state: &mut Equilibrium,
) -> bool {
    for_size(
        point.size(),
        #[inline(always)]
        |n| newton(n, point, progress, state),
    )
}

/// Like [`newton_fast_path`], for `n` unknowns.
#[inline(always)]
fn newton(
    n: usize,
    point: &OperatingPoint<'_>,
    SearchState { q, radius, iterations }: &mut SearchState,
    state: &mut Equilibrium,
) -> bool {
    let (u, b) = (point.inputs, point.design);
    let evaluate = |q: &[f64], residual: &mut [f64], stiffness: &mut [f64]| {
        point.mechanism.residual_and_stiffness_into(q, u, b, residual, stiffness);
    };
    let (q, most) = (&mut q[..n], *iterations + MAX_ITERATIONS);
    let Equilibrium { coordinates, residual, linear, .. } = &mut *state;
    let (next, residual) = (&mut coordinates[..n], &mut residual[..n]);
    let stiffness = &mut linear.stiffness.as_flattened_mut()[..n * n];
    let (mut factors, mut step) = (Cholesky::default(), Vector::zeros(n));
    let ((lower, pivots), step) = (factors.room(n), &mut step[..n]);
    evaluate(q, residual, stiffness);
    while *iterations < most {
        if factor_rows(n, stiffness, lower, pivots).is_err() {
            return false;
        }
        step.copy_from_slice(residual);
        solve_rows(n, lower, pivots, step);
        step.iter_mut().for_each(|value| *value = -*value);
        let left = last(step, q, n);
        if left != StepsLeft::More {
            // A step that changes nothing is not taken.
            let taken = left != StepsLeft::Reached;
            if !taken {
                step.fill(0.0);
            }
            for ((end, q), step) in next.iter_mut().zip(&*q).zip(&*step) {
                *end = q + step;
            }
            let before = largest(residual);
            state.iterations = *iterations + usize::from(taken);
            state.left_unstable_region = false;
            return ends(n, point, before, (lower, pivots), state);
        }
        let size = largest(step);
        let limited = size > *radius;
        let mut share = 1.0;
        if limited {
            share = *radius / size;
            step.iter_mut().for_each(|value| *value = *value * *radius / size);
        }
        let slope = dot(step, residual);
        // A Newton step has as much curvature as slope.
        let way = LineModel { slope, curvature: -share * slope };
        for ((next, q), step) in next.iter_mut().zip(&*q).zip(&*step) {
            *next = q + step;
        }
        evaluate(next, residual, stiffness);
        // NaN, infinite and overflowing values fail one of the two.
        let slope = dot(step, residual);
        let rows = stiffness.chunks_exact(n.max(1));
        let curvature = step.iter().zip(rows).fold(-0.0, |sum, (x, row)| sum + x * dot(row, step));
        let finite = unless_finite(slope) + unless_finite(curvature) == 0.0;
        if !(way.slope < 0.0 && finite && way.falls(1.0, slope, curvature)) {
            return false;
        }
        if limited && way.predicts(1.0, slope) {
            *radius *= GROWTH;
        }
        q.copy_from_slice(next);
        *iterations += 1;
    }
    false
}

/// Completes the state at the coordinates reached by the last step, and returns whether it is solved: the residual has
/// fallen to a small share of its size `before` the step or to rounding, as
/// [`last_step`](super::acceptance::last_step) requires.
#[inline(always)]
fn ends(
    n: usize,
    point: &OperatingPoint<'_>,
    before: f64,
    (lower, pivots): (&[f64], &[f64]),
    state: &mut Equilibrium,
) -> bool {
    let (u, b) = (point.inputs, point.design);
    let (q, linear) = (&state.coordinates[..n], &mut state.linear);
    let mut parts = RestParts::zeros(n);
    point.mechanism.parts_and_linear_into(q, u, b, &mut parts, linear);
    let (residual, forces) = (&mut state.residual[..n], [&parts.inertia[..n], &parts.applied[..n]]);
    for (rest, (inertia, applied)) in residual.iter_mut().zip(forces[0].iter().zip(forces[1])) {
        *rest = inertia + -1.0 * applied;
    }
    if !(all_finite(residual) && point.infinite(n, linear).is_none()) {
        return false;
    }
    let stiffness = linear.stiffness.as_flattened();
    state.relative_residual = relative_of((n, n), forces, q, residual, stiffness);
    let fell = largest(residual) <= 1e-3 * before || {
        let mut displacement = Vector::from(&*residual);
        solve_rows(n, lower, pivots, &mut displacement);
        is_rounding(&displacement[..n], q, n)
    };
    fell && state.relative_residual <= TOLERANCE
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::algebra::add_scaled;
    use crate::equilibrium::acceptance::{Candidate, UnjudgedResult};
    use crate::equilibrium::descent::minimise_potential;
    use crate::equilibrium::search_space::Unconstrained;
    use eigentol_macros::mechanism;

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
        let alone = Cell::new(0);
        let fast = |point: &OperatingPoint<'_>, mut progress| {
            let mut state = point.blank_state();
            if !newton_fast_path(point, &mut progress, &mut state) {
                return Err(progress);
            }
            alone.set(alone.get() + 1);
            Ok(state)
        };
        let mut resumed = 0;
        for omega in [0.0, 1.0, 3.0, 3.3, 5.0, 9.0] {
            let inputs = [omega];
            let point = OperatingPoint::unchecked(&DoublePendulum, &inputs, &[]);
            let straight = |progress| {
                let equilibrium: Result<Equilibrium, SearchState> = fast(&point, progress);
                let found = equilibrium.ok()?;
                let end = Candidate { coordinates: found.coordinates, residual: found.residual, measured: None };
                Some(UnjudgedResult::new(end, found.iterations))
            };
            for k in 0..400_i32 {
                let start = [0.47 * f64::from(k % 20 - 10), 0.41 * f64::from(k / 20 - 10)];
                let Ok(expected) =
                    minimise_potential::<Unconstrained>(&point, &start, &SearchState::first(&start), |_| None)
                else {
                    panic!("no state from {start:?}")
                };
                let left = expected.left_unstable_region;
                let coordinates = match fast(&point, SearchState::first(&start)) {
                    Ok(state) => {
                        assert!(!left, "{omega} {start:?}");
                        state.coordinates
                    }
                    Err(error) => {
                        let before = alone.get();
                        let unjudged = minimise_potential::<Unconstrained>(&point, &start, &error, straight);
                        let Ok(found) = unjudged else { panic!("nothing from {start:?}") };
                        assert_eq!(found.left_unstable_region, left, "{omega} {start:?}");
                        resumed += alone.get() - before;
                        found.coordinates
                    }
                };
                let apart = add_scaled(&coordinates, -1.0, &expected.coordinates);
                assert!(largest(&apart) < 1e-9, "{omega} {start:?}: {apart:?}");
            }
        }
        assert!(alone.get() - resumed > 300, "{alone:?}");
        assert!(resumed > 300, "{resumed}");
    }
}
