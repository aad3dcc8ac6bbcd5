//! Search for events along an input, by counting.
//!
//! Every event changes an integer of a single state ([`count`]): how many motions grow, how many directions have no
//! stiffness, how many frequencies lie above a line. So integers decide whether there is an event, and curves only help
//! to find where: between two states with different integers there is one ([`divide`]); between two with the same ones
//! an even number may hide, and the eigenvalues with their exact derivatives tell where to solve another state
//! ([`hidden`]). Modes are matched only to name the one that an event is of.
//!
//! # Events belong to the machine, not to a grid
//!
//! The search follows the branch by arc length ([`route`]), separately from the points of a sweep, which start from the
//! states of this route. What is not resolved is listed with its interval (`Searched::unresolved`), as are stretches
//! without an equilibrium. Where the points of a sweep count otherwise than the events between them, that stretch is
//! listed as well.

mod count;
mod cubic;
mod divide;
mod events;
mod hidden;
mod node;
mod route;
mod spectrum;
mod step;

pub use events::{Events, Gap, Searched, Unresolved};
pub(crate) use events::{Route, growing};
pub(crate) use route::{Along, Met, Sought, search};
