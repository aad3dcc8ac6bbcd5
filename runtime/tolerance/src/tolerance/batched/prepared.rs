//! Dispatches samples to vector code for their number of unknowns.

use super::samples::SampleBatch;
use super::taylor_model::TaylorModel;
use crate::algebra::Matrix;
use crate::constraints::Structure;
use crate::kernels::BatchKernels;
use crate::modes::Family;
use crate::scalar::Instructions;
use crate::tolerance::Tolerances;
use crate::{DampingKind, Description, Equilibrium, Modes};

/// Maximum number of unknowns for which samples are solved side by side.
const MOST: usize = 16;
/// The kernels that samples need.
const KERNELS: [&str; 2] = ["residual_and_stiffness", "linear"];

/// The nominal state in the form that samples need, with matrices no larger than necessary.
pub(in crate::tolerance) enum Prepared<'a> {
    Four(Box<TaylorModel<'a, 4>>),
    Eight(Box<TaylorModel<'a, 8>>),
    Sixteen(Box<TaylorModel<'a, MOST>>),
}

impl<'a> Prepared<'a> {
    /// `None` if the mechanism is not of a kind that is solved in vectors, the nominal state is not clearly stable with
    /// all of its modes, or nothing varies.
    pub(in crate::tolerance) fn new(
        kernels: &'a dyn BatchKernels,
        (nominal, modes): (&'a Equilibrium, &Modes),
        tolerances: &'a Tolerances,
    ) -> Option<Self> {
        if !possible(&nominal.description, modes.family) || !nominal.far_from_least_pose() {
            return None;
        }
        let state = (nominal, modes);
        match nominal.coordinates.len() {
            0..=4 => {
                let model = TaylorModel::new(kernels, state, tolerances)?;
                Some(Self::Four(Box::new(model)))
            }
            5..=8 => {
                let model = TaylorModel::new(kernels, state, tolerances)?;
                Some(Self::Eight(Box::new(model)))
            }
            _ => {
                let model = TaylorModel::new(kernels, state, tolerances)?;
                Some(Self::Sixteen(Box::new(model)))
            }
        }
    }

    /// Whether an equilibrium with this stiffness continues the nominal one: each is in the basin of the other. Where this
    /// is not clear, false.
    pub(in crate::tolerance) fn is_continued_by(&self, q: &[f64], stiffness: &Matrix) -> bool {
        match self {
            Self::Four(model) => model.is_continued_by(q, stiffness),
            Self::Eight(model) => model.is_continued_by(q, stiffness),
            Self::Sixteen(model) => model.is_continued_by(q, stiffness),
        }
    }

    /// Solves the members of several batches from their random bits.
    pub(in crate::tolerance) fn solve(&self, instructions: Instructions, batches: &mut [SampleBatch<'_>]) {
        match self {
            Self::Four(model) => model.solve(instructions, batches),
            Self::Eight(model) => model.solve(instructions, batches),
            Self::Sixteen(model) => model.solve(instructions, batches),
        }
    }
}

/// Whether samples of a mechanism may be solved in vectors for modes of this family: few unknowns, no constraints
/// except on positions, and either undamped modes of a potential or general modes with some damping.
pub fn possible(description: &Description, family: Family) -> bool {
    let undamped = description.damping == DampingKind::Zero;
    (1..=MOST).contains(&description.coordinates.len())
        && KERNELS.iter().all(|name| description.kernel(name).is_some())
        && Structure::of(description).holonomic()
        && match family {
            Family::Undamped => undamped && description.symmetric_stiffness,
            Family::General => !undamped,
        }
}
