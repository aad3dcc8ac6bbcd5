//! Results as text: every result prints itself as an aligned table with names and units, under the name of the mechanism and
//! the operating point it belongs to, in declared units.
//!
//! A text says what matters: what is below 0.1 % of the largest beside it, points between those shown, and digits beyond the fourth
//! to sixth are left out of it, and it says so. The tables of `eigentol-tables` leave out nothing.

mod allocation;
mod branches;
mod campbell;
mod equilibrium;
mod margin;
mod modes;
mod numbers;
mod propagation;
mod relevance;
mod requirement;
mod response;
mod second_order;
mod sensitivity;
mod sentences;
mod shares;
mod summary;
mod sweep;
mod table;
mod title;
mod tolerance;

pub use margin::MarginTable;
pub use sentences::{News, Sentence};
