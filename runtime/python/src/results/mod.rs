//! Results as classes: arrays for computation, text and tables for reading.

mod bode;
mod branches;
mod convergence;
mod equilibrium;
mod forced;
mod modes;
mod peaks;
mod sensitivities;
mod shared;
mod sweep;

pub(crate) use bode::Bode;
pub(crate) use branches::{Branch, Branches};
pub(crate) use convergence::Convergence;
pub(crate) use equilibrium::{Assembly, Equilibrium, EquilibriumShift};
pub(crate) use forced::{ForcedCurvature, ForcedResponse, ForcedSensitivities};
pub(crate) use modes::{Modes, family};
pub(crate) use peaks::{Peaks, Separation};
pub(crate) use sensitivities::{
    EventCurvature, ModeCurvature, OutputCurvature, OutputSensitivities, Sensitivities, ShapeSensitivity, quantity,
};
pub(crate) use shared::{attributes, html, json_schema, operating_point, refused, result, table};
pub(crate) use sweep::{Campbell, Sweep};
