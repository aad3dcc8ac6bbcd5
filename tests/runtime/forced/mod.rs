//! Forced vibration: against closed forms, direct solutions and differences.

mod models;
mod random;
mod special;
mod truth;
