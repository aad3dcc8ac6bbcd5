//! Sweeps, events along an input and how tolerances move them, as text and tables.

mod events;
mod states;
mod sweep;

pub(crate) use events::{event_columns, meeting, unresolved};
pub use sweep::sweep_table;
