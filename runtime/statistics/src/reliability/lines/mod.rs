//! Line sampling (Koutsourelakis, Pradlwarter and Schuëller 2004, *Reliability of structures in high dimensions, part I*,
//! Probabilistic Engineering Mechanics 19): samples are drawn across a direction, and the probability along it is
//! computed, from every place where the limit state changes its sign.
//!
//! A single variable takes one line; thin layers of failure, far regions and jumps cost no more than a plane. Lines farther
//! out than samples lie are tried first: they show how far failure is along the directions in which it is expected, and
//! others in which nobody expected it. Lines then run along these directions and, one of four, along a variable; each
//! point counts with the density of all lines, so the sum is unbiased, whatever the directions. Failure, its opposite and
//! what has no value are shares of the same lines, so they sum to one. Where plain samples scatter less for what they cost,
//! because failure is no rarer than its opposite or lies on all sides, they decide.

mod explore;
mod line;
mod mixture;
mod scan;

pub use line::Direction;

use nalgebra::{DMatrix, DVector};

use super::limit_state::LimitState;
use super::random::NormalSamples;
use super::sampling::Estimate;
use super::vector::{add_scaled, dot};
use crate::Error;
use line::Line;
use mixture::Mixture;

/// Which lines to draw and when to stop.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LineSettings {
    /// Seed of the lines.
    pub seed: u64,
    /// Stream; lines of different streams of a seed are independent.
    pub stream: u64,
    /// Number of evaluations of the limit state after which no further line is drawn.
    pub evaluations: u64,
    /// Target coefficient of variation of the probability.
    pub coefficient_of_variation: f64,
    /// Distance from the origin up to which lines are searched, in standard deviations.
    pub reach: f64,
}

impl Default for LineSettings {
    fn default() -> Self {
        Self { seed: 1, stream: 0, evaluations: 10_000, coefficient_of_variation: 0.02, reach: 8.0 }
    }
}

/// A single line bears the whole result and takes this many points at first.
const POINTS_OF_ONE: u64 = 257;
/// Standard deviations between the points of a line at first, and lines of a round along directions in which failure is
/// expected.
const SPACING: f64 = 0.5;
const ROUND: usize = 24;
/// The same where fewer evaluations than this are allowed.
const FEW: u64 = 5_000;
const COARSE_SPACING: f64 = 1.0;
const COARSE_ROUND: usize = 8;
/// Fewer lines say nothing about their scatter.
const FEWEST: u64 = 32;
/// Fewer do not end it: a rare line that contributes much may not be among them yet, and the scatter then is too small.
const MANY: u64 = 128;
/// The error is looked at again after so small a part more.
const SELDOM: u64 = 4;
/// Fewest plain samples that fail, or do not, and how much less than lines they must scatter for what they cost.
const ENOUGH: f64 = 100.0;
const DOUBT: f64 = 4.0;
/// Numbers of plain samples, which no line takes, start here.
const PLAIN: u64 = 1 << 59;
/// The probability must come from at least as many lines as this, weighted by what they contribute.
const CONTRIBUTING: f64 = 10.0;

/// A share of the probability that lines may not have met, in lines.
const UNMET: f64 = 0.5;
/// Relative error of a probability by the place of a jump, which is found to a tenth of a millionth of a standard deviation.
const PLACED: f64 = 1e-6;
/// Smallest singular value, relative to values of at most one, of quantities that are not combinations of each other.
const DEPENDENT: f64 = 1e-10;

/// A failure probability estimated from lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LineProbability {
    /// Failure probability. Points without a value do not count as failures.
    pub probability: Estimate,
    /// Probability that the limit state has no value.
    pub without_value: Estimate,
    /// Whether a single variable matters, or enough lines or samples contribute for the standard error to be meaningful.
    pub settled: bool,
    /// Whether, moreover, the target coefficient of variation was reached.
    pub reached: bool,
    /// Number of lines; none if plain samples tell more.
    pub lines: u64,
    /// Number of evaluations of the limit state.
    pub evaluations: u64,
}

/// Explores a limit state, then draws lines, each of which depends only on seed, stream, its region and its number.
///
/// A value of the limit state may be infinite: it then tells which side a point is on, but not how far it is from the
/// limit.
#[derive(Clone, Debug)]
pub struct LineSampler {
    settings: LineSettings,
    dimension: usize,
    /// The variables that matter.
    variables: Vec<usize>,
    mixture: Mixture,
}

impl LineSampler {
    /// Lines along these directions, in those of the `dimension` variables of which the limit state is a function.
    ///
    /// # Errors
    ///
    /// If no variable is given, or if a setting is invalid.
    pub fn new(
        dimension: usize,
        variables: &[usize],
        directions: &[Direction],
        settings: &LineSettings,
    ) -> Result<Self, Error> {
        let wrong = |setting, reason: String| Err(Error::setting(setting, reason));
        if variables.is_empty() || variables.iter().any(|k| *k >= dimension) {
            return wrong("variables", format!("{variables:?} of {dimension}"));
        }
        if !(settings.reach > 0.0 && settings.reach.is_finite()) {
            let reason = format!("{} is not positive and finite", settings.reach);
            return wrong("reach", reason);
        }
        let wished = settings.coefficient_of_variation;
        if !(wished >= 0.0 && wished.is_finite()) {
            return wrong("coefficient_of_variation", format!("{wished} is negative or not finite"));
        }
        Ok(Self {
            settings: settings.clone(),
            dimension,
            variables: variables.to_vec(),
            mixture: Mixture::new(dimension, (variables, variables), directions, round(settings)),
        })
    }

    fn alone(&self) -> bool {
        self.variables.len() == 1
    }

    /// A line of a group of directions through a limit state.
    fn line<L: LimitState>(&self, limit: &L, group: usize, samples: &mut NormalSamples) -> Line {
        let (choice, sample) = samples.next_with_choice();
        let direction = self.mixture.pick(group, choice);
        let across = if self.alone() { vec![0.0; self.dimension] } else { self.across(sample, direction) };
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        let value = Self::along(limit, &across, direction);
        let scanned = scan::scan(value, everywhere, self.settings.reach, self.spacing());
        self.mixture.weigh(group, &scanned, &across, direction)
    }

    /// A point across a direction, from a value of each variable that matters.
    fn across(&self, sample: &[f64], direction: &[f64]) -> Vec<f64> {
        let mut point = vec![0.0; self.dimension];
        for (k, z) in self.variables.iter().zip(sample) {
            point[*k] = *z;
        }
        add_scaled(&point, -dot(&point, direction), direction)
    }

    /// The values of a limit state along a line; NaN where it has none.
    fn along<L: LimitState>(limit: &L, across: &[f64], direction: &[f64]) -> impl Fn(f64) -> f64 {
        move |s| limit.value(&add_scaled(across, s, direction)).unwrap_or(f64::NAN)
    }

    /// Between the points of a line at first. A single line takes as many points as half of the evaluations allow.
    fn spacing(&self) -> f64 {
        if !self.alone() {
            return if self.settings.evaluations < FEW { COARSE_SPACING } else { SPACING };
        }
        let points = (self.settings.evaluations / 2).clamp(33, POINTS_OF_ONE);
        2.0 * self.settings.reach / (points - 1) as f64
    }

    /// The estimate from whole rounds of lines.
    fn estimate(&self, lines: &[Line]) -> LineProbability {
        let probability = estimate(lines, |line| line.fails);
        let without_value = estimate(lines, |line| line.without_value);
        // What is rarer, failure or its opposite, and whether enough lines meet it for their scatter to be meaningful.
        let safe = |line: &Line| 1.0 + line.known[0] - line.without_value - line.fails;
        let opposite = 1.0 - without_value.value - probability.value;
        let (rarer, part): (Vec<f64>, f64) = if probability.value <= opposite {
            (lines.iter().map(|line| line.fails).collect(), probability.value)
        } else {
            (lines.iter().map(safe).collect(), opposite)
        };
        let (sum, squares) = (rarer.iter().sum::<f64>(), dot(&rarer, &rarer));
        let enough = lines.len() as u64 >= FEWEST && part > 0.0;
        let settled = self.alone() || enough && sum * sum >= CONTRIBUTING * squares;
        let many = self.alone() || lines.len() as u64 >= MANY;
        let unmet = if self.alone() { PLACED * part } else { UNMET * part / lines.len() as f64 };
        let probability = Estimate { standard_error: probability.standard_error.hypot(unmet), ..probability };
        LineProbability {
            settled,
            reached: settled && many && probability.standard_error <= self.settings.coefficient_of_variation * part,
            probability,
            without_value,
            lines: lines.len() as u64,
            evaluations: evaluations(lines),
        }
    }

    /// About how many evaluations the fewest lines take.
    pub fn fewest(&self) -> u64 {
        let lines = if self.alone() {
            1
        } else {
            let round = self.mixture.groups().count() as u64;
            FEWEST.div_ceil(round).max(2) * round
        };
        (lines as f64 * 2.0 * self.settings.reach / self.spacing()) as u64
    }

    /// Draws lines until the target coefficient of variation or the number of evaluations is reached.
    ///
    /// # Examples
    ///
    /// ```
    /// use core::convert::Infallible;
    /// use eigentol_statistics::normal::cdf;
    /// use eigentol_statistics::reliability::lines::{LineSampler, LineSettings};
    /// use eigentol_statistics::reliability::{LimitFunction, LimitValue};
    ///
    /// // A thin layer: failure between 2 and 2.001.
    /// let limit = LimitFunction::new(1, |z: &[f64]| {
    ///     let value = (z[0] - 2.0005).abs() - 0.0005;
    ///     Ok::<_, Infallible>(LimitValue { value, gradient: vec![0.0] })
    /// });
    /// let sampler = LineSampler::new(1, &[0], &[], &LineSettings::default())?;
    /// let found = sampler.run(&limit);
    /// let exact = cdf(-2.0) - cdf(-2.001);
    /// assert!(found.reached && (found.probability.value / exact - 1.0).abs() < 1e-4);
    /// # Ok::<(), eigentol_statistics::Error>(())
    /// ```
    pub fn run<L: LimitState>(&self, limit: &L) -> LineProbability {
        let (sampler, spent) = self.explored(limit);
        let evaluations = sampler.settings.evaluations.saturating_sub(spent);
        let mut line_probability = sampler.draw(limit, evaluations);
        line_probability.evaluations += spent;
        line_probability
    }

    /// The same along the directions in which failures were found, if finding them leaves enough evaluations; and the
    /// number of evaluations that it took.
    fn explored<L: LimitState>(&self, limit: &L) -> (Self, u64) {
        let left = self.settings.evaluations.saturating_sub(self.fewest());
        if self.alone() || 2 * self.cost_of_exploring() > left {
            return (self.clone(), 0);
        }
        let (directions, explored, spent) = self.explore(limit);
        let variables = (&self.variables[..], &explored[..]);
        let sampler = Self {
            mixture: Mixture::new(self.dimension, variables, &directions, round(&self.settings)),
            ..self.clone()
        };
        (sampler, spent)
    }

    fn draw<L: LimitState>(&self, limit: &L, most: u64) -> LineProbability {
        let LineSettings { seed, stream, .. } = self.settings;
        let mut samples = NormalSamples::new(seed, stream, 0, self.variables.len());
        let mut lines = Vec::new();
        let (mut spent, mut due) = (0, 2);
        for round in 1.. {
            let from = lines.len();
            let groups = self.mixture.groups().take(if self.alone() { 1 } else { usize::MAX });
            lines.extend(groups.map(|group| self.line(limit, group, &mut samples)));
            spent += evaluations(&lines[from..]);
            let last = spent + spent / round > most || self.alone();
            if last || round >= due && lines.len() as u64 >= FEWEST {
                let estimate = self.estimate(&lines);
                if self.tells_less_than_samples(&estimate) {
                    return self.plain(limit, most.saturating_sub(spent), estimate);
                }
                if last || estimate.reached {
                    return estimate;
                }
                due = round + (round / SELDOM).max(1);
            }
        }
        self.estimate(&lines)
    }

    /// Whether plain samples, of which enough would fail and enough would not, scatter less for what they cost than lines,
    /// whose scatter is itself known from few of them.
    fn tells_less_than_samples(&self, found: &LineProbability) -> bool {
        let Estimate { value, standard_error } = found.probability;
        let rarer = value.min(1.0 - value - found.without_value.value);
        let spread = standard_error * standard_error * found.evaluations as f64;
        !self.alone() && rarer * self.settings.evaluations as f64 >= ENOUGH && DOUBT * spread > value * (1.0 - value)
    }

    /// The estimate from plain samples.
    fn plain<L: LimitState>(&self, limit: &L, most: u64, lines: LineProbability) -> LineProbability {
        let LineSettings { seed, stream, .. } = self.settings;
        let mut samples = NormalSamples::new(seed, stream, PLAIN, self.variables.len());
        let (mut fails, mut without_value) = (0.0, 0.0);
        let origin = vec![0.0; self.dimension];
        for drawn in 1.. {
            let point = self.across(samples.next_sample(), &origin);
            match limit.value(&point).unwrap_or(f64::NAN) {
                value if value.is_nan() => without_value += 1.0,
                value if value <= 0.0 => fails += 1.0,
                _ => {}
            }
            let count = drawn as f64;
            let share = |number: f64| Estimate {
                value: number / count,
                standard_error: (number * (count - number) / count).sqrt() / count,
            };
            let probability = share(fails);
            let rarer = fails.min(count - fails - without_value);
            let settled = rarer >= ENOUGH;
            let wished = self.settings.coefficient_of_variation * rarer / count;
            let reached = settled && probability.standard_error <= wished;
            if reached || drawn >= most {
                return LineProbability {
                    settled,
                    reached,
                    probability,
                    without_value: share(without_value),
                    lines: 0,
                    evaluations: lines.evaluations + drawn,
                };
            }
        }
        lines
    }
}

/// Lines of a round along the directions in which failure is expected.
fn round(settings: &LineSettings) -> usize {
    if settings.evaluations < FEW { COARSE_ROUND } else { ROUND }
}

/// The mean over lines of whole rounds, less what their scatter shares with quantities whose means are known to be zero
/// (control variates: Owen 2013, *Monte Carlo theory, methods and examples*, section 8.9). Its error is the scatter that
/// is left within each group of directions.
fn estimate(lines: &[Line], of: fn(&Line) -> f64) -> Estimate {
    let largest = |of: &dyn Fn(&Line) -> f64| lines.iter().map(of).fold(0.0, |a: f64, b| a.max(b.abs()));
    let scale = largest(&of);
    if scale == 0.0 {
        return Estimate { value: 0.0, standard_error: 0.0 };
    }
    let count = lines.len() as f64;
    let groups: Vec<Vec<usize>> = (0..=lines.iter().map(|line| line.group).max().unwrap_or(0))
        .map(|group| (0..lines.len()).filter(|k| lines[*k].group == group).collect())
        .collect();
    let off_mean = |values: &[f64]| {
        let mut off = values.to_vec();
        for group in &groups {
            let mean = group.iter().map(|k| values[*k]).sum::<f64>() / group.len() as f64;
            group.iter().for_each(|k| off[*k] -= mean);
        }
        off
    };
    let mut values: Vec<f64> = lines.iter().map(|line| of(line) / scale).collect();
    let known: Vec<Vec<f64>> = (0..lines[0].known.len())
        .map(|j| {
            let scale = largest(&|line| line.known[j]).max(f64::MIN_POSITIVE);
            lines.iter().map(|line| line.known[j] / scale).collect()
        })
        .collect();
    let columns: Vec<DVector<f64>> = known.iter().map(|x| off_mean(x).into()).collect();
    let shared = DMatrix::from_columns(&columns).svd(true, true);
    let shared = shared.solve(&DVector::from(off_mean(&values)), DEPENDENT);
    if let Ok(factors) = shared {
        for (known, factor) in known.iter().zip(&factors) {
            values.iter_mut().zip(known).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let off = off_mean(&values);
    let squares = groups.iter().map(|group| {
        let squares: f64 = group.iter().map(|k| off[*k].powi(2)).sum();
        let size = group.len() as f64;
        squares * size / (size - 3.0).max(1.0)
    });
    let free = (count - known.len() as f64).max(1.0);
    Estimate {
        value: (scale * values.iter().sum::<f64>() / count).clamp(0.0, 1.0),
        standard_error: scale * (squares.sum::<f64>() * count / free).sqrt() / count,
    }
}

fn evaluations(lines: &[Line]) -> u64 {
    lines.iter().map(|line| line.evaluations).sum()
}
