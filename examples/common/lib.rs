//! Code shared by the examples: the command line, the sweep over the speed, tables, figures and files.
//!
//! An example file declares its mechanism and its question; this crate computes, draws and writes the answers. Its
//! modules, in the order of a run: [`options`], [`analysis`] (which runs [`events`], [`sweep`] and [`cost`]),
//! [`pictures`], [`record`], [`summary`]; for rotors [`options`], [`rotor`]. Figures are drawn by the crate
//! `eigentol-figures`.

pub mod analysis;
pub mod cost;
pub mod events;
pub mod failure;
pub mod options;
pub mod pictures;
pub mod program;
pub mod progress;
pub mod question;
pub mod record;
pub mod rotor;
pub mod speeds;
pub mod summary;
pub mod sweep;
pub mod table;

pub use analysis::Analysis;
pub use failure::Failure;
pub use options::Options;
pub use program::program;
pub use question::Question;
pub use rotor::RotorQuestion;
pub use sweep::Sweep;
