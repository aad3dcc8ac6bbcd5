//! The kernels of generated code over vectors of `f64`: the contract of the runtime's `Mechanism`, kernel by kernel.
//!
//! Matrices are flattened by rows. Where a kernel returns derivatives of matrices, the index of differentiation is the
//! outermost.

use crate::matrices::{
    Along, Linear, LinearPartials, ModeFunctional, Oracle, PencilFunctional, ResidualFunctional, State,
};

/// A point of evaluation `q`, `u`, `b`, or a direction `dq`, `du`, `db` there.
pub type At<'a> = [&'a [f64]; 3];

/// Partial derivatives of a scalar by coordinates, inputs and design variables.
pub type Gradient = [Vec<f64>; 3];

/// The vectors `left`, `acceleration`, `velocity`, `position` of the bilinear form of the linearised matrices, or a
/// direction in them.
pub type Pencil<'a> = [&'a [f64]; 4];

/// The kernels of one mechanism.
pub trait Kernels {
    /// `g(0, 0, q; u, b)`.
    fn residual(&self, at: At) -> Vec<f64>;

    /// `g` at rest, split into inertia and applied forces: `g = inertia - applied`.
    fn residual_parts(&self, at: At) -> [Vec<f64>; 2];

    /// `g(qddot, qdot, q; u, b)`.
    fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], at: At) -> Vec<f64>;

    /// `M*` and `Q*`.
    fn motion(&self, velocity: &[f64], at: At) -> [Vec<f64>; 2];

    /// `g` at rest and `Khat`.
    fn residual_and_stiffness(&self, at: At) -> [Vec<f64>; 2];

    /// `Mhat`, `Chat`, `Khat`.
    fn linear(&self, at: At) -> Linear<f64>;

    /// Partial derivatives of `g` at rest: `[n][inputs]` and `[n][design variables]`.
    fn residual_partials(&self, at: At) -> [Vec<f64>; 2];

    /// Partial derivatives of `Mhat`, `Chat`, `Khat`.
    fn linear_partials(&self, at: At) -> LinearPartials;

    /// Directional derivatives of `Mhat`, `Chat`, `Khat`.
    fn linear_along(&self, at: At, along: At) -> Linear<f64>;

    /// Gradient of `phi^T (Khat - lambda Mhat) phi`.
    fn mode_gradient(&self, at: At, phi: &[f64], lambda: f64) -> Gradient;

    /// Gradient of `left^T (Mhat acceleration + Chat velocity + Khat position)`.
    fn pencil_gradient(&self, at: At, pencil: Pencil) -> Gradient;

    /// Gradient of `w^T g` at rest.
    fn residual_gradient(&self, at: At, w: &[f64]) -> Gradient;

    /// The moment of a vibration about the spin axes of the bodies, and its bound.
    fn whirl(&self, at: At, real: &[f64], imaginary: &[f64]) -> Vec<f64>;

    /// Directional derivative of [`Kernels::mode_gradient`].
    fn mode_gradient_along(&self, at: At, mode: (&[f64], f64), along: At, mode_along: (&[f64], f64)) -> Gradient;

    /// Directional derivative of [`Kernels::pencil_gradient`].
    fn pencil_gradient_along(&self, at: At, pencil: Pencil, along: At, pencil_along: Pencil) -> Gradient;

    /// Directional derivative of [`Kernels::residual_gradient`].
    fn residual_gradient_along(&self, at: At, w: &[f64], along: At, dw: &[f64]) -> Gradient;
}

impl Kernels for Oracle<'_> {
    fn residual(&self, [q, u, b]: At) -> Vec<f64> {
        Oracle::residual(self, q, u, b)
    }

    fn residual_parts(&self, [q, u, b]: At) -> [Vec<f64>; 2] {
        let motion = Oracle::motion(self, &State::at_rest(q, u, b));
        [motion.inertia, motion.applied]
    }

    fn motion_residual(&self, acceleration: &[f64], velocity: &[f64], [q, u, b]: At) -> Vec<f64> {
        let rest = State::at_rest(q, u, b);
        let (acceleration, velocity) = (acceleration.to_vec(), velocity.to_vec());
        Oracle::motion_residual(self, &State { acceleration, velocity, ..rest })
    }

    fn motion(&self, velocity: &[f64], [q, u, b]: At) -> [Vec<f64>; 2] {
        let rest = State::at_rest(q, u, b);
        let motion = Oracle::motion(self, &State { velocity: velocity.to_vec(), ..rest });
        [motion.mass.concat(), motion.right_hand_side()]
    }

    fn residual_and_stiffness(&self, at: At) -> [Vec<f64>; 2] {
        [Kernels::residual(self, at), Kernels::linear(self, at).stiffness]
    }

    fn linear(&self, [q, u, b]: At) -> Linear<f64> {
        Oracle::linear(self, q, u, b)
    }

    fn residual_partials(&self, [q, u, b]: At) -> [Vec<f64>; 2] {
        Oracle::residual_partials(self, q, u, b).into()
    }

    fn linear_partials(&self, [q, u, b]: At) -> LinearPartials {
        Oracle::linear_partials(self, q, u, b)
    }

    fn linear_along(&self, at: At, along: At) -> Linear<f64> {
        Oracle::linear_along(self, at, along)
    }

    fn mode_gradient(&self, at: At, phi: &[f64], lambda: f64) -> Gradient {
        self.gradient(&ModeFunctional, at, &[phi, &[lambda]].concat())
    }

    fn pencil_gradient(&self, at: At, pencil: Pencil) -> Gradient {
        self.gradient(&PencilFunctional, at, &pencil.concat())
    }

    fn residual_gradient(&self, at: At, w: &[f64]) -> Gradient {
        self.gradient(&ResidualFunctional, at, w)
    }

    fn whirl(&self, at: At, real: &[f64], imaginary: &[f64]) -> Vec<f64> {
        Oracle::whirl(self, at, real, imaginary).to_vec()
    }

    fn mode_gradient_along(
        &self,
        at: At,
        (phi, lambda): (&[f64], f64),
        along: At,
        (dphi, dlambda): (&[f64], f64),
    ) -> Gradient {
        let fixed = [phi, &[lambda]].concat();
        let direction = Along { at: along, fixed: &[dphi, &[dlambda]].concat() };
        self.gradient_along(&ModeFunctional, at, &fixed, direction)
    }

    fn pencil_gradient_along(&self, at: At, pencil: Pencil, along: At, pencil_along: Pencil) -> Gradient {
        let direction = Along { at: along, fixed: &pencil_along.concat() };
        self.gradient_along(&PencilFunctional, at, &pencil.concat(), direction)
    }

    fn residual_gradient_along(&self, at: At, w: &[f64], along: At, dw: &[f64]) -> Gradient {
        self.gradient_along(&ResidualFunctional, at, w, Along { at: along, fixed: dw })
    }
}
