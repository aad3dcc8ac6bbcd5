//! Search for events along an input.
//!
//! The eigenvalues and their derivatives are known at every state. Between two states they are followed as smooth
//! functions ([`cubic`], [`spectrum`]); where one of the numbers that make an event ([`scalars`]) may vanish without a
//! certain change of sign, another state is solved ([`divide`]). So events depend on the mechanism alone, not on a grid
//! of values. States are those of the branch that the mechanism follows ([`route`]).
//!
//! # Events belong to the machine, not to a grid
//!
//! Where frequencies cross lines, motions begin or cease to grow, and stiffness vanishes is sought separately from the
//! points of a sweep (`sweep/search`). The search follows the branch by arc length. Between two states each eigenvalue
//! is the cubic through its values and exact derivatives; a number that makes an event (a distance from a line, a
//! growth, a least stiffness, the squared difference of two eigenvalues that may merge) is bounded over the stretch,
//! and the stretch is divided until the number has no zero or exactly one, or what remains is narrower than the
//! resolution. Then Newton's method with exact derivatives locates it. What is not resolved is listed with its interval
//! (`Searched::unresolved`), as are stretches without an equilibrium. The points of a sweep start from the states of
//! this route.

mod cubic;
mod divide;
mod events;
mod node;
mod pick;
mod route;
mod scalars;
mod spectrum;
mod step;

pub(crate) use events::Route;
pub use events::{Events, Gap, Searched, Unresolved};
pub(crate) use route::{Along, Met, Sought, search};
