//! Sweeps of one input: each point starts from the previous equilibrium, and modes keep their identity.

use core::ops::ControlFlow;

use super::critical::Path;
use super::driver::follow;
use super::points::{Sweep, SweepPoint};
use super::track::{Following, Tracker};
use crate::arguments::check_input;
use crate::kernels::BatchKernels;
use crate::{Error, Input};

/// Solves equilibrium and modes at each of `values` of one input; the other inputs keep their values in `u`.
///
/// The first point starts at `start`, each later one at the last equilibrium found. A point that fails carries its
/// error and the sweep continues. A sweep that follows stable equilibria switches branches by itself and reports the
/// critical values it passes.
///
/// # Errors
/// [`Error::UnknownHandle`] for an input that the mechanism does not have.
pub fn sweep(
    mechanism: &dyn BatchKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    input: Input,
    values: &[f64],
) -> Result<Sweep, Error> {
    let mut points = Vec::with_capacity(values.len());
    let each = |point: &SweepPoint| {
        points.push(point.clone());
        ControlFlow::Continue(())
    };
    let along = (input, values);
    let found = sweep_each(mechanism, (u, b), start, following, along, each)?;
    Ok(Sweep { points, ..found })
}

/// Like [`sweep`], but passes each point to `each`, in order and as soon as it is found, and keeps none: the result
/// contains only the critical states. The sweep ends when `each` breaks off.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_each(
    mechanism: &dyn BatchKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    following: impl Into<Following>,
    (input, values): (Input, &[f64]),
    mut each: impl FnMut(&SweepPoint) -> ControlFlow<()>,
) -> Result<Sweep, Error> {
    let description = mechanism.description();
    check_input(input, &description)?;
    let following = following.into();
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input);
    let mut path = Path::new(following);
    let mut unreached = values.len();
    follow(&mut tracker, mechanism, values, false, |station| {
        let point = station.point;
        unreached -= 1;
        path.add(point.value, &point.equilibrium, station.smooth);
        each(point)
    });
    Ok(Sweep {
        input,
        points: Vec::new(),
        unreached,
        critical: path.critical_states(mechanism, (u, b), input),
        inputs: u.into(),
        description,
    })
}
