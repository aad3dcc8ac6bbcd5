//! Natural frequencies of mechanisms in steady motion, and how manufacturing tolerances move them.
//!
//! Declare a mechanism with [`mechanism!`]. Then ask questions through a [`Study`], or call the functions of the
//! modules directly: each takes the mechanism, lists of numbers and the results of the preceding step. Equation numbers
//! refer to S. M. Eom, D. H. Choi and H. H. Yoo, "Tolerance Analysis for Natural Frequencies of Multi-body Systems in
//! Dynamic Equilibrium State", completed where the paper is incomplete.
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
//! The table lists the questions that a [`Study`] answers, and the functions behind them. Several questions about one
//! operating point share its equilibrium and modes, which the study keeps.
//!
//! | question | method | function |
//! | --- | --- | --- |
//! | Do its loops close, and at which coordinates? | [`assembly`](Study::assembly) | [`equilibrium::assemble`] |
//! | Where does it stay, and what moves that position? | [`equilibrium`](Study::equilibrium), [`equilibria`](Study::equilibria), [`equilibrium_shift`](Study::equilibrium_shift) | [`equilibrium::equilibrium`], [`equilibrium::find_equilibria`], [`sensitivity::equilibrium_shift`] |
//! | Which branches of equilibria are there, and where do they fold and fork? | [`branches`](Study::branches), [`branches_with`](Study::branches_with) | [`branches::branches`] |
//! | How does it vibrate, is it stable, and which way does it whirl? | [`modes`](Study::modes), [`whirls`](Study::whirls) | [`modes::modes`], [`modes::whirls`] |
//! | What does it look like, at rest, in its modes and in forced vibration? | [`picture`](Study::picture), [`mode_pictures`](Study::mode_pictures), [`vibration_pictures`](Study::vibration_pictures) | [`picture::scene`], [`picture::mode_pictures`], [`picture::vibration_pictures`] |
//! | Do its beams have enough coordinates? | [`convergence`](Study::convergence) | [`convergence::convergence`] |
//! | What changes frequencies, damping, outputs and shapes? | [`sensitivities`](Study::sensitivities), [`outputs`](Study::outputs), [`shape_sensitivity`](Study::shape_sensitivity) | [`sensitivity::sensitivities`], [`sensitivity::output_sensitivities`], [`shapes::shape_sensitivity`] |
//! | ... to second order? | [`mode_curvature`](Study::mode_curvature), [`output_curvature`](Study::output_curvature) | [`second_order::mode_curvature`], [`second_order::output_curvature`] |
//! | How do equal frequencies split? | [`directional_derivatives`](Study::directional_derivatives) | [`clusters::directional_derivatives`] |
//! | How far do tolerances spread them? | [`first_order`](Study::first_order), [`second_order`](Study::second_order), [`output_tolerances`](Study::output_tolerances) | [`tolerance::first_order`], [`second_order::second_order`], [`tolerance::output_tolerances`] |
//! | How much higher does the worst blade of a rotor vibrate? | [`mistuning`](Study::mistuning) | [`mistuning::mistuning`] |
//! | Which of these sigmas can be trusted, and which modes mix? | [`summary`](Study::summary), [`clusters`](Study::clusters) | [`summary::summary`], [`clusters::clusters`] |
//! | And without linearisation? | [`monte_carlo`](Study::monte_carlo) | [`tolerance::monte_carlo`] |
//! | How far do they spread several responses jointly, by any method? | [`propagate`](Study::propagate), [`sample_responses`](Study::sample_responses) | [`propagation::propagate`], [`propagation::sampled`] |
//! | Which variables does the scatter come from? | [`influence`](Study::influence) | [`propagation::influence`] |
//! | How bad can it get within the limits? | [`worst_case`](Study::worst_case) | [`propagation::worst_case`] |
//! | How probable is it that requirements are met, and what changes that? | [`probability`](Study::probability), [`chances`](Study::chances), [`reliability`](Study::reliability) | [`requirement::Requirements`] |
//! | Which tolerances are the cheapest that meet them? | [`allocation`](Study::allocation) | [`allocation::allocate`] |
//! | What happens along an input? | [`sweep`](Study::sweep), [`sensitivity_sweep`](Study::sensitivity_sweep), [`first_order_sweep`](Study::first_order_sweep), [`campbell`](Study::campbell), over a design variable too [`event_map`](Study::event_map) | [`sweep::sweep`], [`sweep::sensitivity_sweep`], [`campbell::campbell`] |
//! | Where is it critical, and how far do tolerances move that point? | [`critical_state`](Study::critical_state), [`critical_tolerance`](Study::critical_tolerance), [`critical_curvature`](Study::critical_curvature), [`events`](Study::events) | [`sweep::critical_state`], [`sweep::critical_tolerance`], [`second_order::critical_curvature`] |
//! | Where does it resonate, and where does it begin to flutter? | [`crossings`](Study::crossings), [`crossing_tolerances`](Study::crossing_tolerances), [`flutter_onsets`](Study::flutter_onsets), [`flutter_onset_tolerances`](Study::flutter_onset_tolerances) | [`sweep::crossings`], [`sweep::flutter_onsets`], [`sweep::crossing_tolerance`] |
//!
//! Values are SI, or in the declared unit: [`InDeclaredUnit`]. Handles such as `RotatingPendulum::omega` are constants
//! of the mechanism's type; if names are known only at run time, [`Study::find_input`] and similar methods look them
//! up. Every result prints as a table with names, units and the operating point it belongs to ([`results`]). Lists of
//! numbers are [`Vector`] and [`Matrix`], which convert to and from nalgebra.
#![cfg_attr(not(feature = "std"), no_std)]

// Generated code in unit tests refers to the crate by its external name.
#[cfg(test)]
extern crate self as eigentol;

#[doc(inline)]
pub use eigentol_contract::scalar;
pub use eigentol_contract::{
    Any, Array, BeamInfo, BodyInfo, Coordinate, CoordinateInfo, CorrelationInfo, DampingKind, Description, DesignInfo,
    DesignVariable, Dual, ElementInfo, Excitation, ExcitationInfo, Forcing, ForcingOf, Gradient, GradientOf, Input,
    InputInfo, JointInfo, KernelInfo, Law, LineKind, Linear, LinearPartials, LinkInfo, List, Mechanism, Output,
    OutputInfo, OutputMotionOf, PartialsOf, PictureInfo, PointInfo, PoseMargin, Real, ResidualPartialsOf, RestParts,
    RingInfo, Role, Shared, SolidInfo, SolidKind, SpanInfo, Square, Text, ToleranceInfo, Unit, Violation, WheelInfo,
};
pub use eigentol_macros::mechanism;

#[cfg(feature = "std")]
mod study;

#[cfg(feature = "analysis")]
#[doc(inline)]
pub use eigentol_analysis::{
    branches, campbell, campbell::Campbell, clusters, convergence, convergence::Convergence, event_map,
    event_map::EventMap, forced, mistuning, motion, peaks, picture, response, second_order, shapes, sweep,
};
#[cfg(feature = "std")]
#[doc(inline)]
pub use eigentol_solve::{
    Behaviour, Equilibrium, Family, Mode, Modes, Policy, Quantity, Sensitivities, Stability, Watch, equilibrium, error,
    error::Error, kernels, kernels::Kernels, modes, sensitivity,
};
#[cfg(feature = "std")]
pub mod results {
    //! How every result describes itself: tables of named columns with units, and sentences.

    pub use eigentol_results::{Answer, Column, Findings, Listed, Subject, Table, Values};
}
#[cfg(feature = "std")]
pub mod tolerance {
    //! How tolerances of design variables spread frequencies and outputs (eqs. 26-27).
    #![doc = include_str!("where_first_order_fails.md")]

    pub use eigentol_tolerance::tolerance::*;
}
#[cfg(feature = "std")]
#[doc(inline)]
pub use eigentol_numerics::algebra::{Matrix, Vector};
#[cfg(feature = "std")]
#[doc(inline)]
pub use eigentol_tolerance::{FirstOrder, MonteCarlo, Tolerances};
#[cfg(feature = "analysis")]
#[doc(inline)]
pub use eigentol_uncertainty::{allocation, bode, judge, propagation, requirement, summary};
/// A complex number.
#[cfg(feature = "std")]
pub use num_complex::Complex64 as Complex;
#[cfg(feature = "std")]
pub use study::{InDeclaredUnit, Parameter, Study, Value};

/// The example of the README, compiled and run.
#[cfg(all(doctest, feature = "analysis"))]
#[doc = include_str!("../../README.md")]
struct Readme;
