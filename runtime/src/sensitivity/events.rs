//! How a critical speed or a resonance moves with the design: `du_c/db`.

use super::sensitivities;
use super::shift::outside_domain;
use crate::array::{Lu, Square, add_scaled, all_finite, dot, largest, times, transpose};
use crate::equilibrium::{CriticalState, Crossing};
use crate::modes::clusters;
use crate::{Equilibrium, Error, Mechanism};

/// `du_c/db` of a crossing: of `omega_j = k u + c` it is `-(domega/db) / (domega/du - k)`, of an onset of flutter
/// `-(dRe s/db) / (dRe s/du)`; SI units of the input by those of the design variable.
///
/// # Errors
/// [`Error::ClusteredMode`] where the mode has no derivative of its own, [`Error::NoSensitivity`] where the two sides of
/// the condition touch without crossing; otherwise as [`sensitivities`].
pub fn crossing_sensitivity<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    crossing: &Crossing<N, U, P>,
) -> Result<[f64; P], Error>
where
    M: Mechanism<N, U, P, O>,
{
    let all = sensitivities(mechanism, &crossing.equilibrium, &crossing.modes)?;
    let mode = crossing.mode;
    let (Some(own), Some(there)) = (all.modes.get(mode), crossing.modes.modes.get(mode)) else {
        let count = all.modes.len();
        return Err(Error::NoSuchMode { mode, count });
    };
    if own.clustered {
        return Err(Error::ClusteredMode { mode });
    }
    let (quantity, other) = crossing.condition.sides();
    let Some(slopes) = own.of(quantity).filter(|_| there.frequency().is_some()) else {
        let lambda = there.lambda;
        return Err(Error::NotOscillating { mode, lambda });
    };
    let Some(&by_input) = slopes.by_input.get(crossing.input.0) else {
        return Err(Error::NoSensitivity {
            reason: "there is no such input",
        });
    };
    let rate = by_input - other;
    if rate.abs() <= 1e-12 * other.abs().max(by_input.abs()) || rate == 0.0 {
        return Err(Error::NoSensitivity {
            reason: "the two sides touch without crossing",
        });
    }
    let slopes = slopes.by_design.map(|value| -value / rate);
    finite(slopes, &crossing.equilibrium)
}

fn finite<const N: usize, const U: usize, const P: usize>(
    slopes: [f64; P],
    at: &Equilibrium<N, U, P>,
) -> Result<[f64; P], Error> {
    if all_finite(&slopes) {
        Ok(slopes)
    } else {
        Err(outside_domain(at))
    }
}

/// Parts of the residual along the critical mode below this fraction of what a unit of motion there does count as zero.
const UNFORCED: f64 = 1e-6;

/// `du_c/db` of a critical value, where `Khat` is singular and the ordinary formulas fail.
///
/// - At a limit point, where the input pushes along the critical mode (`phi^T dg/du` not zero):
///   `-(phi^T dg/db) / (phi^T dg/du)`.
/// - At a bifurcation, where neither input nor design does: `-(dlambda/db) / (dlambda/du)` along the branch, with the
///   shift solved in the complement of the critical mode.
///
/// # Errors
/// [`Error::NoSensitivity`] when a design variable pushes along the mode at a bifurcation (it destroys the bifurcation:
/// its effect is not differentiable) or `lambda` does not depend on the input; [`Error::ClusteredMode`];
/// [`Error::OutsideDomain`] when a derivative is not finite.
pub fn critical_sensitivity<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    critical: &CriticalState<N, U, P>,
) -> Result<[f64; P], Error>
where
    M: Mechanism<N, U, P, O>,
{
    let at = &critical.equilibrium;
    let Some(mode) = critical.modes.modes.first() else {
        return Err(Error::NoSensitivity {
            reason: "there is no mode",
        });
    };
    if critical.input.0 >= U {
        return Err(Error::NoSensitivity {
            reason: "there is no such input",
        });
    }
    if clusters(&critical.modes, 1e-6)[0] {
        return Err(Error::ClusteredMode { mode: 0 });
    }
    let phi = &mode.real_shape();
    let direct = mechanism.mode_gradient(&at.coordinates, &at.inputs, &at.design, phi, mode.lambda);
    let (by_input, by_design) =
        mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    let weighted = times(&at.linear.mass, phi);
    let deflated = Deflated::new(&critical.modes, &at.linear.stiffness, &weighted)?;
    let force_input: [f64; N] = by_input.map(|row| row[critical.input.0]);
    let forces_design: [[f64; N]; P] = transpose(&by_design);
    let rate = |explicit: f64, force: &[f64; N]| {
        explicit + dot(&direct.coordinates, &deflated.shift(phi, &weighted, force))
    };
    let lambda_u = rate(direct.inputs[critical.input.0], &force_input);
    let motion = 1.0 / largest(phi);
    let push_u = dot(phi, &force_input);
    if push_u.abs() > UNFORCED * lambda_u.abs() * motion {
        return finite(forces_design.map(|force| -dot(phi, &force) / push_u), at);
    }
    if lambda_u == 0.0 {
        return Err(Error::NoSensitivity {
            reason: "the stiffness does not depend on the input",
        });
    }
    let mut result = [0.0; P];
    for (j, force) in forces_design.iter().enumerate() {
        let lambda_b = rate(direct.design[j], force);
        let share = (critical.value / at.design[j]).abs();
        let scale = lambda_b.abs() + lambda_u.abs() * if share.is_finite() { share } else { 0.0 };
        if dot(phi, force).abs() > UNFORCED * scale * motion {
            let reason =
                "a design variable pushes along the critical mode and destroys the bifurcation";
            return Err(Error::NoSensitivity { reason });
        }
        result[j] = -lambda_b / lambda_u;
    }
    finite(result, at)
}

/// `Khat` with the critical mode stiffened, so that it can be inverted in the complement of that mode.
struct Deflated<const N: usize> {
    factors: Lu<f64, N>,
}

impl<const N: usize> Deflated<N> {
    fn new(
        modes: &crate::Modes<N>,
        stiffness: &Square<N>,
        weighted: &[f64; N],
    ) -> Result<Self, Error> {
        let most = modes
            .modes
            .iter()
            .fold(0.0, |most: f64, mode| most.max(mode.lambda.abs()));
        let added = if N > 1 && most > 0.0 { most } else { 1.0 };
        let matrix: Square<N> = core::array::from_fn(|i| {
            core::array::from_fn(|j| stiffness[i][j] + added * weighted[i] * weighted[j])
        });
        Lu::new(&matrix)
            .map(|factors| Self { factors })
            .ok_or(Error::CriticalState)
    }

    /// Shift by `force`, without its part along the mode.
    fn shift(&self, phi: &[f64; N], weighted: &[f64; N], force: &[f64; N]) -> [f64; N] {
        let rest = add_scaled(force, -dot(phi, force), weighted);
        self.factors.solve(&rest).map(|value| -value)
    }
}
