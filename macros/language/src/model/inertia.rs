//! Conditions for an inertia to belong to a body: for tools that write declarations.

pub use super::rules::tensor::{Matrix, Vector, is_inertia_of_a_body, nearest_of_a_body, principal};
