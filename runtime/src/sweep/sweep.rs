//! Sweeps of one input: each point starts from the equilibrium before it, and modes keep their identity.

use super::critical::critical_states_on;
use super::driver::follow;
use super::points::Sweep;
use super::track::{Following, Tracker};
use crate::arguments::check_input;
use crate::kernels::BatchKernels;
use crate::{Error, Input};

/// Solves equilibrium and modes at each of `values` of one input; the others keep their value in `u`.
///
/// The first point starts at `start`, each later one at the last equilibrium found. A point that fails carries its
/// error and the sweep goes on. A sweep that follows stable equilibria passes from branch to branch by itself and reports
/// the critical values on its way.
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
    let description = mechanism.description();
    check_input(input, &description)?;
    let following = following.into();
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input);
    let mut smooth = Vec::with_capacity(values.len());
    let mut points = Vec::with_capacity(values.len());
    follow(&mut tracker, mechanism, values, false, |station| {
        smooth.push(station.smooth);
        points.push(station.point.clone());
    });
    let path = points.iter().zip(&smooth);
    let path = path.map(|(point, smooth)| (point.value, &point.equilibrium, *smooth));
    let critical = critical_states_on(mechanism, (u, b), following, input, path);
    Ok(Sweep {
        input,
        points,
        critical,
        inputs: u.into(),
        description,
    })
}
