//! Line sampling (Koutsourelakis, Pradlwarter and Schuëller 2004, *Reliability of structures in high dimensions, part I*,
//! Probabilistic Engineering Mechanics 19): samples are drawn across a direction, and the probability along it is
//! computed, from every place where the limit state changes its sign.
//!
//! Each line gives an unbiased estimate, whatever its direction. A linear limit or a single variable takes one line; thin
//! layers of failure, far regions and jumps cost no more than a plane.

mod scan;

use super::limit_state::LimitState;
use super::random::NormalSamples;
use super::sampling::Estimate;
use super::vector::{add_scaled, dot, unit};
use crate::Error;

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
        Self {
            seed: 1,
            stream: 0,
            evaluations: 10_000,
            coefficient_of_variation: 0.02,
            reach: 8.0,
        }
    }
}

/// Number of points at which a line is evaluated first; a single line bears the whole result and takes more.
const POINTS: u64 = 33;
const POINTS_OF_ONE: u64 = 257;
/// Fewer lines say nothing about their scatter.
const FEWEST: u64 = 32;
/// The probability must come from at least as many lines as this, weighted by what they contribute.
const CONTRIBUTING: f64 = 10.0;

/// A line: the probabilities along it, given its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Probability of failure.
    pub fails: f64,
    /// Probability that the limit state has no value.
    pub without_value: f64,
    /// Number of evaluations of the limit state.
    pub evaluations: u64,
}

/// A failure probability estimated from lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LineProbability {
    /// Failure probability. Points without a value do not count as failures.
    pub probability: Estimate,
    /// Probability that the limit state has no value.
    pub without_value: Estimate,
    /// Whether a single variable matters, or enough lines contribute for the standard error to be meaningful.
    pub settled: bool,
    /// Whether, moreover, the target coefficient of variation was reached.
    pub reached: bool,
    /// Number of lines.
    pub lines: u64,
    /// Number of evaluations of the limit state.
    pub evaluations: u64,
}

/// Draws lines, each of which depends only on seed, stream and its number.
///
/// A value of the limit state may be infinite: it then tells which side a point is on, but not how far it is from the
/// limit.
#[derive(Clone, Debug)]
pub struct LineSampler {
    settings: LineSettings,
    directions: Vec<Vec<f64>>,
    dimension: usize,
    /// The variables that matter.
    variables: Vec<usize>,
}

impl LineSampler {
    /// Lines along each of these directions in turn, in those of the `dimension` variables of which the limit state is a
    /// function; if no direction is given, along the variables.
    ///
    /// # Errors
    ///
    /// If no variable is given, or if a setting is invalid.
    pub fn new(
        dimension: usize,
        variables: &[usize],
        directions: &[Vec<f64>],
        settings: &LineSettings,
    ) -> Result<Self, Error> {
        let wrong = |setting, reason: String| Err(Error::Setting { setting, reason });
        if variables.is_empty() || variables.iter().any(|k| *k >= dimension) {
            return wrong("variables", format!("{variables:?} of {dimension}"));
        }
        if !(settings.reach > 0.0 && settings.reach.is_finite()) {
            let reason = format!("{} is not positive and finite", settings.reach);
            return wrong("reach", reason);
        }
        let wished = settings.coefficient_of_variation;
        if !(wished >= 0.0 && wished.is_finite()) {
            return wrong(
                "coefficient_of_variation",
                format!("{wished} is negative or not finite"),
            );
        }
        let within = |direction: &Vec<f64>| {
            let mut own = vec![0.0; dimension];
            for &k in variables {
                own[k] = *direction.get(k)?;
            }
            unit(&own)
        };
        let mut found: Vec<Vec<f64>> = directions.iter().filter_map(within).collect();
        if found.is_empty() {
            let axis = |k: &usize| {
                let mut own = vec![0.0; dimension];
                own[*k] = 1.0;
                own
            };
            found = variables.iter().map(axis).collect();
        }
        Ok(Self {
            settings: settings.clone(),
            directions: found,
            dimension,
            variables: variables.to_vec(),
        })
    }

    /// Line number `index` through a limit state.
    pub fn line<L: LimitState>(&self, limit: &L, index: u64) -> Line {
        let LineSettings {
            seed,
            stream,
            reach,
            evaluations,
            ..
        } = self.settings;
        let direction = &self.directions[(index % self.directions.len() as u64) as usize];
        let mut across = vec![0.0; self.dimension];
        let alone = self.variables.len() == 1;
        if !alone {
            let mut samples = NormalSamples::new(seed, stream, index, self.variables.len());
            for (k, z) in self.variables.iter().zip(samples.next_sample()) {
                across[*k] = *z;
            }
            let along = dot(&across, direction);
            across = add_scaled(&across, -along, direction);
        }
        let value = |s: f64| {
            let found = limit.value(&add_scaled(&across, s, direction));
            found.unwrap_or(f64::NAN)
        };
        let points = match alone {
            true => (evaluations / 2).clamp(POINTS, POINTS_OF_ONE),
            false => POINTS,
        };
        scan::scan(value, reach, points)
    }

    /// The estimate from lines.
    pub fn estimate(&self, lines: &[Line]) -> LineProbability {
        let mean = |of: fn(&Line) -> f64| {
            let n = lines.len() as f64;
            let value = lines.iter().map(of).sum::<f64>() / n;
            let squares = lines.iter().map(|line| (of(line) - value).powi(2));
            let variance = squares.sum::<f64>() / (n - 1.0).max(1.0);
            Estimate {
                value,
                standard_error: (variance / n).sqrt(),
            }
        };
        let probability = mean(|line| line.fails);
        let largest = lines
            .iter()
            .fold(0.0_f64, |most, line| most.max(line.fails));
        let [sum, squares] = [1, 2].map(|power| {
            let parts = lines.iter().map(|line| (line.fails / largest).powi(power));
            parts.sum::<f64>()
        });
        let wished = self.settings.coefficient_of_variation * probability.value;
        let spread = lines.len() as u64 >= FEWEST && sum * sum >= CONTRIBUTING * squares;
        let settled = self.variables.len() == 1 || spread;
        LineProbability {
            settled,
            reached: settled && probability.standard_error <= wished,
            probability,
            without_value: mean(|line| line.without_value),
            lines: lines.len() as u64,
            evaluations: lines.iter().map(|line| line.evaluations).sum(),
        }
    }

    /// Whether further lines are worth drawing.
    pub fn goes_on(&self, found: &LineProbability) -> bool {
        !found.reached && found.evaluations < self.settings.evaluations
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
        let mut lines = vec![self.line(limit, 0)];
        loop {
            let found = self.estimate(&lines);
            if !self.goes_on(&found) {
                return found;
            }
            lines.push(self.line(limit, lines.len() as u64));
        }
    }
}
