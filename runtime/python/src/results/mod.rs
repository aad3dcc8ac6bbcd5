//! Results as classes: arrays for computation, text and tables for reading.

mod answer;
mod equilibrium;
mod forced;
mod modes;
mod monte_carlo;
mod sensitivities;
mod shared;
mod sweep;

pub(crate) use answer::{Answer, Described, typed};
pub(crate) use equilibrium::Equilibrium;
pub(crate) use forced::ForcedResponse;
pub(crate) use modes::{Modes, family};
pub(crate) use monte_carlo::MonteCarlo;
pub(crate) use sensitivities::{Sensitivities, quantity};
pub(crate) use shared::{attributes, html, json_schema, refused, result, table};
pub(crate) use sweep::Sweep;
