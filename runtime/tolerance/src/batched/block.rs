//! Neighbouring values of an input, solved side by side.

use super::algebra::LARGEST;
use super::room::BatchArena;
use crate::constraints::Structure;
use crate::kernels::{BatchLinear, BatchPoint, Sizes};
use crate::scalar::Batch;
use crate::{DampingKind, Description};

/// Smallest pivot of a clearly positive definite matrix, relative to its diagonal element.
pub const POSITIVE: f64 = 1e-10;

/// Equilibria, undamped modes and their total derivatives at [`WIDTH`](crate::scalar::WIDTH) values of an input.
/// Matrices are stored row by row.
#[doc(hidden)]
pub struct Block<'a> {
    pub values: Batch,
    pub(super) inputs: &'a mut [Batch],
    pub(super) design: &'a mut [Batch],
    pub(super) coordinates: &'a mut [Batch],
    pub(super) iterations: Batch,
    pub(super) residual: &'a mut [Batch],
    pub(super) relative_residual: Batch,
    /// Without damping.
    pub(super) linear: BatchLinear<'a>,
    pub(super) lambda: &'a mut [Batch],
    pub(super) rates: &'a mut [Batch],
    /// Mode by mode.
    pub(super) shapes: &'a mut [Batch],
    pub(super) mode_residuals: &'a mut [Batch],
    /// Of `s`.
    pub(super) mode_errors: &'a mut [Batch],
    /// `dlambda`, mode by mode.
    pub(super) by_input: &'a mut [Batch],
    pub(super) by_design: &'a mut [Batch],
    /// One for lanes that have passed every check.
    pub(super) flags: Batch,
}

/// Whether the kind of mechanism allows it: generated code, undamped modes of a potential, no constraints, few
/// coordinates.
pub fn possible(description: &Description, kernels: &[&str]) -> bool {
    let n = description.coordinates.len();
    (1..=LARGEST).contains(&n)
        && Structure::of(description).open()
        && matches!(description.damping, DampingKind::Zero)
        && description.symmetric_stiffness
        && kernels.iter().all(|name| description.kernel(name).is_some())
}

/// The kernels that a block needs.
pub const KERNELS: [&str; 5] =
    ["residual_and_stiffness", "residual_parts", "linear", "mode_gradient", "residual_gradient"];

impl<'a> Block<'a> {
    /// Number of batches that a block takes.
    pub(super) fn size(sizes: Sizes) -> usize {
        let (n, variables) = (sizes.coordinates, sizes.inputs + sizes.design);
        variables + 6 * n + 3 * n * n + n * variables
    }

    /// A block for a given design and inputs, one of which will vary.
    pub(super) fn new(room: &mut BatchArena<'a>, inputs: &[f64], design: &[f64], n: usize) -> Self {
        Self {
            values: Batch::default(),
            inputs: room.constants(inputs),
            design: room.constants(design),
            coordinates: room.take(n),
            iterations: Batch::default(),
            residual: room.take(n),
            relative_residual: Batch::default(),
            linear: BatchLinear { mass: room.take(n * n), damping: &mut [], stiffness: room.take(n * n) },
            lambda: room.take(n),
            rates: room.take(n),
            shapes: room.take(n * n),
            mode_residuals: room.take(n),
            mode_errors: room.take(n),
            by_input: room.take(n * inputs.len()),
            by_design: room.take(n * design.len()),
            flags: Batch::default(),
        }
    }

    pub(super) fn point(&self) -> BatchPoint<'_> {
        BatchPoint { q: self.coordinates, u: self.inputs, b: self.design }
    }
}
