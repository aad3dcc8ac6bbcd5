//! Forced vibration along an input: amplitude and phase with their derivatives, and bands of the amplitudes under
//! tolerances.

mod answer;

use core::ops::ControlFlow;

use crate::algebra::Vector;
use crate::equilibrium::Needed;
use crate::forced::{self, ForcedSensitivities};
use crate::kernels::SummaryKernels;
use crate::propagation::{Propagation, VibrationCheck, vibrations};
use crate::response::{Response, Responses, Vibration};
use crate::sweep::{Following, SweepPoint, states_each};
use crate::tolerance::{Sampling, Tolerances, pool};
use crate::{Description, Error, Input, Shared, Watch};

/// Forced vibration along an input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bode {
    /// The varied input.
    pub input: Input,
    /// A point for each of its values.
    pub points: Vec<BodePoint>,
    /// Points between the values, for figures alone.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub between: Vec<BodePoint>,
    /// The vibrations that have bands.
    pub banded: Vec<Vibration>,
    /// Number of values not reached because the run was stopped.
    pub unreached: usize,
    /// The inputs, SI; all but the varied one keep their values.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Bode {
    /// The answer with points of `others` between its values, which figures show besides: those about peaks
    /// ([`Peaks::bends`](eigentol_analysis::peaks::Peaks::bends)).
    #[must_use]
    pub fn with_between(mut self, others: Self) -> Self {
        self.between.extend(others.points);
        self
    }

    /// All points in the order of the values.
    pub fn course(&self) -> Vec<&BodePoint> {
        let mut all: Vec<&BodePoint> = self.points.iter().chain(&self.between).collect();
        if self.between.is_empty() {
            return all;
        }
        all.sort_by(|a, b| a.value.total_cmp(&b.value));
        if self.points.first().map(|point| point.value) > self.points.last().map(|point| point.value) {
            all.reverse();
        }
        all
    }
}

/// Forced vibration at one value of an input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodePoint {
    /// The value, SI.
    pub value: f64,
    /// Whether the equilibrium is stable and no mode grows. Elsewhere no machine stays in this vibration.
    pub stable: bool,
    /// The vibration with its derivatives, or why there is none.
    pub vibration: Result<ForcedSensitivities, Error>,
    /// The spreads of the amplitudes, if they were asked for and exist.
    pub bands: Option<Bands>,
}

/// Spreads of amplitudes at one value of an input, and how far they can be trusted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bands {
    /// The spreads, in the order of [`Bode::banded`].
    pub spread: Propagation,
    /// Comparisons with designs solved anew; empty if none was asked for.
    pub checks: Vec<Option<VibrationCheck>>,
}

/// What bands to compute.
#[derive(Clone)]
pub struct Banded<'a> {
    /// The vibrations.
    pub wanted: Vec<Vibration>,
    /// The tolerances of the design.
    pub tolerances: &'a Tolerances,
    /// How to sample the model.
    pub sampling: Sampling<'a>,
    /// Number of designs solved anew at each point; none if zero.
    pub checked: usize,
}

/// Points whose vibrations are solved in parallel.
const TOGETHER: usize = 256;

/// Forced vibration at each of `values` of one input, SI, with bands if they are asked for. Progress counts values. The
/// states follow each other; their vibrations are solved by `threads` threads, 0 for as many as the machine has.
///
/// # Errors
/// [`Error::UnknownHandle`], [`Error::NoExcitation`], [`Error::Threads`]; a point that fails carries its own error.
pub fn bode(
    mechanism: &dyn SummaryKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    following: impl Into<Following>,
    (input, values): (Input, &[f64]),
    (banded, threads, watch): (Option<&Banded<'_>>, usize, Watch<'_>),
) -> Result<Bode, Error> {
    let description = mechanism.description();
    if description.excitations.is_empty() {
        return Err(Error::NoExcitation { mechanism: description.name.clone() });
    }
    // Bands are parallel themselves.
    let (together, threads, needed) = match banded {
        Some(_) => (1, 1, Needed::Modes),
        None => (TOGETHER, threads, Needed::Verdict),
    };
    let size = (u.len() + start.len(), b.len());
    let mut points = Vec::new();
    let mut solve = |states: &[SweepPoint]| {
        let one = |(): &mut (), k: usize| point(mechanism, &states[k], banded);
        for point in pool::run(threads, size, states.len(), || (), one)? {
            points.push(point?);
            watch.advance(1);
        }
        Ok(if watch.stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    };
    let (mut waiting, mut failed) = (Vec::with_capacity(together), None);
    states_each(mechanism, (u, b), start, (following.into(), needed), (input, values), |at| {
        waiting.push(at.clone());
        if waiting.len() < together && !watch.stopped() {
            return ControlFlow::Continue(());
        }
        let flow = solve(&waiting);
        waiting.clear();
        flow.unwrap_or_else(|error| {
            failed = Some(error);
            ControlFlow::Break(())
        })
    })?;
    if let Some(error) = failed {
        return Err(error);
    }
    let _last = solve(&waiting)?;
    let unreached = values.len() - points.len();
    Ok(Bode {
        input,
        points,
        between: Vec::new(),
        banded: banded.map_or(Vec::new(), |banded| banded.wanted.clone()),
        unreached,
        inputs: u.into(),
        description,
    })
}

/// Errors of settings end the whole; those of the state belong to the point.
fn point(mechanism: &dyn SummaryKernels, at: &SweepPoint, banded: Option<&Banded<'_>>) -> Result<BodePoint, Error> {
    let value = at.value;
    let vibration = match &at.equilibrium {
        Ok(equilibrium) => forced::sensitivities(mechanism, equilibrium),
        Err(error) => Err(error.clone()),
    };
    let stable = match (&at.equilibrium, &at.modes) {
        (Ok(equilibrium), Ok(modes)) => equilibrium.stability.holds() && modes.stable(),
        _ => false,
    };
    let mut bands = None;
    if let (Some(banded), Ok(equilibrium), Ok(modes), Ok(_)) = (banded, &at.equilibrium, &at.modes, &vibration) {
        let wanted = banded.wanted.iter().copied().map(Response::Vibration);
        let responses = Responses::new(mechanism, equilibrium, modes, wanted.collect())?;
        let (tolerances, sampling) = (banded.tolerances, &banded.sampling);
        let (spread, checks) = vibrations(mechanism, &responses, tolerances, sampling, banded.checked)?;
        bands = Some(Bands { spread, checks });
    }
    Ok(BodePoint { value, stable, vibration, bands })
}
