//! The kernels of nonlinear motion.

use super::{DirectionalKernels, Linear};
use crate::algebra::{Matrix, Vector};

/// The equations of motion and their linearisation along any motion.
pub trait MotionKernels: DirectionalKernels {
    /// [`Mechanism::motion_residual`](eigentol_contract::Mechanism::motion_residual).
    fn motion_residual_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
    );

    /// [`Mechanism::motion`](eigentol_contract::Mechanism::motion).
    fn motion_into(
        &self,
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        mass: &mut Matrix,
        right: &mut [f64],
    );

    /// [`Mechanism::motion_linear`](eigentol_contract::Mechanism::motion_linear).
    fn motion_linear_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        linear: &mut Linear,
    );
}

impl dyn MotionKernels + '_ {
    /// `g(qddot, qdot, q; u, b)`.
    pub fn motion_residual(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
    ) -> Vector {
        let mut residual = Vector::zeros(q.len());
        self.motion_residual_into(acceleration, velocity, q, u, b, &mut residual);
        residual
    }

    /// `M*` and `Q*`.
    pub fn motion(&self, velocity: &[f64], q: &[f64], u: &[f64], b: &[f64]) -> (Matrix, Vector) {
        let n = q.len();
        let (mut mass, mut right) = (Matrix::zeros(n, n), Vector::zeros(n));
        self.motion_into(velocity, q, u, b, &mut mass, &mut right);
        (mass, right)
    }

    /// The equations of motion linearised along any motion.
    pub fn motion_linear(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
    ) -> Linear {
        let mut linear = Linear::zeros(q.len());
        self.motion_linear_into(acceleration, velocity, q, u, b, &mut linear);
        linear
    }
}
