//! Search for events along an input.
//!
//! The eigenvalues and their derivatives are known at every state. Between two states they are followed as smooth
//! functions ([`cubic`], [`spectrum`]); where one of the numbers that make an event ([`scalars`]) may vanish without a
//! certain change of sign, another state is solved ([`divide`]). So events depend on the mechanism alone, not on a grid
//! of values. States are those of the branch that the mechanism follows ([`route`]).

mod cubic;
mod divide;
mod found;
mod node;
mod pick;
mod route;
mod scalars;
mod spectrum;
mod step;

pub(crate) use found::Route;
pub use found::{Events, Gap, Searched, Unresolved};
pub(crate) use route::{Along, Met, Sought, search};
