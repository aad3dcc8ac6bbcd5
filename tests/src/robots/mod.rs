//! Two of the robots of `truth/robots`, compiled by the macro: an arm whose elbow follows its shoulder about the same axis, and a
//! walking robot with a floating base and four such legs.

pub mod solo;
pub mod ur5;

pub use solo::Solo12Free;
pub use ur5::Ur5;
