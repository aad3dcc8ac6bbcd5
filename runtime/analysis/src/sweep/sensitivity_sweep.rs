//! Derivatives along an input.

use core::ops::ControlFlow;

use super::driver::follow;
use super::points::SweepPoint;
use super::track::{Following, Tracker};
use crate::arguments::check_input;
use crate::equilibrium::Needed;
use crate::kernels::BatchKernels;
use crate::sensitivity::Sensitivities;
use crate::{Error, Input};

/// Solves equilibrium, modes and their total derivatives at each of `values` of one input, and passes them to `each` in
/// order until it breaks off. This is the fastest way to derivatives along an input, because neighbouring values are
/// solved together and nothing is kept.
///
/// The arguments are those of [`sweep`](crate::sweep::sweep), which keeps its points and looks for critical states
/// between them; states and modes are identical. The derivatives, or the error, are those of
/// [`sensitivities`](crate::sensitivity::sensitivities).
///
/// # Errors
/// [`Error::UnknownHandle`] for an input that the mechanism does not have.
pub fn sensitivity_sweep(
    mechanism: &dyn BatchKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    following: impl Into<Following>,
    (input, values): (Input, &[f64]),
    mut each: impl FnMut(&SweepPoint, &Result<Sensitivities, Error>) -> ControlFlow<()>,
) -> Result<(), Error> {
    check_input(input, &mechanism.description())?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following.into(), input);
    follow(&mut tracker, mechanism, values, true, |station| match station.slopes {
        Some(slopes) => each(station.point, slopes),
        None => ControlFlow::Continue(()),
    });
    Ok(())
}

/// Solves what is `needed` at each of `values` of one input, like [`sweep_each`](super::sweep_each), without looking for
/// events between them. Without modes, those of a point are empty.
pub fn states_each(
    mechanism: &dyn BatchKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    (following, needed): (Following, Needed),
    (input, values): (Input, &[f64]),
    mut each: impl FnMut(&SweepPoint) -> ControlFlow<()>,
) -> Result<(), Error> {
    check_input(input, &mechanism.description())?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input).only(needed);
    follow(&mut tracker, mechanism, values, false, |station| each(station.point));
    Ok(())
}
