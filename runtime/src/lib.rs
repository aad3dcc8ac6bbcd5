//! Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.
//!
//! Declare a mechanism with [`mechanism!`]; ask questions through `Study`, or call the functions of the modules
//! directly: each takes the mechanism, lists of numbers and the results of the step before. Numbers of equations are those of
//! S. M. Eom, D. H. Choi and H. H. Yoo, "Tolerance Analysis for Natural Frequencies of Multi-body Systems in Dynamic
//! Equilibrium State", completed where the paper is incomplete.
//!
//! ```
//! # #[cfg(feature = "std")]
//! # fn main() -> Result<(), eigentol::Error> {
//! use eigentol::{Study, mechanism};
//!
//! mechanism! {
//!     /// A uniform bar hinged on a shaft that spins at a constant rate.
//!     pub mechanism RotatingPendulum {
//!         input  omega: rad/s;
//!         design m = 3.0 kg;
//!         design l = 1.0 m +/- 3%;
//!         gravity 9.81 m/s^2 along -z;
//!         body shaft: massless;
//!         body bar: rod(mass: m, length: l, along: -z);
//!         joint spin:  revolute(z) from ground to shaft, driven at omega;
//!         joint theta: revolute(y) from shaft to bar;
//!     }
//! }
//!
//! let study = Study::new(RotatingPendulum)
//!     .input(RotatingPendulum::omega, 5.0)
//!     .start(RotatingPendulum::theta, 1.0);
//! let (speed, natural) = (5.0_f64, 3.0 * 9.81 / 2.0);
//! let frequency = study.modes()?.frequencies()[0];
//! let closed_form = (speed.powi(2) - (natural / speed).powi(2)).sqrt();
//! assert!((frequency.expect("the bar swings") - closed_form).abs() < 1e-12);
//! println!("{}", study.first_order()?);
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "std"))]
//! # fn main() {}
//! ```
//!
//! What a `Study` answers, and the function behind it; several questions about one operating point share its equilibrium and modes
//! through `Study::solve`:
//!
//! | question | method | function |
//! | --- | --- | --- |
//! | how does it go together, if loops close? | `assembly` | `equilibrium::assemble` |
//! | where does it stay, and what moves that? | `equilibrium`, `equilibria`, `equilibrium_shift` | `equilibrium::equilibrium`, ... |
//! | which branches are there, where do they fold and fork? | `branches` | `branches::branches` |
//! | how does it vibrate, is it stable? | `modes`, `whirls` | `modes::modes`, `modes::whirls` |
//! | what moves frequencies, damping, shapes, outputs? | `sensitivities`, `shape_sensitivity`, `outputs` | `sensitivity::sensitivities`, ... |
//! | ... to second order? | `mode_curvature` | `second_order::mode_curvature` |
//! | how do equal frequencies split? | `directional_derivatives` | `clusters::directional_derivatives` |
//! | how much do tolerances spread them? | `first_order`, `second_order`, `output_tolerances` | `tolerance::first_order`, ... |
//! | which of these sigmas can be believed, which modes mix? | `summary`, `clusters` | `summary::summary`, `clusters::clusters` |
//! | and without linearisation? | `monte_carlo` | `tolerance::monte_carlo` |
//! | how probable is a forbidden band, or instability? | `margin`, `margin_of` | `second_order::mode_margin` |
//! | what happens along an input? | `sweep`, `sensitivity_sweep`, `first_order_sweep`, `campbell` | `sweep::sweep`, `sweep::sensitivity_sweep`, `campbell::campbell` |
//! | where is it critical, resonant, about to flutter? | `critical_state`, `crossings`, `flutter_onsets`, each with `..._tolerance(s)` | `sweep::critical_state`, ... |
#![cfg_attr(not(feature = "std"), no_std)]

// Generated code in unit tests names the crate from outside.
#[cfg(test)]
extern crate self as eigentol;

mod mechanism;
pub mod scalar;

#[cfg(feature = "std")]
mod algebra;
#[cfg(feature = "std")]
mod arguments;
#[cfg(feature = "std")]
mod batched;
#[cfg(feature = "std")]
pub mod branches;
#[cfg(feature = "std")]
pub mod campbell;
#[cfg(feature = "std")]
pub mod clusters;
#[cfg(feature = "std")]
mod constraints;
#[cfg(feature = "std")]
mod eigenproblem;
#[cfg(feature = "std")]
pub mod equilibrium;
#[cfg(feature = "std")]
mod error;
#[cfg(feature = "std")]
pub mod kernels;
#[cfg(feature = "std")]
pub mod modes;
#[cfg(feature = "std")]
pub mod motion;
#[cfg(feature = "std")]
pub mod report;
#[cfg(feature = "std")]
mod rounding;
#[cfg(feature = "std")]
pub mod second_order;
#[cfg(feature = "std")]
pub mod sensitivity;
#[cfg(feature = "std")]
pub mod shapes;
#[cfg(feature = "std")]
mod state;
#[cfg(feature = "std")]
mod study;
#[cfg(feature = "std")]
pub mod summary;
#[cfg(feature = "std")]
pub mod sweep;
#[cfg(feature = "std")]
pub mod tolerance;

pub use eigentol_macros::mechanism;
pub use mechanism::{Any, Coordinate, DesignVariable, Input, Output};
pub use mechanism::{
    Array, CoordinateInfo, DampingKind, Description, DesignInfo, Gradient, InputInfo, KernelInfo,
    Linear, LinearPartials, List, Mechanism, OutputInfo, PoseMargin, RestParts, Role, Shared, Text,
    Unit, Violation,
};
pub use mechanism::{GradientOf, PartialsOf, ResidualPartialsOf, Square};
pub use scalar::{Dual, Real};

#[cfg(feature = "std")]
pub use algebra::{Matrix, Vector};
#[cfg(feature = "std")]
pub use campbell::Campbell;
#[cfg(feature = "std")]
pub use equilibrium::Policy;
#[cfg(feature = "std")]
pub use error::Error;
#[cfg(feature = "std")]
pub use kernels::Kernels;
#[cfg(feature = "std")]
pub use modes::{Behaviour, Family, Mode, Modes};
/// A complex number.
#[cfg(feature = "std")]
pub use num_complex::Complex64 as Complex;
#[cfg(feature = "std")]
pub use sensitivity::{Quantity, Sensitivities};
#[cfg(feature = "std")]
pub use state::{Equilibrium, Stability};
#[cfg(feature = "std")]
pub use study::{Solved, Study};
#[cfg(feature = "std")]
pub use tolerance::{FirstOrder, MonteCarlo, Tolerances};

/// The example of the README, compiled and run.
#[cfg(all(doctest, feature = "std"))]
#[doc = include_str!("../../README.md")]
struct Readme;
