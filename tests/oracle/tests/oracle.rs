//! Checks the oracle against a second derivation, finite differences and known solutions.

#[path = "oracle/closed_forms.rs"]
mod closed_forms;
#[path = "oracle/random_trees.rs"]
mod random_trees;
#[path = "oracle/reference.rs"]
mod reference;
