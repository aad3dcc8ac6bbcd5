//! Costs of the kernels from which gradients can be computed.

use super::Kernel;
use crate::Description;
use crate::mechanism::KernelInfo;

/// Cost of an elementary function, in additions and multiplications.
const FUNCTION: usize = 40;

/// Costs, in additions and multiplications, of the kernels from which derivatives of modes can be computed; `None` for
/// a kernel that was not generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Costs {
    /// Cost of [`Kernels::linear_partials_into`](super::Kernels::linear_partials_into).
    pub linear_partials: Option<usize>,
    /// Cost of [`Kernels::residual_partials_into`](super::Kernels::residual_partials_into).
    pub residual_partials: Option<usize>,
    /// Cost of [`Kernels::mode_gradient_into`](super::Kernels::mode_gradient_into).
    pub mode_gradient: Option<usize>,
    /// Cost of [`Kernels::pencil_gradient_into`](super::Kernels::pencil_gradient_into).
    pub pencil_gradient: Option<usize>,
    /// Cost of [`Kernels::residual_gradient_into`](super::Kernels::residual_gradient_into).
    pub residual_gradient: Option<usize>,
}

impl Costs {
    /// Costs for a mechanism with this description.
    #[must_use]
    pub fn of(description: &Description) -> Self {
        let of = |name: &str| cost(description.kernel(name));
        Self {
            linear_partials: of("linear_partials"),
            residual_partials: of(Kernel::ResidualPartials.name()),
            mode_gradient: of(Kernel::ModeGradient.name()),
            pencil_gradient: of(Kernel::PencilGradient.name()),
            residual_gradient: of(Kernel::ResidualGradient.name()),
        }
    }

    /// Like [`Self::of`] for a constant description: looked up at compile time.
    pub(super) const fn of_constant(description: &Description) -> Self {
        Self {
            linear_partials: cost(description.static_kernel("linear_partials")),
            residual_partials: cost(description.static_kernel(Kernel::ResidualPartials.name())),
            mode_gradient: cost(description.static_kernel(Kernel::ModeGradient.name())),
            pencil_gradient: cost(description.static_kernel(Kernel::PencilGradient.name())),
            residual_gradient: cost(description.static_kernel(Kernel::ResidualGradient.name())),
        }
    }
}

const fn cost(kernel: Option<&KernelInfo>) -> Option<usize> {
    match kernel {
        Some(kernel) => Some(kernel.operations + FUNCTION * kernel.functions),
        None => None,
    }
}
