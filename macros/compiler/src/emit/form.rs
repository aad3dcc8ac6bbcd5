//! The forms in which methods return their results.

use crate::mechanics::KernelName;

/// How a method returns its results.
#[derive(Clone, Copy)]
pub(super) enum Form {
    /// One array.
    Single,
    /// A tuple of arrays.
    Tuple,
    /// A struct of the runtime with one field per array, generic over the types of the given number of leading arrays.
    Record(&'static str, usize),
    /// `LinearPartials`: three lists of three matrices.
    Partials,
}

/// The form of a kernel of the contract; `None` for requirements, poses and held values, whose methods are generated
/// separately.
pub(super) fn form(kernel: KernelName) -> Option<Form> {
    Some(match kernel {
        KernelName::Residual
        | KernelName::MotionResidual
        | KernelName::Outputs
        | KernelName::Whirl
        | KernelName::Picture => Form::Single,
        KernelName::Motion
        | KernelName::ResidualAndStiffness
        | KernelName::ResidualPartials
        | KernelName::OutputPartials
        | KernelName::OutputMotion => Form::Tuple,
        KernelName::Forcing => Form::Record("Forcing", 3),
        KernelName::ResidualParts => Form::Record("RestParts", 1),
        KernelName::Linear | KernelName::MotionLinear => Form::Record("Linear", 1),
        KernelName::LinearPartials => Form::Partials,
        KernelName::ModeGradient
        | KernelName::PencilGradient
        | KernelName::ResidualGradient
        | KernelName::ForcedGradient => Form::Record("Gradient", 3),
        KernelName::Violation | KernelName::PoseMargin | KernelName::HeldValues | KernelName::Spans => return None,
    })
}
