//! Machines declared with `mechanism!` and solved by the runtime, against the reference values in `truth/`.

mod chains;
mod common;
mod conditions;
mod events;
mod general;
mod moments;
