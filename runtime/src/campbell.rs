//! Campbell diagrams: every mode against an input, with damping, whirl and spread, and where the modes meet engine orders.

use core::ops::ControlFlow;

use crate::algebra::Vector;
use crate::arguments::check_input;
use crate::kernels::{DirectionalKernels, Kernels};
use crate::modes::{Family, Mode, Modes, Whirl, whirls};
use crate::sensitivity::{Quantity, Sensitivities, sensitivities};
use crate::sweep::{
    Condition, Crossing, Event, EventTolerance, Following, Line, Path, Tracker, between,
    critical_tolerance, crossing_tolerance,
};
use crate::tolerance::{Spread, Tolerances};
use crate::{Behaviour, Complex, Description, Equilibrium, Error, Input, Shared};

/// One mode at one value of the input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CampbellMode {
    /// Number of the motion along the diagram.
    pub label: usize,
    /// Eigenvalue, 1/s.
    pub s: Complex,
    /// What it means.
    pub behaviour: Behaviour,
    /// Frequency `Im s` and its spread, rad/s; `None` for a mode that does not oscillate, or has no derivative.
    pub frequency: Option<Spread>,
    /// Damping ratio and its spread; `None` likewise.
    pub damping_ratio: Option<Spread>,
    /// Whirl; `None` where it does not apply.
    pub whirl: Option<Whirl>,
    /// Its eigenvalue is nearly that of another mode: spreads of its own do not exist there.
    pub clustered: bool,
}

/// All modes at one value of the input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CampbellPoint {
    /// The value, SI.
    pub value: f64,
    /// The equilibrium there, or why there is none.
    pub equilibrium: Result<Equilibrium, Error>,
    /// Its modes, or why there are none.
    pub modes: Result<Vec<CampbellMode>, Error>,
}

/// A Campbell diagram.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Campbell {
    /// The input along which it is drawn.
    pub input: Input,
    /// One point for each value.
    pub points: Vec<CampbellPoint>,
    /// How many of the values were not reached, because the run was stopped.
    pub unreached: usize,
    /// The lines that crossings were looked for with.
    pub orders: Vec<Line>,
    /// Where a frequency meets a line: value of the input, sensitivity and spread; line by line. The number of
    /// the mode is its label.
    pub crossings: Vec<EventTolerance>,
    /// Where the stable equilibrium loses its stiffness ([`Sweep::critical`](crate::sweep::Sweep)).
    pub critical: Vec<EventTolerance>,
    /// Where an oscillation begins or ceases to grow; undamped modes never do.
    pub flutter_onsets: Vec<EventTolerance>,
    /// Standard deviations that a tolerance holds.
    pub sigma_level: f64,
    /// Which modes it shows.
    pub family: Family,
    /// The inputs, SI; all but the one along which it is drawn keep their value.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Campbell {
    /// The modes that occur: their labels, ascending.
    #[must_use]
    pub fn labels(&self) -> Vec<usize> {
        let modes = self
            .points
            .iter()
            .filter_map(|point| point.modes.as_ref().ok());
        let mut labels: Vec<usize> = modes.flatten().map(|mode| mode.label).collect();
        labels.sort_unstable();
        labels.dedup();
        labels
    }

    /// One branch of the diagram: the values of the input at which the mode of this label was found, and the mode there.
    pub fn branch(&self, label: usize) -> impl Iterator<Item = (f64, &CampbellMode)> {
        self.points.iter().filter_map(move |point| {
            let modes = point.modes.as_ref().ok()?;
            let mode = modes.iter().find(|mode| mode.label == label)?;
            Some((point.value, mode))
        })
    }
}

/// What a Campbell diagram is drawn of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Axes<'a> {
    /// The input along which it is drawn.
    pub input: Input,
    /// The values of the input, SI.
    pub values: &'a [f64],
    /// Lines that crossings are looked for with.
    pub orders: &'a [Line],
}

impl<'a> Axes<'a> {
    /// A diagram along `input` at `values`, SI, with the lines `orders`.
    #[must_use]
    pub fn new(input: Input, values: &'a [f64], orders: &'a [Line]) -> Self {
        Self {
            input,
            values,
            orders,
        }
    }
}

/// Draws a Campbell diagram: solves equilibrium and modes at each of the values of one input, follows every mode, and locates
/// the crossings with `orders` and the onsets of flutter between neighbouring values.
///
/// Arguments as for [`sweep`](crate::sweep::sweep).
///
/// # Errors
/// [`Error::UnknownHandle`]; a point that fails carries its own error.
pub fn campbell(
    mechanism: &dyn DirectionalKernels,
    u: &[f64],
    b: &[f64],
    start: &[f64],
    following: impl Into<Following>,
    axes: &Axes<'_>,
    tolerances: &Tolerances,
) -> Result<Campbell, Error> {
    let mut points = Vec::with_capacity(axes.values.len());
    let each = |point| {
        points.push(point);
        ControlFlow::Continue(())
    };
    let found = campbell_each(mechanism, (u, b), start, following, axes, tolerances, each)?;
    Ok(Campbell { points, ..found })
}

/// Like [`campbell`], but gives each point to `each`, in order and as soon as it is found, and keeps none: the result has what lies
/// between the points only. The diagram ends where `each` breaks off.
///
/// # Errors
/// As [`campbell`].
pub fn campbell_each(
    mechanism: &dyn DirectionalKernels,
    (u, b): (&[f64], &[f64]),
    start: &[f64],
    following: impl Into<Following>,
    axes: &Axes<'_>,
    tolerances: &Tolerances,
    mut each: impl FnMut(CampbellPoint) -> ControlFlow<()>,
) -> Result<Campbell, Error> {
    let following = following.into();
    let Axes {
        input,
        values,
        orders,
    } = *axes;
    let description = mechanism.description();
    check_input(input, &description)?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input);
    let conditions = orders.iter().map(|&line| Condition::Line(line));
    let conditions: Vec<Condition> = conditions.chain([Condition::FlutterOnset]).collect();
    let (mut crossings, mut flutter_onsets) = (Vec::new(), Vec::new());
    let mut path = Path::new(following);
    let mut unreached = values.len();
    for &value in values {
        let before = tracker.last.clone();
        let failed = tracker.advance(value);
        if let (Some(before), Some(after), None) = (&before, &tracker.last, &failed) {
            for &condition in &conditions {
                let mut found = Vec::new();
                between(&tracker, before, after, condition, &mut found);
                let list = match condition {
                    Condition::Line(_) => &mut crossings,
                    Condition::FlutterOnset => &mut flutter_onsets,
                };
                list.extend(found.iter().map(|crossing| {
                    labelled(
                        crossing,
                        crossing_tolerance(mechanism, crossing, tolerances),
                    )
                }));
            }
        }
        if let Some(point) = failed.as_ref().or(tracker.last.as_deref()) {
            unreached -= 1;
            let describe = |(state, modes)| describe(mechanism, state, modes, tolerances);
            path.add(
                value,
                &point.equilibrium,
                tracker.smooth && failed.is_none(),
            );
            let shown = each(CampbellPoint {
                value,
                equilibrium: point.equilibrium.clone(),
                modes: point.solved().map(describe).map_err(Error::clone),
            });
            if shown.is_break() {
                break;
            }
        }
    }
    // Engine order by engine order; stable, so onsets stay as they were found.
    let order = |event: &EventTolerance| match event.event {
        Event::Crossing {
            condition: Condition::Line(line),
            ..
        } => orders.iter().position(|own| *own == line),
        _ => None,
    };
    crossings.sort_by_key(order);
    let critical = path.critical_states(mechanism, (u, b), input);
    let critical = critical
        .iter()
        .map(|state| critical_tolerance(mechanism, state, tolerances));
    Ok(Campbell {
        input,
        critical: critical.collect(),
        points: Vec::new(),
        unreached,
        orders: orders.to_vec(),
        crossings,
        flutter_onsets,
        sigma_level: tolerances.sigma_level(),
        family: tracker.family(),
        inputs: u.into(),
        description,
    })
}

/// The spread of a crossing under the label of its mode.
fn labelled(crossing: &Crossing, spread: EventTolerance) -> EventTolerance {
    let mode = crossing.modes.modes.get(crossing.mode);
    spread.with_mode(mode.map_or(crossing.mode, |mode| mode.label))
}

fn describe(
    mechanism: &dyn Kernels,
    state: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
) -> Vec<CampbellMode> {
    let slopes: Option<Sensitivities> = sensitivities(mechanism, state, modes).ok();
    let whirls = whirls(mechanism, state, modes);
    let one = |(r, mode): (usize, &Mode)| {
        let own = slopes.as_ref().map(|slopes| &slopes.modes[r]);
        let spread = |quantity: Quantity| {
            let by_design = own?.of(quantity)?.by_design;
            Some(Spread::new(quantity.of(mode)?, by_design, tolerances))
        };
        CampbellMode {
            label: mode.label,
            s: mode.s,
            behaviour: mode.behaviour,
            frequency: spread(Quantity::Frequency),
            damping_ratio: spread(Quantity::DampingRatio),
            whirl: whirls[r],
            clustered: own.is_some_and(|own| own.clustered),
        }
    };
    modes.modes.iter().enumerate().map(one).collect()
}
