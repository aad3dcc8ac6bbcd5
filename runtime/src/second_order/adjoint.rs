//! Accounts for the motion of the equilibrium in a gradient and in its derivative along a direction.

use crate::algebra::{Lu, Vector};
use crate::kernels::{CurvatureKernels, Gradient, Kernels};
use crate::sensitivity::{Direction, subtract};
use crate::{Equilibrium, Error};

/// Turns the partial derivatives of a scalar `y` into total ones: `dy - (dg)^T w`, `Khat^T w = dy/dq`.
pub(super) struct Adjoint<'a> {
    mechanism: &'a dyn CurvatureKernels,
    at: &'a Equilibrium,
    /// LU factors of `Khat^T`.
    factors: Lu<f64>,
}

impl<'a> Adjoint<'a> {
    pub(super) fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
    ) -> Result<Self, Error> {
        let factors = Lu::new(&at.held_stiffness().transpose()).ok_or(Error::CriticalState)?;
        Ok(Self {
            mechanism,
            at,
            factors,
        })
    }

    /// Makes a gradient total and returns `w`.
    pub(super) fn total(&self, gradient: &mut Gradient, room: &mut Gradient) -> Vector {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let w = self.factors.solve(&gradient.coordinates);
        let kernels: &dyn Kernels = self.mechanism;
        kernels.residual_gradient_into(q, u, b, &w, room);
        let free = &self.at.free;
        free.add_to_gradient(&w, &mut room.inputs, &mut room.design);
        subtract(gradient, room);
        w
    }

    /// Turns the derivative of a partial gradient along a direction into that of the total gradient; `w` is the result
    /// of [`Self::total`].
    pub(super) fn total_along(
        &self,
        change: &mut Gradient,
        w: &[f64],
        direction: &Direction,
        room: &mut Gradient,
    ) {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let [dq, du, db] = direction.parts();
        let direction = [dq, du, db, &Vector::zeros(q.len())];
        self.mechanism
            .residual_gradient_along_into(q, u, b, w, direction, room);
        subtract(change, room);
        self.total(change, room);
    }
}
