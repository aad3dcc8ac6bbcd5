//! Forced vibration: against closed forms, direct solutions and differences.

mod models;
mod truth;
