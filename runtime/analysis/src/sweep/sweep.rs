//! Sweeps of one input: each point starts from the previous equilibrium, and modes keep their identity.

use core::ops::ControlFlow;

use super::driver::follow;
use super::points::{Sweep, SweepPoint};
use super::range::Range;
use super::search::{Along, Events, Route, Sought, growing, search};
use super::track::{Following, Tracker};
use crate::arguments::check_input;
use crate::kernels::{BatchKernels, DirectionalKernels};
use crate::modes::Family;
use crate::{Error, Input};

/// Solves equilibrium and modes at each of `values` of one input; the other inputs keep their values in `u`.
///
/// The first point starts at `start`, each later one at the last equilibrium found. A point that fails carries its
/// error and the sweep continues. A sweep that follows stable equilibria switches branches by itself. The events between
/// the first and the last value do not depend on the values between them.
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
    let mut points = Vec::new();
    let each = |point: &SweepPoint| {
        points.push(point.clone());
        ControlFlow::Continue(())
    };
    let along = (input, values);
    let sweep = sweep_each(mechanism, (u, b), start, following, along, each)?;
    Ok(Sweep { points, ..sweep })
}

/// Like [`sweep`], but passes each point to `each`, in order and as soon as it is found, and keeps none: the result
/// contains only the events. The sweep ends when `each` breaks off.
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
    let sought = Sought { flutter: true, critical: true, ..Sought::default() };
    let way = (mechanism as &dyn DirectionalKernels, (u, b), start);
    let (all_events, _) = between(way, &following, (input, values), &sought)?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input);
    let mut unreached = values.len();
    let (mut last, mut states) = (f64::NAN, Vec::new());
    follow(&mut tracker, mechanism, values, false, |station| {
        unreached -= 1;
        last = station.point.value;
        let general = station.point.modes.iter();
        states.extend(general.filter(|modes| modes.family == Family::General).map(|modes| growing(last, modes)));
        each(station.point)
    });
    let until = |events: Events| match unreached {
        0 => events,
        _ => events.until(last),
    };
    let compared = |events: Events| until(events).compared_with(&states);
    let (critical, flutter_onsets, searched) = match all_events.map(compared) {
        Some(events) => (events.critical, events.crossings, Some(events.searched)),
        None => Default::default(),
    };
    Ok(Sweep {
        input,
        points: Vec::new(),
        critical,
        flutter_onsets,
        searched,
        unreached,
        inputs: u.into(),
        description,
    })
}

/// The events between the first and the last of some values, if these ascend or descend, and the way along them.
#[expect(clippy::type_complexity, reason = "a way: mechanism, operating point, start")]
pub(crate) fn between(
    (mechanism, values, start): (&dyn DirectionalKernels, (&[f64], &[f64]), &[f64]),
    following: &Following,
    (input, along): (Input, &[f64]),
    sought: &Sought,
) -> Result<(Option<Events>, Route), Error> {
    let finite: Vec<f64> = along.iter().copied().filter(|value| value.is_finite()).collect();
    let ascends = finite.is_sorted_by(|a, b| a < b);
    let (true, [low, .., high]) = (ascends || finite.is_sorted_by(|a, b| a > b), &finite[..]) else {
        return Ok((None, Route::default()));
    };
    let along = Along {
        mechanism,
        values,
        start,
        policy: following.policy,
        family: following.family.unwrap_or_else(|| Family::of(&mechanism.description())),
        range: Range::new(input, *low, *high),
        held: following.held.clone(),
    };
    let (events, route) = search(&along, sought, |_| false)?;
    Ok((Some(events), route))
}
