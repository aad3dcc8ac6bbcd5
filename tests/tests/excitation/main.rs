//! Forced vibration: random excited machines against matrices solved anew, closed forms, bands, requirements.

mod forcing;
mod vibration;
