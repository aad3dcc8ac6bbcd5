//! Neighbouring values of an input, solved side by side.

use super::continuity::Continuity;
use super::newton::Newton;
use super::slopes::Slopes;
use super::state::State;
use crate::constraints::Structure;
use crate::lanes::{Batch, Instructions, WIDTH, generated};
use crate::{DampingKind, Input, Linear, Mechanism};

/// Largest mechanism whose values are solved side by side.
const LARGEST: usize = 8;
/// Least pivot of a matrix that is clearly positive definite, relative to its diagonal element.
pub(crate) const POSITIVE: f64 = 1e-10;

/// The last three values of the input and the states there, the latest first.
pub(crate) type Past<const N: usize> = [(f64, [f64; N]); 3];

/// Equilibria, undamped modes and their total derivatives at [`WIDTH`] values of an input.
pub(crate) struct Block<const N: usize, const U: usize, const P: usize> {
    pub(crate) values: Batch,
    pub(super) inputs: [Batch; U],
    pub(super) design: [Batch; P],
    pub(super) coordinates: [Batch; N],
    pub(super) iterations: Batch,
    pub(super) residual: [Batch; N],
    pub(super) relative_residual: Batch,
    pub(super) linear: Linear<Batch, N>,
    pub(super) lambda: [Batch; N],
    /// By mode.
    pub(super) shapes: [[Batch; N]; N],
    pub(super) mode_residuals: [Batch; N],
    pub(super) mode_errors: [Batch; N],
    /// `dlambda` by mode.
    pub(super) by_input: [[Batch; U]; N],
    pub(super) by_design: [[Batch; P]; N],
    /// One where a lane has passed every check.
    pub(super) flags: Batch,
}

impl<const N: usize, const U: usize, const P: usize> Block<N, U, P> {
    /// Whether the mechanism's kind allows it: generated code, undamped modes, no constraints, few coordinates.
    pub(crate) const fn possible<M, const O: usize>() -> bool
    where
        M: Mechanism<N, U, P, O>,
    {
        N > 0
            && N <= LARGEST
            && Structure::of(&M::DESCRIPTION).open()
            && matches!(M::DESCRIPTION.damping, DampingKind::Zero)
            && M::DESCRIPTION.symmetric_stiffness
            && generated(&M::DESCRIPTION, "residual_and_stiffness")
            && generated(&M::DESCRIPTION, "residual_parts")
            && generated(&M::DESCRIPTION, "linear")
            && generated(&M::DESCRIPTION, "mode_gradient")
            && generated(&M::DESCRIPTION, "residual_gradient")
    }

    /// One for a design and inputs of which one will vary.
    pub(crate) fn new(inputs: &[f64; U], design: &[f64; P]) -> Box<Self> {
        let zero = Batch::default();
        Box::new(Self {
            values: zero,
            inputs: inputs.map(Batch::all),
            design: design.map(Batch::all),
            coordinates: [zero; N],
            iterations: zero,
            residual: [zero; N],
            relative_residual: zero,
            linear: Linear::default(),
            lambda: [zero; N],
            shapes: [[zero; N]; N],
            mode_residuals: [zero; N],
            mode_errors: [zero; N],
            by_input: [[zero; U]; N],
            by_design: [[zero; P]; N],
            flags: zero,
        })
    }

    /// Solves the first of `values`, as many as there is room for, from where the way leads. `shapes` are the modes of the last state,
    /// one in each row. Returns how many of the states in a row passed every check; with `SLOPES`, their modes have derivatives.
    pub(crate) fn solve<const SLOPES: bool, M, const O: usize>(
        &mut self,
        mechanism: &M,
        instructions: Instructions,
        (input, values): (Input, &[f64]),
        past: &Past<N>,
        shapes: &[[f64; N]; N],
    ) -> usize
    where
        M: Mechanism<N, U, P, O>,
    {
        let number = values.len().min(WIDTH);
        let Some(&last) = values[..number].last() else {
            return 0;
        };
        // Lanes without a value of their own repeat the last.
        self.values = Batch::from_fn(|k| if k < number { values[k] } else { last });
        self.inputs[input.0] = self.values;
        self.predict(past);
        instructions.run(Newton::<M, N, U, P, O> {
            mechanism,
            block: self,
        });
        instructions.run(Continuity { past, block: self });
        if self.flags.0[0] != 1.0 {
            return 0;
        }
        instructions.run(State::<M, N, U, P, O> {
            mechanism,
            shapes,
            block: self,
        });
        if const { SLOPES } {
            instructions.run(Slopes::<M, N, U, P, O> {
                mechanism,
                block: self,
            });
        }
        let passed = self.flags.0[..number]
            .iter()
            .take_while(|flag| **flag == 1.0);
        passed.count()
    }

    /// The parabola through the last states.
    fn predict(&mut self, past: &Past<N>) {
        let [(u0, q0), (u1, q1), (u2, q2)] = past;
        let (step, before, both) = (1.0 / (u0 - u1), 1.0 / (u1 - u2), 1.0 / (u0 - u2));
        for i in 0..N {
            let slope = (q0[i] - q1[i]) * step;
            let bend = (slope - (q1[i] - q2[i]) * before) * both;
            let place = &mut self.coordinates[i].0;
            for (q, u) in place.iter_mut().zip(&self.values.0) {
                *q = q0[i] + (u - u0) * (slope + (u - u1) * bend);
            }
        }
    }
}
