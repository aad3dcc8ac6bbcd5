//! Neighbouring values of an input, solved side by side.

use super::algebra::LARGEST;
use crate::algebra::{Matrix, Vector};
use crate::constraints::Structure;
use crate::kernels::{BatchPoint, Linear, Sizes};
use crate::scalar::Batch;
use crate::{DampingKind, Description};

/// Least pivot of a matrix that is clearly positive definite, relative to its diagonal element.
pub(crate) const POSITIVE: f64 = 1e-10;

/// The last three values of the input and the states there, the latest first.
pub(crate) type Past = [(f64, Vector); 3];

/// Equilibria, undamped modes and their total derivatives at [`WIDTH`](crate::scalar::WIDTH) values of an input.
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

pub(super) fn sizes(description: &Description) -> Sizes {
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

    pub(super) fn point(&self) -> BatchPoint<'_> {
        BatchPoint {
            q: &self.coordinates,
            u: &self.inputs,
            b: &self.design,
        }
    }
}
