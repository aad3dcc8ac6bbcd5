//! Results as classes: arrays for computation, text and tables for reading.

mod branches;
mod equilibrium;
mod modes;
mod sensitivities;
mod shared;
mod sweep;

pub(crate) use branches::{Branch, Branches};
pub(crate) use equilibrium::{Assembly, Equilibrium, EquilibriumShift};
pub(crate) use modes::Modes;
pub(crate) use sensitivities::{
    Curvature, ModeCurvature, OutputSensitivities, Sensitivities, ShapeSensitivity, quantity,
};
pub(crate) use shared::{Document, html, json_schema, result, table};
pub(crate) use sweep::{Campbell, Sweep};
