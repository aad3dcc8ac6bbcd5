//! Results as text: every result prints itself as an aligned table with names and declared units, under the name of its
//! mechanism and its operating point.
//!
//! A text shows what matters. It omits values below 0.1 % of the largest next to them, points between those shown, and
//! digits beyond the fourth to sixth, and it says so. The tables of `eigentol-tables` omit nothing.

mod allocation;
mod branches;
mod campbell;
mod doubts;
mod equilibrium;
mod judgement;
mod margin;
mod modes;
mod naming;
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
