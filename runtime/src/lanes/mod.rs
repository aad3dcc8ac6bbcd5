//! Generated kernels at several states at once, in the vector instructions of the processor.
//!
//! A [`Batch`] holds one number of each of [`WIDTH`] states, so that `[Batch; N]` are `WIDTH` sets of coordinates. Every
//! number that comes out is, bit for bit, what the scalar kernel gives for that state alone, whatever the processor:
//! the operations are the same, one rounding each, and none are fused.
//!
//! ```
//! # #[cfg(feature = "std")]
//! # {
//! use eigentol::lanes::{Batch, Instructions, linear};
//! use eigentol::{Linear, Mechanism, mechanism};
//!
//! mechanism! {
//!     mechanism Pendulum {
//!         design l = 1.0 m;
//!         gravity 9.81 m/s^2 along -z;
//!         body bar: rod(mass: 3.0 kg, length: l, along: -z);
//!         joint theta: revolute(y) from ground to bar;
//!     }
//! }
//!
//! let theta = [Batch::from_fn(|k| 0.1 * k as f64)];
//! let length = [Batch::all(1.5)];
//! let mut matrices = Linear::<Batch, 1>::default();
//! linear(Instructions::best(), &Pendulum, &theta, &[], &length, &mut matrices);
//! let alone = Pendulum.linear(&[0.3], &[], &[1.5]);
//! assert_eq!(matrices.stiffness[0][0].0[3], alone.stiffness[0][0]);
//! # }
//! ```

mod batch;
mod instructions;
mod kernels;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use batch::{Batch, WIDTH};
pub use instructions::Instructions;
pub use kernels::{
    linear, linear_partials, mode_gradient, residual_and_stiffness, residual_gradient,
    residual_partials,
};

#[cfg(feature = "std")]
pub(crate) use batch::{Store, load, load_matrix};
#[cfg(feature = "std")]
pub(crate) use instructions::Task;
#[cfg(feature = "std")]
pub(crate) use kernels::generated;
pub(crate) use vector::Vector;
#[cfg(all(target_arch = "x86_64", any(feature = "std", feature = "libm")))]
pub(crate) use x86::{compact, sines_and_cosines};
