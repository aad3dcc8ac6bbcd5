//! Machines declared with `mechanism!` and solved by the runtime, against the reference values in `truth/`.

#[path = "reference_values/chains.rs"]
mod chains;
#[path = "reference_values/common.rs"]
mod common;
#[path = "reference_values/conditions.rs"]
mod conditions;
#[path = "reference_values/events.rs"]
mod events;
#[path = "reference_values/general.rs"]
mod general;
#[path = "reference_values/moments.rs"]
mod moments;
