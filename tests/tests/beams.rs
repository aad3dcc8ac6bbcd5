//! Beams against reference values that were computed without polynomials (transfer matrices, shooting): frequencies and
//! their total derivatives, at rest, spinning, pretwisted, tapered, with a heavy tip and bent far.
//!
//! The reference values are those of `tests/truth/flexible`. With ten coordinates the lowest modes are exact to rounding
//! and each higher one is less so; the bars say how much, mode by mode.

#[path = "beams/bars.rs"]
mod bars;
#[path = "beams/bent.rs"]
mod bent;
#[path = "beams/buckled.rs"]
mod buckled;
#[path = "beams/compared.rs"]
mod compared;
#[path = "beams/composed.rs"]
mod composed;
#[path = "beams/converged.rs"]
mod converged;
#[path = "beams/coupled.rs"]
mod coupled;
#[path = "beams/curved.rs"]
mod curved;
#[path = "beams/damped.rs"]
mod damped;
#[path = "beams/following.rs"]
mod following;
#[path = "beams/framed.rs"]
mod framed;
#[path = "beams/inside.rs"]
mod inside;
#[path = "beams/offset.rs"]
mod offset;
#[path = "beams/orbits.rs"]
mod orbits;
#[path = "beams/poses.rs"]
mod poses;
#[path = "beams/required.rs"]
mod required;
#[path = "beams/rotating.rs"]
mod rotating;
#[path = "beams/sampled.rs"]
mod sampled;
#[path = "beams/strained.rs"]
mod strained;
#[path = "beams/twisted.rs"]
mod twisted;
#[path = "beams/whirls.rs"]
mod whirls;
