//! Second-order theory: the quadratic dependence of frequencies, outputs and critical values on tolerances, and the
//! moments of such a quadratic model.
//!
//! # Second derivatives differentiate the adjoint
//!
//! The gradient of a mode or an output is one reverse pass. Its derivative along the motion of equilibrium, shapes and
//! eigenvalue with one variable is one forward pass over it, with its kernels in dual numbers
//! (`second_order/adjoint.rs`). A Hessian costs as many of these as there are variables and comes out symmetric by
//! itself, so its asymmetry measures rounding and is reported as a check. A crossing has the second derivatives of its
//! mode. Where `Khat` is singular this fails, and a critical value is differentiated along what remains: the curve of
//! limit points, or the branch that a pitchfork leaves, on which `w^T Khat v` changes sign
//! (`second_order/critical.rs`). A transcritical point would need third derivatives of the residual, so it is sampled
//! instead.

mod adjoint;
mod answers;
mod critical;
mod curvature;
mod derivatives;
mod event;
mod moments;
mod nonlinearity;
mod output;
mod quadratic;
mod sampled;
mod spread;
mod standard;

pub(crate) use adjoint::Adjoint;
pub(crate) use answers::{Pair, names, pairs};
pub use critical::critical_curvature;
pub(crate) use curvature::joined;
pub use curvature::{ModeCurvature, mode_curvature};
pub use derivatives::SecondDerivatives;
pub(crate) use derivatives::symmetric;
pub use event::{EventCurvature, crossing_curvature};
pub use nonlinearity::Nonlinearity;
pub use output::{OutputCurvature, output_curvature};
pub use quadratic::{ModelMoments, Quadratic};
#[doc(hidden)]
pub use spread::second_order_watched;
pub use spread::{ModeSecondOrder, SecondOrder, SecondOrderSpread, second_order};
