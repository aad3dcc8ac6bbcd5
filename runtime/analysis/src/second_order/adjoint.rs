//! Accounts for the motion of the equilibrium in a gradient and in its derivative along a direction.

use crate::algebra::{Lu, Matrix, Vector, times_columns};
use crate::kernels::{CurvatureKernels, Directional, Gradient, Kernels};
use crate::scalar::Real as _;
use crate::sensitivity::{Direction, subtract};
use crate::{Equilibrium, Error};

/// Turns the partial derivatives of a scalar `y` into total ones: `dy - (dg)^T w`, `Khat^T w = dy/dq`.
pub(crate) struct Adjoint<'a> {
    mechanism: &'a dyn CurvatureKernels,
    at: &'a Equilibrium,
    /// LU factors of `Khat^T`.
    factors: Lu<f64>,
}

impl<'a> Adjoint<'a> {
    pub(crate) fn new(mechanism: &'a dyn CurvatureKernels, at: &'a Equilibrium) -> Result<Self, Error> {
        let factors = Lu::new(&at.held_stiffness().transpose()).ok_or(Error::CriticalState)?;
        Ok(Self { mechanism, at, factors })
    }

    /// Makes a gradient total and returns `w`.
    pub(crate) fn total(&self, gradient: &mut Gradient, room: &mut Gradient) -> Vector {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let w = self.factors.solve(&gradient.coordinates);
        let kernels: &dyn Kernels = self.mechanism;
        kernels.residual_gradient_into(q, u, b, &w, room);
        let free = &self.at.free;
        free.add_to_gradient(&w, &mut room.inputs, &mut room.design);
        subtract(gradient, room);
        w
    }

    /// Like [`Self::total_along`], for several directions at once, which are among `all` directions of inputs and design:
    /// these hold the shift of the equilibrium, `(dg)^T Khat^-T y = -(dq*)^T y`.
    pub(super) fn total_along_each(
        &self,
        changes: &mut [Gradient],
        w: &[f64],
        directions: &[Direction],
        (shift, room): (&Matrix, &mut [Gradient]),
    ) {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let still = Vector::zeros(q.len());
        let along = directions.iter().map(|direction| {
            let [dq, du, db] = direction.parts();
            [dq, du, db, &still]
        });
        let along: Vec<[&[f64]; 4]> = along.collect();
        let here: [&[f64]; 4] = [q, u, b, w];
        let points: Vec<[&[&[f64]]; 2]> = along.iter().map(|along| [&here[..], along]).collect();
        self.mechanism.evaluate_along_each(Directional::ResidualGradient, &points, room);
        for ((change, room), direction) in changes.iter_mut().zip(room).zip(directions) {
            self.add_held(w, direction, room);
            subtract(change, room);
        }
        let right = Matrix::from_fn(q.len(), changes.len(), |i, j| changes[j].coordinates[i]);
        let moved = f64::run(
            #[inline(always)]
            || times_columns(shift, &right),
        );
        for (j, change) in changes.iter_mut().enumerate() {
            let all = change.inputs.iter_mut().chain(change.design.iter_mut());
            for (value, moved) in all.zip(moved.iter()) {
                *value += moved[j];
            }
        }
    }

    /// Turns the derivative of a partial gradient along a direction into that of the total gradient; `w` is the result
    /// of [`Self::total`].
    pub(crate) fn total_along(&self, change: &mut Gradient, w: &[f64], direction: &Direction, room: &mut Gradient) {
        let (q, u, b) = (&self.at.coordinates, &self.at.inputs, &self.at.design);
        let [dq, du, db] = direction.parts();
        let still = Vector::zeros(q.len());
        self.mechanism.residual_gradient_along_into(q, u, b, w, [dq, du, db, &still], room);
        self.add_held(w, direction, room);
        subtract(change, room);
        self.total(change, room);
    }

    /// Adds the change of the held values along a direction.
    fn add_held(&self, w: &[f64], direction: &Direction, change: &mut Gradient) {
        let at = (&self.at.inputs[..], &self.at.design[..]);
        let [_, du, db] = direction.parts();
        let change = (&mut change.inputs[..], &mut change.design[..]);
        let free = &self.at.free;
        free.add_to_gradient_along(self.mechanism, at, w, (du, db), change);
    }
}
