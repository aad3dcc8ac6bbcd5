//! Two of the robots of `truth/robots`, compiled by the macro: an arm whose elbow axis is parallel to its shoulder axis, and a
//! walking robot with a floating base and four legs of the same kind.

pub mod solo;
pub mod ur5;

pub use solo::Solo12Free;
pub use ur5::Ur5;
