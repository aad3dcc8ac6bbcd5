//! The contract between compile time and run time: what generated code implements, and the numbers it computes with.
//!
//! An internal part of `eigentol`, which re-exports it.
#![cfg_attr(not(feature = "std"), no_std)]

pub mod mechanism;
pub mod scalar;

pub use mechanism::*;
pub use scalar::{Dual, Real};
