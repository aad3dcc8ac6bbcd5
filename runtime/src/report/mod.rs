//! Results as text: every result prints itself as an aligned table with names and units, under the name of the mechanism and
//! the operating point it belongs to, in declared units.

mod allocation;
mod branches;
mod campbell;
mod equilibrium;
mod margin;
mod modes;
mod propagation;
mod requirement;
mod second_order;
mod sensitivity;
mod shares;
mod summary;
mod sweep;
mod table;
mod title;
mod tolerance;

pub use margin::MarginTable;
