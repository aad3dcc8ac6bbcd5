//! The kernels that check a state: physical requirements on the design, and the distance of joints and beams from
//! singular poses.

use crate::algebra::{Array, ExprId, Function};
use crate::mechanics::functions::{Pose, Requirement};
use crate::mechanics::kernel_name::KernelName;
use crate::mechanics::setup::Symbols;

use super::parameters::parameter;

/// The function whose results must be positive.
pub(crate) fn violation(requirements: &[Requirement], symbols: &Symbols) -> Function {
    let values: Vec<ExprId> = requirements.iter().map(|r| r.value).collect();
    Function {
        name: KernelName::Violation.name(),
        parameters: vec![parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "requirements", shape: vec![values.len()], values }],
    }
}

/// The function whose results measure how far joints and beams are from their singular poses.
pub(crate) fn pose_margin(poses: &[Pose], symbols: &Symbols) -> Function {
    let values: Vec<ExprId> = poses.iter().map(|pose| pose.margin).collect();
    Function {
        name: KernelName::PoseMargin.name(),
        parameters: vec![parameter("q", &symbols.q), parameter("u", &symbols.u), parameter("b", &symbols.b)],
        results: vec![Array { name: "margins", shape: vec![values.len()], values }],
    }
}
