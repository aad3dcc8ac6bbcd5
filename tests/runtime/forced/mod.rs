//! Forced vibration: against closed forms, direct solutions and differences.

mod models;
mod orbits;
mod peaks;
mod random;
mod special;
mod truth;
