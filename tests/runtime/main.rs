//! The solvers of the runtime on hand-written mechanisms, independent of the compiler.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

mod allocation;
mod branches;
mod chance;
mod clusters;
mod constrained_modes;
mod constraints;
mod critical_curvature;
mod deviations;
mod distributions;
mod dual;
mod equilibrium;
mod events;
mod forced;
mod handwritten;
mod judged;
mod lanes;
mod modes;
mod partial;
mod propagate;
mod quadratic;
mod quiet;
mod range;
mod reliable;
mod rounding;
mod sensitivity;
mod side_by_side;
mod study;
mod sweeps;
mod tolerance;
mod trigonometry;
mod verdict;
mod watched;
