//! The equations linearised about a steady motion.
//!
//! # Derivatives by differentiating the graph
//!
//! `Khat` and `Chat` are forward derivatives of the residual; no matrix product is expanded. Where runs do not prevail,
//! there is a second way to the inertial part, with every body along its own axes (`mechanics/inertia/variation.rs`): a
//! change of a joint's position or rate changes the motion of everything it carries as if that were rigid, and each
//! coordinate behind it responds through one covector, part of which gives the entries of the mass matrix. At rest, the
//! coordinates of a beam take part as motions of its stations, and the beam by itself is differentiated by its own
//! coordinates alone (`mechanics/inertia/linearised_beam.rs`): a rotor of ten beams takes less than half of the operations.
//! The cheaper way is taken: for derivatives along a motion the second needs half the operations of differentiation (an arm, a
//! walking robot of 29 joints), for an arm's stiffness a third. (This is akin to the derivatives of S. Singh, R. P.
//! Russell and P. M. Wensing, "Efficient analytical derivatives of rigid-body dynamics using spatial vector algebra",
//! 2022.) The scalar `phi^T (Khat - lambda Mhat) phi` is one directional derivative of the residual, and its
//! reverse-mode gradient gives all design derivatives of a mode at O(n) cost. A damped mode takes `psi^T (s^2 Mhat + s
//! Chat + Khat) phi`, one more directional derivative, at the same cost (`mechanics/kernels/adjoint.rs`).

mod columns;
mod inertial;
#[cfg(test)]
mod inertial_tests;
mod jacobians;
mod matrices;

#[cfg(test)]
pub(super) use inertial_tests::compared;
pub(super) use jacobians::Jacobians;
pub(super) use matrices::{Linear, linear_arrays};
