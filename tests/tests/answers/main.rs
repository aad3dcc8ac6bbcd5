//! What is asked of a machine: references, events, spectra, whirl, outputs, results as text, and inputs that nobody expects.

mod events;
mod hard_inputs;
mod kinds;
pub mod outputs;
mod reference_values;
mod scale;
mod serial;
mod spectra;
mod stated_units;
pub mod whirl;
