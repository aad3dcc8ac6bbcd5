//! Sensitivity of a critical speed or a resonance to the design: `du_c/db`.

use super::condition::{Change, Condition, Crossing};
use super::points::CriticalState;
use crate::algebra::{Matrix, Values, Vector, all_finite, dot, largest, times};
use crate::branches::{Bordered, SpecialKind, critical_inertia};
use crate::constraints::Structure;
use crate::error::NoDerivative;
use crate::kernels::{DirectionalKernels, Gradient, Kernels};
use crate::sensitivity::{check_state, outside_domain, sensitivities};
use crate::{Equilibrium, Error};

/// Condition number above which an eigenvalue counts as merged with another.
const MERGED: f64 = 1e5;

/// Derivative `du_c/db` of a crossing, in SI units of the input per SI unit of the design variable.
///
/// For `omega_j = k u + c` it is `-(domega/db) / (domega/du - k)`, for an onset of flutter `-(dRe s/db) / (dRe s/du)`.
/// With respect to a deviation of the input it is -1: the set value is what is located, while the line follows the
/// actual one.
///
/// # Errors
/// [`Error::ClusteredMode`] if the mode has no derivative of its own, [`Error::NoSensitivity`] if the two sides of the
/// condition touch without crossing; otherwise as [`sensitivities`].
pub fn crossing_sensitivity(mechanism: &dyn Kernels, crossing: &Crossing) -> Result<Vector, Error> {
    let all = sensitivities(mechanism, &crossing.equilibrium, &crossing.modes)?;
    let mode = crossing.mode;
    let (Some(sensitivity), Some(there)) = (all.modes.get(mode), crossing.modes.modes.get(mode)) else {
        let count = all.modes.len();
        return Err(Error::NoSuchMode { mode, count });
    };
    let merges = crossing.merging || there.condition > MERGED;
    if crossing.condition == Condition::FlutterOnset && merges {
        return Err(Error::NoSensitivity { reason: NoDerivative::Merge });
    }
    if sensitivity.clustered {
        return Err(Error::ClusteredMode { mode });
    }
    let (quantity, other) = crossing.condition.sides();
    let Some(slopes) = sensitivity.of(quantity).filter(|_| there.frequency().is_some()) else {
        let lambda = there.lambda;
        return Err(Error::NotOscillating { mode, lambda });
    };
    let Some(&by_input) = slopes.by_input.get(crossing.input.index()) else {
        return Err(Error::NoSensitivity { reason: NoDerivative::UnknownInput });
    };
    let rate = by_input - other;
    let touches = crossing.change == Change::Touch;
    if touches || rate.abs() <= 1e-12 * other.abs().max(by_input.abs()) || rate == 0.0 {
        return Err(Error::NoSensitivity { reason: NoDerivative::Touch });
    }
    let moved = |design: usize| match mechanism.input_of_deviation(design) {
        Some(input) if input == crossing.input.index() => other,
        _ => 0.0,
    };
    let slopes = slopes.by_design.iter().enumerate().map(|(design, value)| -(value - moved(design)) / rate).collect();
    finite(slopes, &crossing.equilibrium)
}

fn finite(slopes: Vector, at: &Equilibrium) -> Result<Vector, Error> {
    if all_finite(&slopes) { Ok(slopes) } else { Err(outside_domain(at)) }
}

/// Components of the residual along the critical mode count as zero below this fraction of what a unit of motion there
/// produces.
const UNFORCED: f64 = 1e-6;

/// Derivative `du_c/db` of a critical value, where `Khat` is singular and the ordinary formulas fail; `v` and `w` are
/// the critical vectors.
///
/// - At a limit point, where the input has a component along the critical mode: `-(w^T dg/db) / (w^T dg/du)`.
/// - At a branch point, where neither input nor design has such a component, the crossing of the branches moves: with
///   the null vectors `x_1 = (v, 0)`, `x_2 = (dq/du, 1)` of `[Khat dg/du]` and the shift `x_b` in their complement,
///   `H (dxi, du) = -w^T (g''(x_i, x_b) + dg'/db x_i)`, `H_ij = w^T g''(x_i, x_j)`. At a pitchfork `H_11 = 0`, and this
///   is the ratio of the slopes of the critical eigenvalue, `-(dlambda/db) / (dlambda/du)`.
///
/// # Errors
/// [`Error::NoSensitivity`] if a design variable acts along the mode at a branch point (it destroys the crossing: its
/// effect is not differentiable) or the branches do not cross; [`Error::ClusteredMode`] if several modes are critical
/// at once; [`Error::OutsideDomain`] if a derivative is not finite.
pub fn critical_sensitivity(mechanism: &dyn DirectionalKernels, critical: &CriticalState) -> Result<Vector, Error> {
    let at = &critical.equilibrium;
    let input = critical.input.index();
    let kernels: &dyn Kernels = mechanism;
    check_state(kernels, at)?;
    if input >= at.inputs.len() {
        return Err(Error::NoSensitivity { reason: NoDerivative::UnknownInput });
    }
    let mut partials = kernels.residual_partials(&at.coordinates, &at.inputs, &at.design);
    at.free.add_to_partials(&mut partials);
    let (by_input, by_design) = partials;
    let force_input = by_input.column(input);
    let forces_design = by_design.transpose();
    match critical.kind {
        SpecialKind::Degenerate => Err(Error::ClusteredMode { mode: 0 }),
        SpecialKind::Fold => {
            let push = dot(&critical.w, &force_input);
            finite(forces_design.iter().map(|force| -dot(&critical.w, force) / push).collect(), at)
        }
        SpecialKind::Pitchfork { .. } | SpecialKind::Transcritical => {
            Crossed::new(mechanism, critical, &force_input)?.shifts(critical, &forces_design)
        }
    }
}

/// Factorises `Khat` of a critical state, bordered by `Mhat v`, with the inertia of speeds in `Mhat`.
pub(crate) fn bordered(critical: &CriticalState) -> Result<Bordered, Error> {
    let linear = &critical.equilibrium.linear;
    let structure = Structure::of(&critical.equilibrium.description);
    let border = times(&critical_inertia(linear, structure, &critical.v), &critical.v);
    let stiffness = critical.equilibrium.held_stiffness();
    Bordered::new(&stiffness, [&border], [&border], [[0.0]]).ok_or(Error::ClusteredMode { mode: 0 })
}

/// The neighbourhood of a branch point.
pub(crate) struct Crossed {
    /// `Khat` bordered by the critical vectors.
    pub(crate) factors: Bordered,
    /// `dq/du` without the part along `v`.
    pub(crate) along: Vector,
    /// `w^T g''(x_i, .)`.
    pub(crate) second: [Gradient; 2],
    /// `H`.
    pub(crate) hessian: [[f64; 2]; 2],
}

impl Crossed {
    pub(crate) fn new(
        mechanism: &dyn DirectionalKernels,
        critical: &CriticalState,
        force_input: &[f64],
    ) -> Result<Self, Error> {
        let at = &critical.equilibrium;
        let factors = bordered(critical)?;
        let (along, _) = factors.solve(&force_input.map(|value| -value), [0.0]);
        let bend = |dq: &[f64], share: f64| {
            let (mut du, db) = (Vector::zeros(at.inputs.len()), Vector::zeros(at.design.len()));
            du[critical.input.index()] = share;
            let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
            let direction = [dq, &du, &db, &Vector::zeros(q.len())];
            mechanism.residual_gradient_along(q, u, b, &critical.w, direction)
        };
        let by_v = bend(&critical.v, 0.0);
        let by_along = bend(&along, 1.0);
        let row = |bend: &Gradient| {
            let input = bend.inputs[critical.input.index()];
            [dot(&bend.coordinates, &critical.v), dot(&bend.coordinates, &along) + input]
        };
        Ok(Self { factors, hessian: [row(&by_v), row(&by_along)], along, second: [by_v, by_along] })
    }

    fn shifts(&self, critical: &CriticalState, forces: &Matrix) -> Result<Vector, Error> {
        let at = &critical.equilibrium;
        let [[a, b], [c, d]] = self.hessian;
        let det = a * d - b * c;
        if det.is_nan() || det.abs() <= 1e-12 * b * b {
            return Err(Error::NoSensitivity { reason: NoDerivative::IndependentOfInput });
        }
        let motions = Structure::of(&at.description).motions();
        let motion = 1.0 / largest(&critical.v[..motions]);
        let mut result = Vector::zeros(at.design.len());
        for (j, force) in forces.iter().enumerate() {
            let (shift, _) = self.factors.solve(&force.map(|value| -value), [0.0]);
            let rates = self.second.each_ref().map(|bend| dot(&bend.coordinates, &shift) + bend.design[j]);
            let share = (critical.value / at.design[j]).abs();
            let scale = rates[0].abs() + b.abs() * if share.is_finite() { share } else { 0.0 };
            if dot(&critical.w, force).abs() > UNFORCED * scale * motion {
                return Err(Error::NoSensitivity { reason: NoDerivative::Imperfection });
            }
            result[j] = (c * rates[0] - a * rates[1]) / det;
        }
        finite(result, at)
    }
}
