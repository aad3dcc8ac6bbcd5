//! From tokens to topology: declarations are read as written, values arrive in SI, and no input causes a panic.

#[path = "declarations/common.rs"]
mod common;
#[path = "declarations/constraints.rs"]
mod constraints;
#[path = "declarations/every.rs"]
mod every;
#[path = "declarations/inertias.rs"]
mod inertias;
#[path = "declarations/language.rs"]
mod language;
#[path = "declarations/reference.rs"]
mod reference;
#[path = "declarations/robustness.rs"]
mod robustness;
#[path = "declarations/tolerances.rs"]
mod tolerances;
#[path = "declarations/values.rs"]
mod values;
