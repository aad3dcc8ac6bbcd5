//! The problem solved again in hyper-dual numbers: verified by stored numbers, finite differences and closed forms,
//! then compared with the product's derivatives.

mod chains;
mod common;
mod conditions;
mod constrained;
mod corpus;
mod differences;
mod expected;
mod instability;
mod product;
mod scalar;
mod whirl;
