//! Conditions that every result must satisfy, whatever the input.

use eigentol::sensitivity::{
    equilibrium_shift, output_sensitivities, sensitivities, sensitivities_explicit,
    sensitivities_with_frozen_equilibrium,
};
use eigentol::tolerance::{first_order, output_tolerances};
use eigentol::{
    Behaviour, Equilibrium, Kernels, Modes, Quantity, Sensitivities, Stability, modes, tolerance::Tolerances,
};
use nalgebra::DMatrix;
use std::borrow::Borrow;

#[track_caller]
pub(crate) fn assert_numbers(values: impl IntoIterator<Item: Borrow<f64>>, what: &str) {
    let values: Vec<f64> = values.into_iter().map(|value| *value.borrow()).collect();
    assert!(values.iter().all(|value| !value.is_nan()), "{what}: {values:?}");
}

/// Checks an equilibrium: its residual is small against the forces in it, or is explained by coordinate rounding; if it
/// is called stable, its stiffness is positive definite.
#[track_caller]
pub(crate) fn assert_equilibrium(machine: &dyn Kernels, at: &Equilibrium) {
    // Adjacent values of a large coordinate are far apart.
    assert_settled(machine, at, |q| 1e-12 + 16.0 * f64::EPSILON * q.abs());
}

#[track_caller]
fn assert_settled(machine: &dyn Kernels, at: &Equilibrium, motion: impl Fn(f64) -> f64) {
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    assert!(q.iter().all(|value| value.is_finite()), "{q:?}");
    let linear = &at.linear;
    for matrix in [&linear.mass, &linear.damping, &linear.stiffness] {
        let finite = matrix.as_flattened().iter().all(|value| value.is_finite());
        assert!(finite, "{linear:?}");
    }
    assert_numbers(&at.residual, "residual");
    assert_numbers([at.relative_residual], "relative residual");

    let (residual, parts) = (machine.residual(q, u, b), machine.residual_parts(q, u, b));
    let (k, n) = (&at.linear.stiffness, q.len());
    for i in 0..n {
        let mut scale = 1e-9 * parts.inertia[i].abs().max(parts.applied[i].abs());
        for j in 0..n {
            scale += k[i][j].abs() * motion(q[j]);
        }
        assert!(
            residual[i].abs() <= scale,
            "residual {residual:?}, forces {parts:?}, stability {:?} at {q:?}, u {u:?}, b {b:?}",
            at.stability
        );
    }

    if at.stability == Stability::Stable {
        let unstable = "called stable";
        assert!((0..n).all(|i| k[i][i] > 0.0), "{unstable}: {k:?}");
        let scaled = DMatrix::from_fn(n, n, |i, j| (0.5 * k[i][j] + 0.5 * k[j][i]) / k[i][i].sqrt() / k[j][j].sqrt());
        let least = scaled.symmetric_eigenvalues().min();
        assert!(least > -1e-12, "{unstable} with {least:e}: {k:?}");
    }
}

pub(crate) fn assert_modes(modes: &Modes) {
    for mode in &modes.modes {
        assert_numbers([mode.lambda, mode.residual], "mode");
        let parts = mode.shape.iter().chain(mode.left()).chain([&mode.s]);
        assert_numbers(parts.flat_map(|x| [x.re, x.im]), "shape");
        assert_numbers([mode.error], "error");
        match mode.behaviour {
            Behaviour::Oscillating(omega) => assert!(omega > 0.0 && mode.lambda > 0.0),
            Behaviour::Damped(omega) => assert!(omega > 0.0 && mode.s.re < 0.0),
            Behaviour::Flutter(omega) => assert!(omega > 0.0 && mode.s.re > 0.0),
            Behaviour::Decaying(rate) => assert!(rate > 0.0 && mode.s.re == -rate),
            Behaviour::Divergent(rate) => assert!(rate > 0.0 && mode.lambda < 0.0),
            Behaviour::Free | Behaviour::Neutral => {}
        }
    }
}

fn assert_sensitivities(all: &Sensitivities, what: &str) {
    for mode in &all.modes {
        assert_numbers(&mode.lambda.by_input, what);
        assert_numbers(&mode.lambda.by_design, what);
        for slopes in Quantity::ALL.map(|quantity| mode.of(quantity)).iter().flatten() {
            assert_numbers(&slopes.by_input, what);
            assert_numbers(&slopes.by_design, what);
        }
    }
}

/// Requests every result available at an equilibrium: none may contain a NaN.
pub(crate) fn assert_answers(machine: &dyn Kernels, at: &Equilibrium, tolerances: &Tolerances) {
    assert_equilibrium(machine, at);
    if let Ok(shift) = equilibrium_shift(machine, at) {
        assert_numbers(shift.by_input.as_flattened(), "shift");
        assert_numbers(shift.by_design.as_flattened(), "shift");
    }
    if let Ok(outputs) = output_sensitivities(machine, at) {
        assert_numbers(&outputs.values, "outputs");
        assert_numbers(outputs.by_design.iter().flatten().flatten(), "outputs");
        let found = output_tolerances(&outputs, tolerances).expect("spreads");
        for spread in found.spreads.iter().flatten() {
            assert_numbers([spread.sigma, spread.band], "spread of outputs");
            assert_numbers(&spread.variance_shares, "shares of outputs");
        }
    }
    let Ok(found) = modes::modes(at) else {
        return;
    };
    assert_modes(&found);
    if let Ok(all) = sensitivities(machine, at, &found) {
        assert_sensitivities(&all, "adjoint");
        let spread = first_order(&found, &all, tolerances).expect("spreads");
        assert_numbers([spread.distance_to_critical], "distance");
        for mode in &spread.modes {
            assert_numbers([mode.lambda.sigma, mode.distance_to_critical], "spread of lambda");
            for quantity in Quantity::ALL {
                let spread = mode.of(quantity);
                assert_numbers(spread.iter().flat_map(|x| [x.sigma, x.band]), "spread");
            }
            assert_numbers(mode.variance_shares(), "shares");
        }
    }
    if let Ok(all) = sensitivities_explicit(machine, at, &found) {
        assert_sensitivities(&all, "explicit");
    }
    if let Ok(all) = sensitivities_with_frozen_equilibrium(machine, at, &found) {
        assert_sensitivities(&all, "frozen");
    }
}
