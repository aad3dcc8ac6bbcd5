//! The data that every step of the derivation reads.

mod context;
mod coordinate;
mod derivatives;
mod force_selection;
mod probe;
mod rows;
mod runs;
mod symbols;
mod values;

pub(super) use context::Context;
pub(super) use coordinate::CoordinateMotion;
pub(super) use derivatives::{at_rest, by_symbol, columns};
pub(super) use force_selection::{ForceSelection, Selection};
pub(super) use probe::{RandomState, probe, vanish};
pub(super) use rows::{Row, Source};
pub(super) use runs::{BodyLayout, Layout, Runs};
pub(super) use symbols::{Pencil, SymbolList, Symbols};
pub(super) use values::{State, Values};
