//! Results as text: every result prints itself as an aligned table with names and declared units, under the name of its
//! mechanism and its operating point.
//!
//! A text shows what matters. It omits values below 0.1 % of the largest next to them, points between those shown, and
//! digits beyond the fourth to sixth, and it says so. The tables of `eigentol-tables` omit nothing.

mod allocation;
mod branches;
mod campbell;
mod events;
mod judgement;
mod margin;
mod propagation;
mod requirement;
mod response;
mod second_order;
mod sentences;
mod summary;
mod sweep;

pub use margin::MarginTable;
pub use sentences::{News, Sentence};
