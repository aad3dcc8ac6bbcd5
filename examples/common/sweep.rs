//! The sweep over the speed: equilibrium, frequencies, first-order and sampled spread at every speed, as plain numbers
//! for tables, files and figures.

use eigentol::sensitivity::{sensitivities, sensitivities_by_finite_difference};
use eigentol::sweep::SweepPoint;
use eigentol::tolerance::{Sampling, first_order, monte_carlo};
use eigentol::{
    Equilibrium, Error, FirstOrder, Kernels, Mechanism, Modes, MonteCarlo, Study, Text, Tolerances,
};

use crate::Question;

/// Relative step of the central differences.
const STEP: f64 = 5e-6;

/// All rows of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The question it answers.
    pub question: Question,
    /// Names of the varied design variables.
    pub variables: Vec<Text>,
    /// Number of modes.
    pub modes: usize,
    /// Monte Carlo samples at each speed and tolerance; 0 without Monte Carlo.
    pub samples: usize,
    /// One row for each speed, ascending.
    pub rows: Vec<Row>,
}

/// Results at one speed; undefined numbers (no frequency, because a mode diverges) are `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Speed, rad/s.
    pub speed: f64,
    /// The outputs of the mechanism: angles of the bars from the axis, rad.
    pub angles: Vec<Option<f64>>,
    /// Frequencies, rad/s.
    pub frequencies: Vec<Option<f64>>,
    /// One entry for each tolerance.
    pub spreads: Vec<Spread>,
    /// The errors at this speed.
    pub troubles: Vec<String>,
}

/// The effect of one tolerance at one speed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spread {
    /// First order, by mode; its mean is the nominal frequency.
    pub first_order: Vec<Moments>,
    /// First order from the paper's central differences, by mode.
    pub differences: Vec<Moments>,
    /// Monte Carlo, by mode, over the samples where the mode oscillates.
    pub sampled: Vec<Moments>,
    /// Share of each varied variable in the variance, by mode.
    pub shares: Vec<Vec<f64>>,
    /// Distance to the critical state in standard deviations; `None` if infinite.
    pub distance: Option<f64>,
    /// Whether first order can be trusted here.
    pub trusted: bool,
    /// Number of samples that are not stable, whatever the reason; `None` without Monte Carlo.
    pub unstable: Option<usize>,
}

/// Mean and standard deviation of a frequency, rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Mean.
    pub mean: Option<f64>,
    /// Standard deviation.
    pub sigma: Option<f64>,
}

impl Sweep {
    /// Answers `question` at `speeds`, with `sampling` also by Monte Carlo.
    ///
    /// # Errors
    /// Only errors that concern every point; a point that fails is reported in its row.
    pub fn run<M: Mechanism>(
        study: &Study<M>,
        question: &Question,
        speeds: &[f64],
        sampling: Option<&Sampling<'_>>,
    ) -> Result<Self, Error> {
        let points = study.sweep(question.input(), speeds)?.points;
        let rows = points
            .iter()
            .zip(0..)
            .map(|(point, place)| row(study, question, (point, place), sampling));
        let design = study.description().design.clone();
        Ok(Self {
            question: question.clone(),
            variables: question
                .varied
                .iter()
                .map(|variable| design[variable.index()].name.clone())
                .collect(),
            modes: study.start_values().len(),
            samples: sampling.map_or(0, |sampling| sampling.samples),
            rows: rows.collect(),
        })
    }
}

fn row<M: Mechanism>(
    study: &Study<M>,
    question: &Question,
    (point, place): (&SweepPoint, u64),
    sampling: Option<&Sampling<'_>>,
) -> Row {
    let (mechanism, n) = (study.mechanism(), study.start_values().len());
    let kernels: &dyn Kernels = mechanism;
    let mut row = Row {
        speed: point.value,
        angles: vec![None; study.description().outputs.len()],
        frequencies: vec![None; n],
        spreads: vec![Spread::none(n); question.levels.len()],
        troubles: Vec::new(),
    };
    let state = match &point.equilibrium {
        Ok(state) => state,
        Err(error) => {
            row.troubles.push(error.to_string());
            return row;
        }
    };
    if !state.stability.holds() {
        row.troubles.push(format!(
            "the equilibrium is not stable: {:?}",
            state.stability
        ));
    }
    let angles = kernels.outputs(&state.coordinates, &state.inputs, &state.design);
    row.angles = angles.iter().copied().map(finite).collect();
    match &point.modes {
        Ok(modes) => {
            row.frequencies = modes.frequencies().to_vec();
            // Every speed and tolerance draws its own samples: shared samples would make random error look systematic.
            let first_stream = place * question.levels.len() as u64;
            for ((k, &level), stream) in question.levels.iter().enumerate().zip(first_stream..) {
                let sampling = sampling.map(|sampling| sampling.clone().stream(stream));
                let tolerances = question.varied_by(study, level).tolerances();
                let filled = tolerances.and_then(|tolerances| {
                    let at = Place {
                        mechanism,
                        state,
                        modes,
                        tolerances,
                    };
                    row.spreads[k].fill(question, &at, sampling.as_ref())
                });
                if let Err(error) = filled {
                    row.troubles.push(error.to_string());
                }
            }
        }
        Err(error) => row.troubles.push(error.to_string()),
    }
    row.troubles.dedup();
    row
}

/// Where one spread is computed.
struct Place<'a, M> {
    mechanism: &'a M,
    state: &'a Equilibrium,
    modes: &'a Modes,
    tolerances: Tolerances,
}

impl Spread {
    fn none(modes: usize) -> Self {
        Self {
            first_order: vec![Moments::default(); modes],
            differences: vec![Moments::default(); modes],
            sampled: vec![Moments::default(); modes],
            shares: vec![Vec::new(); modes],
            ..Self::default()
        }
    }

    /// Fills in all results, keeping those found before an error. Samples come first because they also exist at an
    /// exactly critical state, which has no derivatives.
    fn fill<M: Mechanism>(
        &mut self,
        question: &Question,
        at: &Place<'_, M>,
        sampling: Option<&Sampling<'_>>,
    ) -> Result<(), Error> {
        let Place {
            mechanism,
            state,
            modes,
            tolerances,
        } = at;
        if let Some(sampling) = sampling {
            self.take_samples(&monte_carlo(
                *mechanism, state, modes, tolerances, sampling,
            )?);
        }
        let slopes = sensitivities(*mechanism, state, modes)?;
        self.take_first_order(question, &first_order(modes, &slopes, tolerances)?);
        let slopes = sensitivities_by_finite_difference(*mechanism, state, modes, STEP)?;
        self.differences = moments(&first_order(modes, &slopes, tolerances)?);
        Ok(())
    }

    fn take_first_order(&mut self, question: &Question, found: &FirstOrder) {
        self.first_order = moments(found);
        self.shares = found
            .modes
            .iter()
            .map(|mode| {
                question
                    .varied
                    .iter()
                    .map(|variable| mode.variance_shares()[variable.index()])
                    .collect()
            })
            .collect();
        self.distance = finite(found.distance_to_critical);
        self.trusted = found.trusted();
    }

    fn take_samples(&mut self, found: &MonteCarlo) {
        self.unstable = Some(found.counts.total() - found.counts.stable);
        self.sampled = found
            .modes
            .iter()
            .map(|mode| Moments {
                mean: mode.as_ref().map(|mode| mode.mean),
                sigma: mode.as_ref().and_then(|mode| mode.sigma),
            })
            .collect();
    }
}

fn moments(found: &FirstOrder) -> Vec<Moments> {
    found
        .modes
        .iter()
        .map(|mode| Moments {
            mean: mode.frequency().and_then(|found| finite(found.mean)),
            sigma: mode.frequency().and_then(|found| finite(found.sigma)),
        })
        .collect()
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
