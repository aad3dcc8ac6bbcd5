//! Exact second derivatives, with respect to the design, of the input values at which an event occurs.

use super::curvature::mode_curvature;
use crate::algebra::{Matrix, Vector, all_finite, all_finite_matrix};
use crate::error::NoDerivative;
use crate::kernels::CurvatureKernels;
use crate::sensitivity::outside_domain;
use crate::sweep::{Crossing, crossing_sensitivity};
use crate::{Description, Equilibrium, Error, Input, Shared};

/// First and second derivatives, with respect to the design, of an input value at which an event occurs, SI.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventCurvature {
    /// The input.
    pub input: Input,
    /// Its value at the event.
    pub value: f64,
    /// First derivatives with respect to the design variables
    /// ([`critical_sensitivity`](crate::sweep::critical_sensitivity),
    /// [`crossing_sensitivity`](crate::sweep::crossing_sensitivity)).
    pub first: Vector,
    /// Second derivatives with respect to two design variables.
    pub second: Matrix,
    /// Largest difference between mirrored second derivatives before averaging, relative to the largest derivative:
    /// zero in exact arithmetic.
    pub asymmetry: f64,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl EventCurvature {
    pub(super) fn finite(self, at: &Equilibrium) -> Result<Self, Error> {
        if all_finite(&self.first) && all_finite_matrix(&self.second) { Ok(self) } else { Err(outside_domain(at)) }
    }
}

/// First and second derivatives of a crossing with respect to all design variables: `f(u, b) = 0` with
/// `f = omega_j - k u - c` or `Re s_j`, differentiated twice along `u(b)`.
///
/// # Errors
/// As [`crossing_sensitivity`] and [`mode_curvature`].
pub fn crossing_curvature(mechanism: &dyn CurvatureKernels, crossing: &Crossing) -> Result<EventCurvature, Error> {
    let at = &crossing.equilibrium;
    let first = crossing_sensitivity(mechanism, crossing)?;
    let curvature = mode_curvature(mechanism, at, &crossing.modes, crossing.mode)?;
    let (quantity, ratio) = crossing.condition.sides();
    let i = crossing.input.index();
    let (Some(slopes), Some(second)) = (curvature.first.of(quantity), curvature.of(quantity)) else {
        return Err(Error::NoSensitivity { reason: NoDerivative::NotSmooth });
    };
    let slope = slopes.by_input[i] - ratio;
    let (mixed, curved) = (&second.by_input_and_design[i], second.by_input[i][i]);
    let bend = |j: usize, k: usize| {
        let (du, dv) = (first[j], first[k]);
        -(second.by_design[j][k] + mixed[j] * dv + mixed[k] * du + curved * du * dv) / slope
    };
    EventCurvature {
        input: crossing.input,
        value: crossing.value,
        second: Matrix::from_fn(first.len(), first.len(), bend),
        first,
        asymmetry: curvature.asymmetry,
        description: at.description.clone(),
    }
    .finite(at)
}
