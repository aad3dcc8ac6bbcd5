//! The equations `g(q, u_k) = 0` of a branch, and Newton's method on a plane across it.

use super::super::convergence::{ACCEPTED, relative_residual};
use super::super::regularity::constraint_state;
use super::super::stability::{Stability, judge};
use super::super::{Failure, Problem};
use super::bordered::Bordered;
use super::frame::{Frame, Place, System};
use super::settings::Continuation;
use crate::array::all_finite;
use crate::constraints::{Structure, redundant_rows};
use crate::rounding;
use crate::{Description, Equilibrium, Error, Linear, Mechanism};

/// A mechanism of which one input varies.
pub(crate) struct Curve<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> {
    pub(crate) mechanism: &'a M,
    pub(crate) inputs: &'a [f64; U],
    pub(crate) design: &'a [f64; P],
    pub(crate) settings: &'a Continuation,
    /// Redundant constraints, which Newton's method is better off without; every point is held to all of them.
    dropped: [bool; N],
}

/// Why a point was not reached.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Trouble<const N: usize> {
    /// The equations are not finite there.
    OutsideDomain([f64; N]),
    /// The input describes no body that can exist.
    Unphysical(Error),
    /// The point does not pass as an equilibrium.
    Refused(Failure<N>),
    /// The reason in words.
    Missed(&'static str),
}

impl<const N: usize> Trouble<N> {
    /// Whether the equations end there.
    pub(crate) fn at_edge(&self) -> bool {
        matches!(
            self,
            Self::OutsideDomain(_)
                | Self::Unphysical(_)
                | Self::Refused(Failure::OutsideDomain { .. })
        )
    }
}

/// A point of the branch on a given plane.
pub(crate) struct Corrected<const N: usize> {
    pub(crate) local: Place<N>,
    pub(crate) place: Place<N>,
    pub(crate) system: System<N>,
    pub(crate) iterations: usize,
}

/// Displacement, in units of coordinates and input, that residuals are compared with.
const SMALL: f64 = 1e-3;
/// A Newton step this small, in local units, leaves rounding.
const LAST_STEP: f64 = 1e-13;
/// A step that no longer shrinks has reached rounding below this size.
const ROUNDING: f64 = 1e-8;
/// A Newton step that keeps more than this share of the one before does not converge.
const CONTRACTION: f64 = 0.5;

impl<'a, M, const N: usize, const U: usize, const P: usize, const O: usize> Curve<'a, M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    pub(crate) const DESCRIPTION: &'static Description = &M::DESCRIPTION;
    /// Number of coordinates and speeds.
    pub(crate) const MOTIONS: usize =
        N.saturating_sub(Structure::of(&M::DESCRIPTION).constraints());

    pub(crate) fn new(
        mechanism: &'a M,
        inputs: &'a [f64; U],
        design: &'a [f64; P],
        settings: &'a Continuation,
    ) -> Self {
        Self {
            mechanism,
            inputs,
            design,
            settings,
            dropped: [false; N],
        }
    }

    /// The same for branches near a state.
    pub(crate) fn about(mut self, state: &Equilibrium<N, U, P>) -> Self {
        let structure = const { Structure::of(&M::DESCRIPTION) };
        if structure.constraints() > 1 {
            self.dropped = redundant_rows(&state.linear.stiffness, structure);
        }
        self
    }

    pub(crate) fn inputs_at(&self, p: f64) -> [f64; U] {
        let input = self.settings.input.0;
        core::array::from_fn(|j| if j == input { p } else { self.inputs[j] })
    }

    /// The linearised mechanism at a place.
    pub(crate) fn linear(&self, at: &Place<N>) -> Result<Linear<f64, N>, Trouble<N>> {
        Problem::unchecked(self.mechanism, &self.inputs_at(at.p), self.design)
            .linear(&at.q)
            .map_err(Trouble::Refused)
    }

    pub(crate) fn system(&self, at: &Place<N>) -> Result<System<N>, Trouble<N>> {
        let inputs = self.inputs_at(at.p);
        let (residual, stiffness) = Problem::unchecked(self.mechanism, &inputs, self.design)
            .without(&self.dropped)
            .evaluate(&at.q)
            .ok_or(Trouble::OutsideDomain(at.q))?;
        let (by_inputs, _) = self
            .mechanism
            .residual_partials(&at.q, &inputs, self.design);
        let by_input = core::array::from_fn(|i| {
            if self.dropped[i] {
                0.0
            } else {
                by_inputs[i][self.settings.input.0]
            }
        });
        if all_finite(&by_input) {
            Ok(System {
                residual,
                stiffness,
                by_input,
            })
        } else {
            Err(Trouble::OutsideDomain(at.q))
        }
    }

    /// Gradient by `(q, u_k)` of the derivative of `w^T g` along `direction`.
    pub(crate) fn curvature(
        &self,
        at: &Place<N>,
        w: &[f64; N],
        direction: &Place<N>,
    ) -> Result<Place<N>, Trouble<N>> {
        let input = self.settings.input.0;
        let along = core::array::from_fn(|j| if j == input { direction.p } else { 0.0 });
        let gradient = self.mechanism.residual_gradient_along(
            &at.q,
            &self.inputs_at(at.p),
            self.design,
            w,
            &direction.q,
            &along,
            &[0.0; P],
            &[0.0; N],
        );
        let found = Place {
            q: gradient.coordinates,
            p: gradient.inputs[input],
        };
        if found.finite() {
            Ok(found)
        } else {
            Err(Trouble::OutsideDomain(at.q))
        }
    }

    /// The equilibrium at a place. Its residual is relative, beside what an ordinary solve knows, to what a thousandth of the
    /// range restores: where `Khat` is singular the input holds what coordinates do not. Where neither does, `also` is
    /// another measure of it.
    pub(crate) fn equilibrium(
        &self,
        at: &Place<N>,
        system: &System<N>,
        iterations: usize,
        also: Option<f64>,
    ) -> Result<Equilibrium<N, U, P>, Trouble<N>> {
        let inputs = self.inputs_at(at.p);
        if let Some(violation) = self.mechanism.violation(&inputs, self.design) {
            return Err(Trouble::Unphysical(Error::Unphysical {
                quantity: violation.quantity,
                requirement: violation.requirement,
                value: violation.value,
            }));
        }
        let problem = Problem::unchecked(self.mechanism, &inputs, self.design);
        let linear = problem.linear(&at.q).map_err(Trouble::Refused)?;
        let residual = if self.dropped.contains(&true) {
            problem.residual(&at.q)
        } else {
            system.residual
        };
        let mut relative = relative_residual(&problem, &at.q, &residual, &linear.stiffness);
        if relative.is_nan() || relative > ACCEPTED {
            relative = self
                .with_input(&at.q, system)
                .min(also.unwrap_or(f64::INFINITY));
        }
        if relative > ACCEPTED {
            return Err(Trouble::Refused(Failure::NotFound {
                reason: "the residual stays larger than rounding explains",
                coordinates: at.q,
                iterations,
                relative,
            }));
        }
        let constraints =
            constraint_state(&problem, &at.q, &residual, &linear).map_err(Trouble::Refused)?;
        let (stability, rounding) = if constraints.singular {
            (Stability::Undecided, 0.0)
        } else {
            let place = rounding::Place {
                coordinates: &at.q,
                inputs: &inputs,
                design: self.design,
                residual: &residual,
            };
            judge(self.mechanism, &place, &linear).map_err(Trouble::Refused)?
        };
        Ok(Equilibrium {
            coordinates: at.q,
            inputs,
            design: *self.design,
            stability,
            rounding,
            constraints,
            linear,
            residual,
            relative_residual: relative,
            iterations,
            pose: self.mechanism.pose_margin(&at.q, &inputs, self.design),
            left_unstable_region: false,
            description: Self::DESCRIPTION,
        })
    }

    /// Greatest residual, each relative to what a thousandth of the range or of a coordinate's unit restores.
    fn with_input(&self, q: &[f64; N], system: &System<N>) -> f64 {
        (0..N).fold(0.0, |most: f64, i| {
            let input = system.by_input[i].abs() * self.settings.range();
            let scale = (0..N).fold(input, |sum, j| {
                sum + system.stiffness[i][j].abs() * (self.settings.size + q[j].abs())
            });
            let residual = system.residual[i].abs();
            most.max(if residual > 0.0 {
                residual / (SMALL * scale)
            } else {
                0.0
            })
        })
    }

    pub(crate) fn frame(&self, at: &Place<N>, system: &System<N>) -> Frame<N> {
        Frame::new(
            *at,
            self.settings.size,
            self.settings.range(),
            system,
            Self::MOTIONS,
        )
    }

    /// Solves `g = 0` on the plane through `from` across `normal` (both local), not farther than `reach` from it.
    pub(crate) fn correct(
        &self,
        frame: &Frame<N>,
        from: &Place<N>,
        normal: &Place<N>,
        reach: f64,
    ) -> Result<Corrected<N>, Trouble<N>> {
        let mut local = *from;
        let mut last = f64::INFINITY;
        let mut stalled = false;
        for iterations in 0..=self.settings.max_corrections + 1 {
            let place = frame.place(&local);
            let system = self.system(&place)?;
            if last <= LAST_STEP || stalled {
                return Ok(Corrected {
                    local,
                    place,
                    system,
                    iterations,
                });
            }
            let scaled = frame.scaled(&system);
            let off = normal.dot(&local.plus(-1.0, from));
            let step = plane(&scaled, normal)
                .map(|lu| lu.solve(&scaled.residual.map(|value| -value), [-off]))
                .map(|(q, [p])| Place { q, p })
                .filter(Place::finite)
                .ok_or(Trouble::Missed("the branch is not isolated"))?;
            let size = step.norm();
            if size > CONTRACTION * last {
                if last > ROUNDING {
                    return Err(Trouble::Missed("Newton's method does not converge"));
                }
                stalled = true;
                continue;
            }
            local = local.plus(1.0, &step);
            last = size;
            if local.plus(-1.0, from).norm() > reach {
                return Err(Trouble::Missed("the branch bends away"));
            }
        }
        if last <= ROUNDING {
            let place = frame.place(&local);
            let system = self.system(&place)?;
            return Ok(Corrected {
                local,
                place,
                system,
                iterations: self.settings.max_corrections,
            });
        }
        Err(Trouble::Missed("Newton's method does not converge"))
    }
}

/// `[Khat dg/du; normal^T]`.
pub(crate) fn plane<const N: usize>(
    scaled: &System<N>,
    normal: &Place<N>,
) -> Option<Bordered<N, 1>> {
    Bordered::new(
        &scaled.stiffness,
        [&scaled.by_input],
        [&normal.q],
        [[normal.p]],
    )
}
