//! Campbell diagrams: every mode over an input, with damping, kind, whirl and spread, and the crossings with engine orders.

mod answer;

use core::ops::ControlFlow;

use crate::algebra::Vector;
use crate::arguments::check_input;
use crate::kernels::{DirectionalKernels, Kernels};
use crate::modes::{Family, Mode, Modes, Whirl, whirls};
use crate::sensitivity::{Quantity, Sensitivities, sensitivities};
use crate::sweep::{
    Condition, Crossing, Event, EventTolerance, Events, Following, Line, Searched, Sought, Tracker, between,
    critical_tolerance, crossing_tolerance, growing,
};
use crate::tolerance::{Spread, Tolerances};
use crate::{Behaviour, Complex, Description, Equilibrium, Error, Input, Shared};

pub use answer::campbell_table;

/// So few modes are all shown.
const FEW: usize = 6;
/// How far above the lines modes are shown.
const MARGIN: f64 = 1.2;

/// One mode at one value of the input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CampbellMode {
    /// Label of the motion along the diagram.
    pub label: usize,
    /// Eigenvalue, 1/s.
    pub s: Complex,
    /// Its behaviour.
    pub behaviour: Behaviour,
    /// Frequency `Im s` and its spread, rad/s; `None` if the mode does not oscillate or has no derivative.
    pub frequency: Option<Spread>,
    /// Damping ratio and its spread; `None` in the same cases.
    pub damping_ratio: Option<Spread>,
    /// Kind and whirl; `None` if not applicable.
    pub whirl: Option<Whirl>,
    /// Whether its eigenvalue is nearly equal to another: its spreads are then not meaningful.
    pub clustered: bool,
}

/// All modes at one value of the input.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CampbellPoint {
    /// The value, SI.
    pub value: f64,
    /// The equilibrium, or the reason why there is none.
    pub equilibrium: Result<Equilibrium, Error>,
    /// Its modes, or the reason why there are none.
    pub modes: Result<Vec<CampbellMode>, Error>,
}

/// A Campbell diagram.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Campbell {
    /// The input on the horizontal axis.
    pub input: Input,
    /// One point per value.
    pub points: Vec<CampbellPoint>,
    /// Number of values not reached because the run was stopped.
    pub unreached: usize,
    /// The lines whose crossings were searched for.
    pub orders: Vec<Line>,
    /// Crossings of frequencies with lines, line by line: input value, sensitivity and spread. The number of the mode
    /// is its label.
    ///
    /// Only those of modes that something excites there ([`EventTolerance::is_excited`]).
    pub crossings: Vec<EventTolerance>,
    /// The other crossings, in the same order: an unbalance excites neither torsion nor motion along an axis, nor whirl
    /// against the spin in isotropic bearings.
    pub not_excited: Vec<EventTolerance>,
    /// Values at which stiffness vanishes ([`Sweep::critical`](crate::sweep::Sweep)).
    pub critical: Vec<EventTolerance>,
    /// Values at which an oscillation starts or stops growing; none for undamped modes.
    pub flutter_onsets: Vec<EventTolerance>,
    /// The range that was searched for events, and how finely; `None` without a range.
    pub searched: Option<Searched>,
    /// How many modes texts and figures show; `None` for those that the lines reach and the coordinates of beams resolve.
    #[cfg_attr(feature = "serde", serde(default))]
    pub modes: Option<usize>,
    /// Number of standard deviations that a tolerance represents.
    pub sigma_level: f64,
    /// The family of the modes shown.
    pub family: Family,
    /// The inputs, SI; all but the one on the axis keep their values.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl Campbell {
    /// The diagram with all crossings, also of modes that nothing excites there.
    #[must_use]
    pub fn with_all_crossings(mut self) -> Self {
        self.crossings.append(&mut self.not_excited);
        self
    }

    /// The diagram whose texts and figures show this many modes.
    #[must_use]
    pub fn with_modes(mut self, count: usize) -> Self {
        self.modes = Some(count);
        self
    }

    /// The diagram with the modes that texts and figures show: all if they are few, else of those that oscillate and that the
    /// coordinates of beams resolve all that a line reaches somewhere, one at least; or as many as are asked for.
    #[must_use]
    pub fn shown(&self) -> Self {
        let mut shown = self.clone();
        let all = self.labels();
        let lowest = |label: usize| {
            self.branch(label).filter_map(|(_, mode)| mode.behaviour.frequency()).fold(f64::INFINITY, f64::min)
        };
        let (oscillating, others): (Vec<usize>, Vec<usize>) = all.iter().partition(|label| lowest(**label).is_finite());
        let labels: Vec<usize> = match self.modes {
            Some(count) => oscillating.into_iter().chain(others).take(count).collect(),
            None if all.len() <= FEW => all,
            None => {
                let resolved = self.description.resolved_modes.unwrap_or(usize::MAX).max(1);
                let reach = self.reach().unwrap_or(f64::INFINITY);
                let near = oscillating.into_iter().take(resolved).enumerate();
                near.filter(|(k, label)| *k == 0 || lowest(*label) <= reach).map(|(_, label)| label).collect()
            }
        };
        for modes in shown.points.iter_mut().filter_map(|point| point.modes.as_mut().ok()) {
            modes.retain(|mode| labels.contains(&mode.label));
        }
        shown
    }

    /// Somewhat above all lines, rad/s; `None` without lines.
    fn reach(&self) -> Option<f64> {
        let ends = [self.points.first()?.value, self.points.last()?.value];
        let heights = self.orders.iter().flat_map(|line| ends.map(|end| line.ratio * end + line.offset));
        heights.reduce(f64::max).map(|height| MARGIN * height)
    }

    /// Says that modes are left out.
    #[must_use]
    pub fn modes_left_out(&self, shown: &Self) -> Option<String> {
        let (all, shown) = (self.labels().len(), shown.labels().len());
        let more = all.checked_sub(shown).filter(|more| *more > 0)?;
        let verb = if more == 1 { "mode is" } else { "modes are" };
        Some(format!(
            "{more} {verb} left out, above what the lines reach or the coordinates of beams resolve: `campbell --modes {all}` \
             shows all"
        ))
    }

    /// Says that crossings are left out of the list.
    #[must_use]
    pub fn left_out(&self) -> Option<String> {
        let count = match self.not_excited.len() {
            0 => return None,
            1 => "1 crossing is".to_owned(),
            count => format!("{count} crossings are"),
        };
        Some(format!("{count} left out, of modes that no unbalance excites: `campbell --all-crossings` lists all"))
    }

    /// Labels of the modes that occur, in ascending order.
    #[must_use]
    pub fn labels(&self) -> Vec<usize> {
        let mut labels: Vec<usize> =
            self.points.iter().filter_map(|point| point.modes.as_ref().ok()).flatten().map(|mode| mode.label).collect();
        labels.sort_unstable();
        labels.dedup();
        labels
    }

    /// One branch of the diagram: the input values at which the mode with this label was found, and the mode there.
    pub fn branch(&self, label: usize) -> impl Iterator<Item = (f64, &CampbellMode)> {
        self.points.iter().filter_map(move |point| {
            let mode = point.modes.as_ref().ok()?.iter().find(|mode| mode.label == label)?;
            Some((point.value, mode))
        })
    }
}

/// The input, values and lines of a Campbell diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Axes<'a> {
    /// The input on the horizontal axis.
    pub input: Input,
    /// The values of the input, SI.
    pub values: &'a [f64],
    /// Lines whose crossings are searched for.
    pub orders: &'a [Line],
}

impl<'a> Axes<'a> {
    /// A diagram over `input` at `values` (SI), with the lines `orders`.
    #[must_use]
    pub fn new(input: Input, values: &'a [f64], orders: &'a [Line]) -> Self {
        Self { input, values, orders }
    }
}

/// Computes a Campbell diagram: solves equilibrium and modes at each value of one input, follows every mode, and finds
/// the critical values, the onsets of flutter and the crossings with `orders` between the first and the last value,
/// whatever the values between them.
///
/// The arguments are those of [`sweep`](crate::sweep::sweep).
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
    let mut points = Vec::new();
    let each = |point| {
        points.push(point);
        ControlFlow::Continue(())
    };
    let campbell = campbell_each(mechanism, (u, b), start, following, axes, tolerances, each)?;
    Ok(Campbell { points, ..campbell })
}

/// Like [`campbell`], but passes each point to `each`, in order and as soon as it is found, and keeps none: the result
/// contains only the events between the points. The diagram ends when `each` breaks off.
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
    let Axes { input, values, orders } = *axes;
    let description = mechanism.description();
    check_input(input, &description)?;
    let sought = Sought { lines: orders.to_vec(), flutter: true, critical: true };
    let way = (mechanism, (u, b), start);
    let (all_events, route) = between(way, &following, (input, values), &sought)?;
    let mut tracker = Tracker::new(mechanism, (u, b), start, following, input).on(route);
    let (mut unreached, mut states) = (values.len(), Vec::new());
    for &value in values {
        let failed = tracker.advance(value);
        if let Some(point) = failed.as_ref().or(tracker.last.as_deref()) {
            unreached -= 1;
            states.extend(point.modes.iter().map(|modes| growing(value, modes)));
            let describe = |(state, modes)| describe(mechanism, state, modes, tolerances);
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
    let mut diagram = Campbell {
        input,
        critical: Vec::new(),
        points: Vec::new(),
        unreached,
        orders: orders.to_vec(),
        crossings: Vec::new(),
        not_excited: Vec::new(),
        flutter_onsets: Vec::new(),
        searched: None,
        modes: None,
        sigma_level: tolerances.sigma_level(),
        family: tracker.family(),
        inputs: u.into(),
        description,
    };
    let until = |events: Events| match (unreached, &tracker.last) {
        (1.., Some(last)) => events.until(last.value),
        _ => events,
    };
    if let Some(events) = all_events.map(until) {
        let events = match diagram.family {
            Family::General => events.compared_with(&states),
            Family::Undamped => events,
        };
        let spread = |state| critical_tolerance(mechanism, state, tolerances);
        diagram.critical = events.critical.iter().map(spread).collect();
        for crossing in &events.crossings {
            let event = labelled(crossing, crossing_tolerance(mechanism, crossing, tolerances));
            match crossing.condition {
                Condition::Line(_) => diagram.crossings.push(event),
                Condition::FlutterOnset => diagram.flutter_onsets.push(event),
            }
        }
        diagram.searched = Some(events.searched);
    }
    // By engine order; the sort is stable, so events stay in the order found.
    let order = |event: &EventTolerance| match event.event {
        Event::Crossing { condition: Condition::Line(line), .. } => orders.iter().position(|order| *order == line),
        _ => None,
    };
    diagram.crossings.sort_by_key(order);
    diagram.not_excited = (diagram.crossings).extract_if(.., |event| !event.is_excited()).collect();
    Ok(diagram)
}

/// The spread of a crossing, with the label of its mode.
fn labelled(crossing: &Crossing, spread: EventTolerance) -> EventTolerance {
    let mode = crossing.modes.modes.get(crossing.mode);
    spread.with_mode(mode.map_or(crossing.mode, |mode| mode.label))
}

fn describe(mechanism: &dyn Kernels, state: &Equilibrium, modes: &Modes, tolerances: &Tolerances) -> Vec<CampbellMode> {
    let slopes: Option<Sensitivities> = sensitivities(mechanism, state, modes).ok();
    let whirls = whirls(mechanism, state, modes);
    let one = |(r, mode): (usize, &Mode)| {
        let sensitivity = slopes.as_ref().map(|slopes| &slopes.modes[r]);
        let spread = |quantity: Quantity| {
            let by_design = sensitivity?.of(quantity)?.by_design;
            Some(Spread::new(quantity.of(mode)?, by_design, tolerances))
        };
        CampbellMode {
            label: mode.label,
            s: mode.s,
            behaviour: mode.behaviour,
            frequency: spread(Quantity::Frequency),
            damping_ratio: spread(Quantity::DampingRatio),
            whirl: whirls[r],
            clustered: sensitivity.is_some_and(|x| x.clustered),
        }
    };
    modes.modes.iter().enumerate().map(one).collect()
}
