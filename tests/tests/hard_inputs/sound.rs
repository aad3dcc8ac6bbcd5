//! What every result must satisfy, whatever was asked.

use eigentol::sensitivity::{
    equilibrium_shift, output_sensitivities, sensitivities, sensitivities_explicit,
    sensitivities_with_frozen_equilibrium,
};
use eigentol::tolerance::{first_order, output_tolerances};
use eigentol::{
    Behaviour, Equilibrium, Mechanism, Modes, Sensitivities, Stability, modes,
    tolerance::Tolerances,
};
use nalgebra::DMatrix;

#[track_caller]
pub(crate) fn assert_numbers(values: impl IntoIterator<Item = f64>, what: &str) {
    let values: Vec<f64> = values.into_iter().collect();
    assert!(
        values.iter().all(|value| !value.is_nan()),
        "{what}: {values:?}"
    );
}

/// An equilibrium is one: its residual is small against the forces in it, or is what rounding its coordinates leaves; and
/// when it is called stable, its stiffness is positive definite.
#[track_caller]
pub(crate) fn assert_equilibrium<
    M,
    const N: usize,
    const U: usize,
    const P: usize,
    const O: usize,
>(
    machine: &M,
    at: &Equilibrium<N, U, P>,
) where
    M: Mechanism<N, U, P, O>,
{
    // Neighbouring values of a large coordinate are far apart.
    assert_settled(machine, at, |q| 1e-12 + 16.0 * f64::EPSILON * q.abs());
}

#[track_caller]
fn assert_settled<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: &M,
    at: &Equilibrium<N, U, P>,
    motion: impl Fn(f64) -> f64,
) where
    M: Mechanism<N, U, P, O>,
{
    let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
    assert!(q.iter().all(|value| value.is_finite()), "{q:?}");
    let linear = [at.linear.mass, at.linear.damping, at.linear.stiffness];
    for value in linear.as_flattened().as_flattened() {
        assert!(value.is_finite(), "{linear:?}");
    }
    assert_numbers(at.residual, "residual");
    assert_numbers([at.relative_residual], "relative residual");

    let (residual, parts) = (machine.residual(q, u, b), machine.residual_parts(q, u, b));
    let k = &at.linear.stiffness;
    for i in 0..N {
        let mut scale = 1e-9 * parts.inertia[i].abs().max(parts.applied[i].abs());
        for j in 0..N {
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
        assert!((0..N).all(|i| k[i][i] > 0.0), "{unstable}: {k:?}");
        let scaled = DMatrix::from_fn(N, N, |i, j| {
            (0.5 * k[i][j] + 0.5 * k[j][i]) / k[i][i].sqrt() / k[j][j].sqrt()
        });
        let least = scaled.symmetric_eigenvalues().min();
        assert!(least > -1e-12, "{unstable} with {least:e}: {k:?}");
    }
}

pub(crate) fn assert_modes<const N: usize>(modes: &Modes<N>) {
    for mode in &modes.modes {
        assert_numbers([mode.lambda, mode.residual], "mode");
        let parts = mode.shape.iter().chain(&mode.left).chain([&mode.s]);
        assert_numbers(parts.flat_map(|x| [x.re, x.im]), "shape");
        assert_numbers([mode.error], "error");
        match mode.behaviour {
            Behaviour::Oscillating(omega) => assert!(omega > 0.0 && mode.lambda > 0.0),
            Behaviour::Damped(omega) => assert!(omega > 0.0 && mode.s.re < 0.0),
            Behaviour::Flutter(omega) => assert!(omega > 0.0 && mode.s.re > 0.0),
            Behaviour::Decaying(rate) => assert!(rate > 0.0 && mode.s.re == -rate),
            Behaviour::Divergent(rate) => assert!(rate > 0.0 && mode.lambda < 0.0),
            Behaviour::Neutral => {}
        }
    }
}

fn assert_sensitivities<const N: usize, const U: usize, const P: usize>(
    all: &Sensitivities<N, U, P>,
    what: &str,
) {
    for own in &all.modes {
        assert_numbers(own.lambda_by_input, what);
        assert_numbers(own.lambda_by_design, what);
        assert_numbers(own.omega_by_input.into_iter().flatten(), what);
        assert_numbers(own.omega_by_design.into_iter().flatten(), what);
    }
}

/// Everything that can be asked at an equilibrium: no answer holds a NaN.
pub(crate) fn assert_answers<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    machine: &M,
    at: &Equilibrium<N, U, P>,
    tolerances: &Tolerances<P>,
) where
    M: Mechanism<N, U, P, O>,
{
    assert_equilibrium(machine, at);
    if let Ok(shift) = equilibrium_shift(machine, at) {
        assert_numbers(shift.by_input.into_iter().flatten(), "shift");
        assert_numbers(shift.by_design.into_iter().flatten(), "shift");
    }
    if let Ok(outputs) = output_sensitivities(machine, at) {
        assert_numbers(outputs.values, "outputs");
        assert_numbers(outputs.by_design.into_iter().flatten().flatten(), "outputs");
        for spread in output_tolerances(&outputs, tolerances).outputs {
            assert_numbers(
                spread.sigma.into_iter().chain(spread.band),
                "spread of outputs",
            );
            assert_numbers(
                spread.variance_shares.into_iter().flatten(),
                "shares of outputs",
            );
        }
    }
    let Ok(found) = modes::modes(at) else {
        return;
    };
    assert_modes(&found);
    if let Ok(all) = sensitivities(machine, at, &found) {
        assert_sensitivities(&all, "adjoint");
        let spread = first_order(&found, &all, tolerances);
        assert_numbers([spread.distance_to_critical], "distance");
        for own in &spread.modes {
            assert_numbers(
                [own.lambda_sigma, own.distance_to_critical],
                "spread of lambda",
            );
            assert_numbers(own.sigma.into_iter().chain(own.band), "spread");
            assert_numbers(own.variance_shares, "shares");
        }
    }
    if let Ok(all) = sensitivities_explicit(machine, at, &found) {
        assert_sensitivities(&all, "explicit");
    }
    if let Ok(all) = sensitivities_with_frozen_equilibrium(machine, at, &found) {
        assert_sensitivities(&all, "frozen");
    }
}
