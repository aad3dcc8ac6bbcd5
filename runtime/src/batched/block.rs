//! Neighbouring values of an input, solved side by side.

use super::algebra::LARGEST;
use super::continuity::Continuity;
use super::newton::newton;
use super::slopes::{Slopes, slopes};
use super::state::{Scratch, state};
use crate::algebra::{Matrix, Vector};
use crate::constraints::Structure;
use crate::kernels::{BatchKernels, BatchPoint, Linear, Sizes};
use crate::scalar::{Batch, Instructions, WIDTH};
use crate::{DampingKind, Description, Input};

/// Least pivot of a matrix that is clearly positive definite, relative to its diagonal element.
pub(crate) const POSITIVE: f64 = 1e-10;

/// The last three values of the input and the states there, the latest first.
pub(crate) type Past = [(f64, Vector); 3];

/// Equilibria, undamped modes and their total derivatives at [`WIDTH`] values of an input.
pub(crate) struct Block {
    pub(crate) values: Batch,
    pub(super) inputs: Vector<Batch>,
    pub(super) design: Vector<Batch>,
    pub(super) coordinates: Vector<Batch>,
    pub(super) iterations: Batch,
    pub(super) residual: Vector<Batch>,
    pub(super) relative_residual: Batch,
    pub(super) linear: Linear<Batch>,
    pub(super) lambda: Vector<Batch>,
    /// By mode.
    pub(super) shapes: Matrix<Batch>,
    pub(super) mode_residuals: Vector<Batch>,
    pub(super) mode_errors: Vector<Batch>,
    /// `dlambda` by mode.
    pub(super) by_input: Matrix<Batch>,
    pub(super) by_design: Matrix<Batch>,
    /// One where a lane has passed every check.
    pub(super) flags: Batch,
}

/// What is written on the way to a block, and over again.
pub(crate) struct Workspace {
    scratch: Scratch,
    /// For derivatives of the modes, where they are wanted.
    slopes: Option<Slopes>,
}

impl Workspace {
    /// For blocks of a mechanism.
    pub(crate) fn new(description: &Description, with_slopes: bool) -> Self {
        let sizes = sizes(description);
        Self {
            scratch: Scratch::new(sizes.coordinates),
            slopes: with_slopes.then(|| Slopes::new(description, sizes)),
        }
    }
}

fn sizes(description: &Description) -> Sizes {
    Sizes {
        coordinates: description.coordinates.len(),
        inputs: description.inputs.len(),
        design: description.design.len(),
        outputs: description.outputs.len(),
    }
}

/// Whether the mechanism's kind allows it: generated code, undamped modes, no constraints, few coordinates.
pub(crate) fn possible(description: &Description, kernels: &[&str]) -> bool {
    let n = description.coordinates.len();
    (1..=LARGEST).contains(&n)
        && Structure::of(description).open()
        && matches!(description.damping, DampingKind::Zero)
        && description.symmetric_stiffness
        && kernels
            .iter()
            .all(|name| description.kernel(name).is_some())
}

/// The kernels that a block needs.
pub(crate) const KERNELS: [&str; 5] = [
    "residual_and_stiffness",
    "residual_parts",
    "linear",
    "mode_gradient",
    "residual_gradient",
];

impl Block {
    /// One for a design and inputs of which one will vary.
    pub(crate) fn new(description: &Description, inputs: &[f64], design: &[f64]) -> Self {
        let sizes = sizes(description);
        let n = sizes.coordinates;
        let zero = Batch::default();
        Self {
            values: zero,
            inputs: inputs.iter().copied().map(Batch::all).collect(),
            design: design.iter().copied().map(Batch::all).collect(),
            coordinates: Vector::zeros(n),
            iterations: zero,
            residual: Vector::zeros(n),
            relative_residual: zero,
            linear: Linear::zeros(n),
            lambda: Vector::zeros(n),
            shapes: Matrix::zeros(n, n),
            mode_residuals: Vector::zeros(n),
            mode_errors: Vector::zeros(n),
            by_input: Matrix::zeros(n, sizes.inputs),
            by_design: Matrix::zeros(n, sizes.design),
            flags: zero,
        }
    }

    /// Solves the first of `values`, as many as there is room for, from where the way leads. `shapes` are the modes of the last
    /// state, one in each row. Returns how many of the states in a row passed every check; if wanted, their modes have
    /// derivatives.
    pub(crate) fn solve(
        &mut self,
        workspace: &mut Workspace,
        (kernels, instructions): (&dyn BatchKernels, Instructions),
        (input, values): (Input, &[f64]),
        past: &Past,
        shapes: &Matrix,
    ) -> usize {
        let number = values.len().min(WIDTH);
        let Some(&last) = values[..number].last() else {
            return 0;
        };
        // Lanes without a value of their own repeat the last.
        self.values = Batch::from_fn(|k| if k < number { values[k] } else { last });
        self.inputs[input.index()] = self.values;
        self.predict(past);
        let Workspace {
            scratch,
            slopes: derivatives,
        } = workspace;
        newton(kernels, instructions, self, scratch);
        instructions.run(Continuity { past, block: self });
        if self.flags.0[0] == 1.0 {
            state(kernels, instructions, self, scratch, shapes);
            if let Some(derivatives) = derivatives {
                slopes(kernels, instructions, self, derivatives);
            }
        }
        let passed = self.flags.0[..number]
            .iter()
            .take_while(|flag| **flag == 1.0);
        passed.count()
    }

    pub(super) fn point(&self) -> BatchPoint<'_> {
        BatchPoint {
            q: &self.coordinates,
            u: &self.inputs,
            b: &self.design,
        }
    }

    /// The parabola through the last states.
    fn predict(&mut self, past: &Past) {
        let [(u0, q0), (u1, q1), (u2, q2)] = past;
        let (step, before, both) = (1.0 / (u0 - u1), 1.0 / (u1 - u2), 1.0 / (u0 - u2));
        for (i, place) in self.coordinates.iter_mut().enumerate() {
            let slope = (q0[i] - q1[i]) * step;
            let bend = (slope - (q1[i] - q2[i]) * before) * both;
            for (q, u) in place.0.iter_mut().zip(&self.values.0) {
                *q = q0[i] + (u - u0) * (slope + (u - u1) * bend);
            }
        }
    }
}
