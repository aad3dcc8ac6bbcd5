//! From tokens to topology: declarations are read as written, values arrive in SI, and no input causes a panic.

mod common;
mod constraints;
mod every;
mod inertias;
mod language;
mod reference;
mod robustness;
mod tolerances;
mod values;
