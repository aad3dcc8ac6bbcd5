//! How a critical speed or a resonance moves with the design: `du_c/db`.

use super::sensitivities;
use super::shift::outside_domain;
use crate::array::{all_finite, dot, times, transpose};
use crate::constraints::Structure;
use crate::equilibrium::branch::Bordered;
use crate::equilibrium::{Condition, CriticalState, Crossing, SpecialKind};
use crate::{Equilibrium, Error, Gradient, Mechanism};

/// Condition number of an eigenvalue from which on it counts as merged with another.
const MERGED: f64 = 1e5;

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
    if crossing.condition == Condition::FlutterOnset && there.condition > MERGED {
        return Err(Error::NoSensitivity {
            reason: "two frequencies merge there: the least damping moves the onset by a finite amount",
        });
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

/// `du_c/db` of a critical value, where `Khat` is singular and the ordinary formulas fail; `v`, `w` the critical vectors.
///
/// - At a limit point, where the input pushes along the critical mode: `-(w^T dg/db) / (w^T dg/du)`.
/// - At a branch point, where neither input nor design does, the crossing of the branches moves: with the null vectors
///   `x_1 = (v, 0)`, `x_2 = (dq/du, 1)` of `[Khat dg/du]` and the shift `x_b` in their complement,
///   `H (dxi, du) = -w^T (g''(x_i, x_b) + dg'/db x_i)`, `H_ij = w^T g''(x_i, x_j)`. At a pitchfork `H_11 = 0`, and this is
///   the ratio of the slopes of the critical eigenvalue, `-(dlambda/db) / (dlambda/du)`.
///
/// # Errors
/// [`Error::NoSensitivity`] when a design variable pushes along the mode at a branch point (it destroys the crossing:
/// its effect is not differentiable) or the branches do not cross; [`Error::ClusteredMode`] where several modes are
/// critical at once; [`Error::OutsideDomain`] when a derivative is not finite.
pub fn critical_sensitivity<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    critical: &CriticalState<N, U, P>,
) -> Result<[f64; P], Error>
where
    M: Mechanism<N, U, P, O>,
{
    let at = &critical.equilibrium;
    let input = critical.input.0;
    if input >= U {
        return Err(Error::NoSensitivity {
            reason: "there is no such input",
        });
    }
    let (by_input, by_design) =
        mechanism.residual_partials(&at.coordinates, &at.inputs, &at.design);
    let force_input: [f64; N] = by_input.map(|row| row[input]);
    let forces_design: [[f64; N]; P] = transpose(&by_design);
    match critical.kind {
        SpecialKind::Degenerate => Err(Error::ClusteredMode { mode: 0 }),
        SpecialKind::Fold => {
            let push = dot(&critical.w, &force_input);
            finite(
                forces_design.map(|force| -dot(&critical.w, &force) / push),
                at,
            )
        }
        SpecialKind::Pitchfork { .. } | SpecialKind::Transcritical => {
            Crossed::new(mechanism, critical, &force_input)?.shifts(critical, &forces_design)
        }
    }
}

/// The neighbourhood of a branch point.
struct Crossed<const N: usize, const P: usize> {
    /// `Khat` bordered by the critical vectors.
    factors: Bordered<N, 1>,
    /// `w^T g''(x_i, .)` by coordinate and by design variable.
    second: [([f64; N], [f64; P]); 2],
    /// `H`.
    hessian: [[f64; 2]; 2],
}

impl<const N: usize, const P: usize> Crossed<N, P> {
    fn new<M, const U: usize, const O: usize>(
        mechanism: &M,
        critical: &CriticalState<N, U, P>,
        force_input: &[f64; N],
    ) -> Result<Self, Error>
    where
        M: Mechanism<N, U, P, O>,
    {
        let at = &critical.equilibrium;
        let column = times(&at.linear.mass, &critical.v);
        let factors = Bordered::new(&at.linear.stiffness, [&column], [&column], [[0.0]])
            .ok_or(Error::ClusteredMode { mode: 0 })?;
        let (along, _) = factors.solve(&force_input.map(|value| -value), [0.0]);
        let unit =
            |share: f64| core::array::from_fn(|j| if j == critical.input.0 { share } else { 0.0 });
        let bend = |dq: &[f64; N], du: &[f64; U]| {
            mechanism.residual_gradient_along(
                &at.coordinates,
                &at.inputs,
                &at.design,
                &critical.w,
                dq,
                du,
                &[0.0; P],
                &[0.0; N],
            )
        };
        let by_v = bend(&critical.v, &unit(0.0));
        let by_along = bend(&along, &unit(1.0));
        let row = |bend: &Gradient<f64, N, U, P>| {
            let input = bend.inputs[critical.input.0];
            [
                dot(&bend.coordinates, &critical.v),
                dot(&bend.coordinates, &along) + input,
            ]
        };
        Ok(Self {
            factors,
            hessian: [row(&by_v), row(&by_along)],
            second: [by_v, by_along].map(|bend| (bend.coordinates, bend.design)),
        })
    }

    fn shifts<const U: usize>(
        &self,
        critical: &CriticalState<N, U, P>,
        forces: &[[f64; N]; P],
    ) -> Result<[f64; P], Error> {
        let at = &critical.equilibrium;
        let [[a, b], [c, d]] = self.hessian;
        let det = a * d - b * c;
        if det.is_nan() || det.abs() <= 1e-12 * b * b {
            return Err(Error::NoSensitivity {
                reason: "the stiffness does not depend on the input",
            });
        }
        let constraints = Structure::of(at.description).constraints();
        let most = critical.v[..N.saturating_sub(constraints)].iter();
        let motion = 1.0 / most.fold(0.0, |most: f64, value| most.max(value.abs()));
        let mut result = [0.0; P];
        for (j, force) in forces.iter().enumerate() {
            let (shift, _) = self.factors.solve(&force.map(|value| -value), [0.0]);
            let rates = self
                .second
                .each_ref()
                .map(|(coordinates, design)| dot(coordinates, &shift) + design[j]);
            let share = (critical.value / at.design[j]).abs();
            let scale = rates[0].abs() + b.abs() * if share.is_finite() { share } else { 0.0 };
            if dot(&critical.w, force).abs() > UNFORCED * scale * motion {
                return Err(Error::NoSensitivity {
                    reason: "a design variable pushes along the critical mode and destroys the bifurcation",
                });
            }
            result[j] = (c * rates[0] - a * rates[1]) / det;
        }
        finite(result, at)
    }
}
