//! Beams against reference values that were computed without polynomials (transfer matrices, shooting): frequencies and
//! their total derivatives, at rest, spinning, pretwisted, tapered, with a heavy tip and bent far.
//!
//! The reference values are those of `tests/truth/flexible`. With ten coordinates the lowest modes are exact to rounding
//! and each higher one is less so; the bars say how much, mode by mode.

mod bars;
mod bent;
mod buckled;
pub(crate) mod compared;
mod composed;
mod converged;
mod coupled;
mod curved;
mod damped;
mod following;
mod framed;
mod hanging;
mod inside;
mod offset;
mod orbits;
mod poses;
mod required;
mod rotating;
mod sampled;
mod sharp;
mod strained;
mod twisted;
mod whirls;
