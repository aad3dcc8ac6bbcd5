//! The data that every step of the derivation reads.
//!
//! # Two frames of reference
//!
//! Forces, points and outputs are written in the common frame: the ground frame when all driven coordinates are zero.
//! Steady-state equations do not depend on the driven coordinates; once this is checked, these are set to zero, and no
//! drive costs an operation. Inertia and weight have their own recursion over the same kinematics
//! (`mechanics/inertia/newton_euler.rs`). Successive bodies that turn about the same axis form a run, written along the
//! axes of the body before it; every other body is written along its own axes, in which its mass distribution is
//! constant (`mechanics/setup/runs.rs`).

mod context;
mod coordinate;
mod derivatives;
mod excited;
mod force_selection;
mod harmonics;
mod mass_distribution;
mod multiblade;
mod probe;
mod rows;
mod runs;
mod sections;
mod symbols;
mod values;

pub(super) use context::Context;
pub(super) use coordinate::CoordinateMotion;
pub(super) use derivatives::{added, at_rest, by_symbol, columns, weighted_sum};
pub(super) use excited::Excited;
pub(super) use force_selection::{ForceSelection, Selection};
pub(super) use harmonics::Harmonics;
pub(super) use mass_distribution::{Arm, MassDistribution};
pub(super) use multiblade::Multiblade;
pub(super) use probe::{RandomState, mirrored, probe, vanish};
pub(super) use rows::{Row, Source};
pub(super) use runs::{BodyLayout, Layout, Runs};
pub(super) use sections::{Mirrored, OfBeam, Sections};
pub(super) use symbols::{Pencil, SymbolList, Symbols};
pub(super) use values::{State, Values};
