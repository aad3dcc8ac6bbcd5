//! Sweeps of one input: each point starts from the equilibrium before it, and modes keep their identity.

use core::ops::Deref;

use super::CriticalState;
use super::critical::critical_states_on;
use super::follow::follow;
use super::range::check_input;
use super::track::{Following, Tracker};
use crate::kernels::BatchKernels;
use crate::{Description, Equilibrium, Error, Input, Modes, Shared};

/// A sweep: its points read as a slice.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The swept input.
    pub input: Input,
    /// One point for each value.
    pub points: Vec<SweepPoint>,
    /// Where the stable equilibrium that the sweep follows loses its stiffness: critical values of the input, located to
    /// rounding, each on the branch before it. Looked for when a stable equilibrium is wanted and the values ascend or
    /// descend.
    pub critical: Vec<CriticalState>,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Deref for Sweep {
    type Target = [SweepPoint];

    fn deref(&self) -> &Self::Target {
        &self.points
    }
}

impl IntoIterator for Sweep {
    type Item = SweepPoint;
    type IntoIter = std::vec::IntoIter<Self::Item>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.into_iter()
    }
}

impl<'a> IntoIterator for &'a Sweep {
    type Item = &'a SweepPoint;
    type IntoIter = core::slice::Iter<'a, SweepPoint>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.iter()
    }
}

/// One point of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPoint {
    /// Value of the swept input, SI.
    pub value: f64,
    /// The equilibrium, or why there is none.
    pub equilibrium: Result<Equilibrium, Error>,
    /// The modes there: modes with one label are one motion along the whole sweep.
    pub modes: Result<Modes, Error>,
}

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
        description,
    })
}
