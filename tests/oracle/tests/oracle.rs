//! The oracle against a second derivation of it, against finite differences, and against known answers.

#[path = "oracle/closed_forms.rs"]
mod closed_forms;
#[path = "oracle/random_trees.rs"]
mod random_trees;
#[path = "oracle/reference.rs"]
mod reference;
