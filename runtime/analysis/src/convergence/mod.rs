//! How far every answer changes with more coordinates of flexible bodies.

mod answer;

use crate::algebra::Vector;
use crate::campbell::Campbell;
use crate::kernels::Kernels;
use crate::peaks::{Peak, PeakQuantity, Peaks};
use crate::response::Response;
use crate::sensitivity::Quantity;
use crate::sweep::{Event, EventTolerance, Range};
use crate::{Behaviour, Description, Equilibrium, Error, Mode, Modes, Output, Shared};
use eigentol_results::relevance::{largest, unless_rounding};

/// Outputs, frequencies and damping ratios with the declared coordinates of flexible bodies, and their changes with
/// more.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Convergence {
    /// Frequencies and damping ratios of the modes that oscillate, then outputs, then what is found along an input.
    pub changes: Vec<Change>,
    /// Why peaks along an input are not compared, if they were asked for.
    pub without_peaks: Option<Error>,
    /// The inputs they belong to, SI.
    pub inputs: Vector,
    /// The mechanism with the declared coordinates.
    pub description: Shared<Description>,
}

/// An answer and its changes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Change {
    /// What it is.
    pub answer: Response,
    /// Its value with the declared coordinates, SI.
    pub value: f64,
    /// What is added to it with one coordinate more in each component, and with two, relative to the larger of the two
    /// values compared; zero within rounding. `None` if the answer no longer exists.
    pub relative: [Option<f64>; 2],
}

impl Change {
    /// The larger of the changes, without sign; infinite if the answer no longer exists.
    #[must_use]
    pub fn most(&self) -> f64 {
        largest(self.relative.map(|relative| relative.unwrap_or(f64::INFINITY)))
    }

    /// The mode it belongs to, from 0; `None` for an output.
    #[must_use]
    pub fn mode(&self) -> Option<usize> {
        match self.answer {
            Response::Mode { mode, .. } => Some(mode),
            _ => None,
        }
    }
}

/// The first critical value along an input, and where each mode first meets each line and first starts or ceases to
/// grow, with modes numbered as at the low end.
#[must_use]
pub fn first_events(found: &Campbell, range: Range) -> Vec<(Response, f64)> {
    let mut answers: Vec<(Response, f64)> = Vec::new();
    let lists = [&found.critical, &found.crossings, &found.not_excited, &found.flutter_onsets];
    for EventTolerance { event, value, .. } in lists.into_iter().flatten() {
        let answer = match *event {
            Event::Critical => Response::Critical(range),
            Event::Crossing { mode, condition, .. } => Response::Crossing { mode, condition, range },
        };
        if answers.iter().all(|(other, _)| *other != answer) {
            answers.push((answer, *value));
        }
    }
    answers
}

/// Place and height of the highest peak of each vibration along an input.
#[must_use]
pub fn highest_peaks(found: &[Peaks], range: Range) -> Vec<(Response, f64)> {
    let mut answers = Vec::new();
    for Peaks { vibration, peaks, .. } in found {
        let highest = |a: &&Peak, b: &&Peak| a.height.value.total_cmp(&b.height.value);
        let Some(peak) = peaks.iter().max_by(highest) else {
            continue;
        };
        for (quantity, value) in [(PeakQuantity::Place, peak.place.value), (PeakQuantity::Height, peak.height.value)] {
            let vibration = *vibration;
            let answer = Response::Peak { vibration, range, quantity };
            answers.push((answer, value));
        }
    }
    answers
}

impl Convergence {
    /// Adds the changes of answers that are found along an input with the declared coordinates and with more. What
    /// modes do is compared in the order in which it is found.
    #[must_use]
    pub fn with(mut self, declared: &[(Response, f64)], refined: [&[(Response, f64)]; 2]) -> Self {
        let unnumbered = |answer: Response| match answer {
            Response::Crossing { condition, range, .. } => Response::Crossing { mode: 0, condition, range },
            _ => answer,
        };
        let alike = |all: &[(Response, f64)], answer| -> Vec<f64> {
            all.iter().filter(|(other, _)| unnumbered(*other) == answer).map(|(_, value)| *value).collect()
        };
        for (k, (answer, value)) in declared.iter().enumerate() {
            let place = alike(&declared[..k], unnumbered(*answer)).len();
            let others = refined.map(|all| alike(all, unnumbered(*answer)).get(place).copied());
            self.changes.push(change(*answer, *value, others));
        }
        self
    }

    /// The changes of the first modes that oscillate alone, as many as these, and of the outputs.
    #[must_use]
    pub fn of_first(mut self, modes: usize) -> Self {
        let mut compared: Vec<usize> = self.changes.iter().filter_map(Change::mode).collect();
        compared.dedup();
        compared.truncate(modes);
        self.changes.retain(|change| change.mode().is_none_or(|x| compared.contains(&x)));
        self
    }
}

/// A mechanism that has been solved.
#[derive(Clone, Copy)]
pub struct Solved<'a> {
    /// The mechanism.
    pub mechanism: &'a dyn Kernels,
    /// Its equilibrium.
    pub state: &'a Equilibrium,
    /// The modes there.
    pub modes: &'a Modes,
}

impl<'a> Solved<'a> {
    /// The modes that oscillate, with their positions.
    fn oscillating(self) -> Vec<(usize, &'a Mode)> {
        self.modes.modes.iter().enumerate().filter(|(_, mode)| mode.frequency().is_some()).collect()
    }

    fn outputs(self) -> Vector {
        let at = self.state;
        (self.mechanism).outputs(&at.coordinates, &at.inputs, &at.design)
    }
}

/// Compares the answers of a mechanism with those of the same mechanism with one and with two more coordinates of each
/// component of its flexible bodies.
///
/// The modes that oscillate are compared in the order of their frequencies. More coordinates lower these where nothing is
/// damped, so that each has its counterpart; where two frequencies cross, damping ratios may be compared with those of
/// the other.
#[must_use]
pub fn convergence(declared: Solved<'_>, refined: [Solved<'_>; 2]) -> Convergence {
    let mut changes = of_modes(declared, refined);
    changes.extend(of_outputs(declared, refined));
    Convergence {
        changes,
        without_peaks: None,
        inputs: declared.state.inputs.clone(),
        description: declared.state.description.clone(),
    }
}

fn of_modes(declared: Solved<'_>, refined: [Solved<'_>; 2]) -> Vec<Change> {
    let refined = refined.map(Solved::oscillating);
    let mut changes = Vec::new();
    for (k, (mode, eigenmode)) in declared.oscillating().into_iter().enumerate() {
        let damped = matches!(eigenmode.behaviour, Behaviour::Damped(_) | Behaviour::Flutter(_));
        let ratio = damped.then_some(Quantity::DampingRatio);
        for quantity in [Quantity::Frequency].into_iter().chain(ratio) {
            let Some(value) = quantity.of(eigenmode) else {
                continue;
            };
            let others = (refined.each_ref()).map(|all| quantity.of(all.get(k)?.1));
            let answer = Response::Mode { mode, quantity };
            changes.push(change(answer, value, others));
        }
    }
    changes
}

fn of_outputs(declared: Solved<'_>, refined: [Solved<'_>; 2]) -> Vec<Change> {
    let refined = refined.map(Solved::outputs);
    let changes = declared.outputs().into_iter().enumerate().map(|(k, value)| {
        let others = refined.each_ref().map(|all| all.get(k).copied());
        change(Response::Output(Output::new(k)), value, others)
    });
    changes.collect()
}

fn change(answer: Response, value: f64, others: [Option<f64>; 2]) -> Change {
    Change { answer, value, relative: others.map(|other| Some(relative(value, other?))) }
}

/// The difference of two values relative to the larger.
fn relative(from: f64, to: f64) -> f64 {
    let size = largest([from, to]);
    match unless_rounding(to - from, size) {
        0.0 => 0.0,
        difference => difference / size,
    }
}
