//! Vectors of the processor, one state in each lane; the kernels on them are [`BatchKernels`](crate::kernels::BatchKernels).

mod batch;
mod instructions;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use batch::{Batch, WIDTH};
pub use instructions::Instructions;

pub use instructions::Task;
pub use vector::Lanes;
#[cfg(all(target_arch = "x86_64", any(feature = "std", feature = "libm")))]
pub(crate) use x86::{compact, sines_and_cosines};
