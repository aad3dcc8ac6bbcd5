//! The tables of each result.

mod allocation;
mod branches;
mod campbell;
mod clusters;
mod curvature;
mod equilibrium;
mod events;
mod modes;
mod names;
mod propagation;
mod requirement;
mod samples;
mod second_order;
mod sensitivity;
mod summary;
mod sweep;
mod tolerance;

pub use branches::branch_table;
pub use campbell::campbell_table;
pub(crate) use names::as_written;
pub use samples::{numbered_samples_table, samples_table};
pub use sweep::sweep_table;

use crate::Table;

/// A result that has tables.
pub trait Tables {
    /// Its tables: the answer first, then details.
    fn tables(&self) -> Vec<Table>;
}

/// Returns the tables of a result; see [`Tables::tables`].
pub fn tables<R: Tables + ?Sized>(result: &R) -> Vec<Table> {
    result.tables()
}

impl<R: Tables + ?Sized> Tables for &R {
    fn tables(&self) -> Vec<Table> {
        (**self).tables()
    }
}
