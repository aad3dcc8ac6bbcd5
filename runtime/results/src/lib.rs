//! How results describe themselves: columns with units and digits, sentences, what matters and what is omitted, and the
//! mechanism and operating point that a result belongs to.
//!
//! Text, CSV, JSON, HTML and Python follow from the one description ([`Answer`]) that stands beside the type of a result.
//!
//! An internal part of `eigentol`. It promises nothing to others.

pub mod columns;
mod findings;
pub mod grid;
pub mod naming;
pub mod numbers;
pub mod relevance;
mod setters;
pub mod shares;
mod table;
pub mod title;

pub use columns::Columns;
pub use findings::{Answer, Findings, Listed, Subject};
pub use grid::Grid;
pub use table::{Column, Table, Values};
