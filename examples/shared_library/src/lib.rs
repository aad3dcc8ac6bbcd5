//! A mechanism as a shared library: `casadi.rs` is what CasADi's `external` calls, `fmi.rs` what an FMI 3.0 importer calls, and
//! `answers.rs` what both ask. For a mechanism of your own, replace `rotor.mechanism`, its name below and the operating point.

mod answers;
mod casadi;
pub mod fmi;

include!(concat!(env!("OUT_DIR"), "/rotor.rs"));

/// The mechanism.
pub(crate) const MECHANISM: Rotor = Rotor;
/// Where values begin: the inputs, SI.
pub(crate) const INPUTS: [f64; 1] = [1000.0 * std::f64::consts::PI / 30.0];
