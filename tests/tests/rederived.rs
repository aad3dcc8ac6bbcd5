//! The problem solved again in hyper-dual numbers: verified by stored numbers, finite differences and closed forms,
//! then compared with the product's derivatives.

#[path = "rederived/chains.rs"]
mod chains;
#[path = "rederived/common.rs"]
mod common;
#[path = "rederived/conditions.rs"]
mod conditions;
#[path = "rederived/constrained.rs"]
mod constrained;
#[path = "rederived/corpus.rs"]
mod corpus;
#[path = "rederived/differences.rs"]
mod differences;
#[path = "rederived/expected.rs"]
mod expected;
#[path = "rederived/instability.rs"]
mod instability;
#[path = "rederived/product.rs"]
mod product;
#[path = "rederived/scalar.rs"]
mod scalar;
#[path = "rederived/whirl.rs"]
mod whirl;
