//! Scalars built from the residual, their gradients, and directional derivatives of those gradients.

use num_dual::Dual;

use super::scalar::{along, rates, seeded, still};
use super::{Oracle, Scalar, State};

/// A scalar function of `(q, u, b)` and of further arguments, held fixed in a gradient.
pub trait Functional {
    /// Its value.
    fn value<D: Scalar>(&self, oracle: &Oracle, at: [&[D]; 3], fixed: &[D]) -> D;
}

/// `phi^T (Khat - lambda Mhat) phi`; fixed arguments: `phi`, then `lambda`.
#[derive(Clone, Copy, Debug)]
pub struct ModeFunctional;

impl Functional for ModeFunctional {
    fn value<D: Scalar>(&self, oracle: &Oracle, [q, u, b]: [&[D]; 3], fixed: &[D]) -> D {
        let (&lambda, phi) = fixed.split_last().expect("phi and lambda");
        let rest = State::at_rest(q, u, b).lifted();
        // Khat phi and Mhat phi: g differentiated along phi in q and in qddot
        let stiff = State { position: along(q, phi), ..rest.clone() };
        let heavy = State { acceleration: along(&vec![D::zero(); q.len()], phi), ..rest };
        let stiff = rates(&oracle.motion_residual(&stiff));
        let heavy = rates(&oracle.motion_residual(&heavy));
        let term = |i: usize| phi[i] * (stiff[i] - lambda * heavy[i]);
        (0..phi.len()).map(term).sum()
    }
}

/// `left^T (Mhat acceleration + Chat velocity + Khat position)`; fixed arguments: the four vectors in this order.
#[derive(Clone, Copy, Debug)]
pub struct PencilFunctional;

impl Functional for PencilFunctional {
    fn value<D: Scalar>(&self, oracle: &Oracle, [q, u, b]: [&[D]; 3], fixed: &[D]) -> D {
        let n = q.len();
        let vector = |k: usize| &fixed[k * n..(k + 1) * n];
        let (left, linear) = (vector(0), oracle.linear(q, u, b));
        let matrices = [&linear.mass, &linear.damping, &linear.stiffness];
        let form = |(k, matrix): (usize, &Vec<D>)| -> D {
            let entry = |ij: usize| left[ij / n] * matrix[ij] * vector(k + 1)[ij % n];
            (0..n * n).map(entry).sum()
        };
        matrices.into_iter().enumerate().map(form).sum()
    }
}

/// `w^T g(0, 0, q; u, b)`; fixed argument: `w`.
#[derive(Clone, Copy, Debug)]
pub struct ResidualFunctional;

impl Functional for ResidualFunctional {
    fn value<D: Scalar>(&self, oracle: &Oracle, [q, u, b]: [&[D]; 3], fixed: &[D]) -> D {
        oracle.residual(q, u, b).iter().zip(fixed).map(|(&g, &w)| g * w).sum()
    }
}

/// A direction in `(q, u, b)` and in the fixed arguments of a gradient.
#[derive(Clone, Copy, Debug)]
pub struct Along<'a> {
    /// `dq`, `du`, `db`.
    pub at: [&'a [f64]; 3],
    /// Direction in the fixed arguments.
    pub fixed: &'a [f64],
}

impl Oracle<'_> {
    /// Gradient of a functional by coordinates, inputs and design variables.
    pub fn gradient<D: Scalar>(&self, functional: &impl Functional, at: [&[D]; 3], fixed: &[D]) -> [Vec<D>; 3] {
        let fixed = still(fixed);
        std::array::from_fn(|group| {
            let partial = |k: usize| {
                let mut lifted = at.map(still);
                lifted[group] = seeded(at[group], k);
                let [q, u, b] = &lifted;
                functional.value(self, [q, u, b], &fixed).eps
            };
            (0..at[group].len()).map(partial).collect()
        })
    }

    /// Directional derivative of [`Oracle::gradient`]; the arguments that the gradient holds fixed vary too.
    pub fn gradient_along(
        &self,
        functional: &impl Functional,
        at: [&[f64]; 3],
        fixed: &[f64],
        direction: Along,
    ) -> [Vec<f64>; 3] {
        let moved: [Vec<Dual<f64>>; 3] = std::array::from_fn(|group| along(at[group], direction.at[group]));
        let [q, u, b] = &moved;
        let gradient = self.gradient(functional, [q, u, b], &along(fixed, direction.fixed));
        gradient.map(|part| rates(&part))
    }
}
