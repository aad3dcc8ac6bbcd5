//! The problem solved again in hyper-dual numbers: verified by stored numbers, finite differences and closed forms, then
//! compared with the product's derivatives.

#[path = "resolved/chains.rs"]
mod chains;
#[path = "resolved/common.rs"]
mod common;
#[path = "resolved/conditions.rs"]
mod conditions;
#[path = "resolved/constrained.rs"]
mod constrained;
#[path = "resolved/corpus.rs"]
mod corpus;
#[path = "resolved/differences.rs"]
mod differences;
#[path = "resolved/expected.rs"]
mod expected;
#[path = "resolved/instability.rs"]
mod instability;
#[path = "resolved/product.rs"]
mod product;
#[path = "resolved/scalar.rs"]
mod scalar;
#[path = "resolved/whirl.rs"]
mod whirl;
