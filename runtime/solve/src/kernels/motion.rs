//! The kernels of nonlinear motion.

use super::batch::lane_by_lane;
use super::{DirectionalKernels, Linear, MotionKernel, linear_results};
use crate::algebra::{Matrix, Vector};
use crate::scalar::Batch;

/// The equations of motion and their linearisation along any motion.
pub trait MotionKernels: DirectionalKernels {
    /// Evaluates a kernel, as [`Kernels::evaluate`](super::Kernels::evaluate).
    fn evaluate_motion(&self, kernel: MotionKernel, arguments: &[&[f64]], results: &mut [&mut [f64]]);

    /// [`Self::evaluate_motion`] with [`WIDTH`](crate::scalar::WIDTH) sets of arguments, one in each lane. A compiled
    /// mechanism takes one after the other, as [`lanes`](super::lanes) takes rustc longer.
    fn evaluate_motion_batch(&self, kernel: MotionKernel, arguments: &[&[Batch]], results: &mut [&mut [Batch]]) {
        lane_by_lane(arguments, results, |arguments, results| {
            self.evaluate_motion(kernel, arguments, results);
        });
    }

    /// [`Mechanism::motion_residual`](eigentol_contract::Mechanism::motion_residual).
    fn motion_residual_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        residual: &mut [f64],
    ) {
        let arguments = &[acceleration, velocity, q, u, b];
        self.evaluate_motion(MotionKernel::Residual, arguments, &mut [residual]);
    }

    /// [`Mechanism::motion`](eigentol_contract::Mechanism::motion).
    fn motion_into(&self, velocity: &[f64], q: &[f64], u: &[f64], b: &[f64], mass: &mut Matrix, right: &mut [f64]) {
        let results = &mut [mass.as_flattened_mut(), right];
        self.evaluate_motion(MotionKernel::Motion, &[velocity, q, u, b], results);
    }

    /// [`Mechanism::motion_linear`](eigentol_contract::Mechanism::motion_linear).
    fn motion_linear_into(
        &self,
        acceleration: &[f64],
        velocity: &[f64],
        q: &[f64],
        u: &[f64],
        b: &[f64],
        linear: &mut Linear,
    ) {
        let arguments = &[acceleration, velocity, q, u, b];
        self.evaluate_motion(MotionKernel::Linear, arguments, &mut linear_results(linear));
    }
}

impl dyn MotionKernels + '_ {
    /// `g(qddot, qdot, q; u, b)`.
    pub fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], q: &[f64], u: &[f64], b: &[f64]) -> Vector {
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
    pub fn motion_linear(&self, acceleration: &[f64], velocity: &[f64], q: &[f64], u: &[f64], b: &[f64]) -> Linear {
        let mut linear = Linear::zeros(q.len());
        self.motion_linear_into(acceleration, velocity, q, u, b, &mut linear);
        linear
    }
}
