//! Pictures of a mechanism against the oracle's matrices, closed forms, outputs and robot files.

mod beams;
mod closed_forms;
mod joints;
mod modes;
mod oracle;
mod robots;
mod shafts;
mod space;
