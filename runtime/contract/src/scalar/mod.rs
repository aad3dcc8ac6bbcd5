//! Number types for kernels: one state, eight states side by side in vectors of the processor, and dual numbers.

#[cfg(any(feature = "std", feature = "libm"))]
mod batch;
mod dual;
#[cfg(any(feature = "std", feature = "libm"))]
mod float;
#[cfg(any(feature = "std", feature = "libm"))]
mod instructions;
#[cfg(any(feature = "std", feature = "libm"))]
mod lanes;
mod real;
mod spline;
#[cfg(any(feature = "std", feature = "libm"))]
mod trigonometry;
#[cfg(all(target_arch = "x86_64", any(feature = "std", feature = "libm")))]
mod x86;

#[cfg(any(feature = "std", feature = "libm"))]
pub use batch::{Batch, WIDTH};
pub use dual::Dual;
#[cfg(any(feature = "std", feature = "libm"))]
pub use instructions::Instructions;
#[cfg(any(feature = "std", feature = "libm"))]
pub use lanes::{Lanes, Task};
pub use real::Real;
#[cfg(any(feature = "std", feature = "libm"))]
#[doc(hidden)]
pub use real::integer_power;
pub use spline::spline;
#[cfg(feature = "std")]
#[doc(hidden)]
pub use trigonometry::sin_cos_of_turns;
