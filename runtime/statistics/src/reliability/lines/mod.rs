//! Line sampling (Koutsourelakis, Pradlwarter and Schuëller 2004, *Reliability of structures in high dimensions, part I*,
//! Probabilistic Engineering Mechanics 19): samples are drawn across a direction, and the probability along it is
//! computed, from every place where the limit state changes its sign.
//!
//! A single variable takes one line; thin layers of failure, far regions and jumps cost no more than a plane. Lines farther
//! out than samples lie are tried first: they show how far failure is along the directions in which it is expected, and
//! others in which nobody expected it. The space is then divided among these directions and the variables, each of which
//! answers for what lies farthest along it, so the sum is unbiased, whatever the directions.

mod explore;
mod line;
mod regions;
mod scan;

pub use line::Direction;

use super::limit_state::LimitState;
use super::random::NormalSamples;
use super::sampling::Estimate;
use super::vector::{add_scaled, dot};
use crate::Error;
use line::Line;
use regions::Regions;

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

/// A single line bears the whole result and takes this many points at first.
const POINTS_OF_ONE: u64 = 257;
/// Standard deviations between the points of a line at first.
const SPACING: f64 = 0.5;
/// Fewer lines say nothing about their scatter: in all, and along a direction of several.
const FEWEST: usize = 32;
const FEWEST_OF_SEVERAL: usize = 12;
/// Lines along a variable along which nothing is expected.
const FEWEST_EXPLORING: usize = 4;
/// Lines drawn together in the region that needs them most.
const MORE: usize = 8;
/// The share of all lines that is divided evenly among the regions, whatever they have shown.
const EVENLY: f64 = 0.25;
/// The probability must come from at least as many lines as this, weighted by what they contribute, but for a share.
const CONTRIBUTING: f64 = 10.0;
const SHARE: f64 = 0.05;

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
    regions: Regions,
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
        Ok(Self {
            settings: settings.clone(),
            dimension,
            variables: variables.to_vec(),
            regions: Regions::new(dimension, variables, directions),
        })
    }

    fn alone(&self) -> bool {
        self.variables.len() == 1
    }

    /// Number of regions into which the directions divide the space.
    fn regions(&self) -> usize {
        self.regions.count()
    }

    /// Line number `index` of a region through a limit state.
    fn line<L: LimitState>(&self, limit: &L, region: usize, index: u64) -> Line {
        let LineSettings {
            seed,
            stream,
            reach,
            ..
        } = self.settings;
        let direction = self.regions.direction(region);
        let across = match self.alone() {
            true => vec![0.0; self.dimension],
            false => {
                let number = index * self.regions() as u64 + region as u64;
                let mut samples = NormalSamples::new(seed, stream, number, self.variables.len());
                self.across(samples.next_sample(), direction)
            }
        };
        let value = Self::along(limit, &across, direction);
        let spacing = self.spacing();
        let stretches = match self.alone() {
            true => vec![(f64::NEG_INFINITY, f64::INFINITY)],
            false => self.regions.stretches(region, &across).to_vec(),
        };
        let mut line = Line::default();
        for stretch in stretches {
            let segment = scan::scan(&value, stretch, reach, spacing).line;
            line.fails += segment.fails;
            line.without_value += segment.without_value;
            line.evaluations += segment.evaluations;
        }
        line
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
        move |s| {
            let value = limit.value(&add_scaled(across, s, direction));
            value.unwrap_or(f64::NAN)
        }
    }

    /// Between the points of a line at first. A single line takes as many points as half of the evaluations allow.
    fn spacing(&self) -> f64 {
        if !self.alone() {
            return SPACING;
        }
        let points = (self.settings.evaluations / 2).clamp(33, POINTS_OF_ONE);
        2.0 * self.settings.reach / (points - 1) as f64
    }

    /// The estimate from lines of each region.
    fn estimate(&self, lines: &[Vec<Line>]) -> LineProbability {
        let all = |of: fn(&Line) -> f64| -> Estimate {
            let each = lines.iter().map(|line| mean(line, of));
            let (value, variance) = each.fold((0.0, 0.0), |(value, variance), item| {
                (
                    value + item.value,
                    variance + item.standard_error * item.standard_error,
                )
            });
            Estimate {
                value,
                standard_error: variance.sqrt(),
            }
        };
        let probability = all(|line| line.fails);
        let count: usize = lines.iter().map(Vec::len).sum();
        let enough = count >= FEWEST && lines.iter().all(|line| !line.is_empty());
        let settled = self.alone() || enough && probability.value > 0.0 && is_certain(lines);
        let wished = self.settings.coefficient_of_variation * probability.value;
        LineProbability {
            settled,
            reached: settled && probability.standard_error <= wished,
            probability,
            without_value: all(|line| line.without_value),
            lines: count as u64,
            evaluations: evaluations(lines),
        }
    }

    /// How many lines a region takes at first.
    fn first(&self, region: usize) -> usize {
        let (count, expected) = (self.regions(), self.regions.expected());
        match region < expected {
            _ if self.alone() => 1,
            true if expected == 1 => FEWEST,
            true => FEWEST_OF_SEVERAL,
            false => (FEWEST / count).max(FEWEST_EXPLORING),
        }
    }

    /// About how many evaluations the first lines take.
    pub fn fewest(&self) -> u64 {
        let lines: usize = (0..self.regions()).map(|region| self.first(region)).sum();
        (lines as f64 * 2.0 * self.settings.reach / self.spacing()) as u64
    }

    /// The region that takes the next lines: one that has had less than its share; or one whose scatter is not known
    /// yet, if that matters; or the one where they reduce the variance most, for what they cost.
    fn neediest(lines: &[Vec<Line>]) -> usize {
        let most = |need: &dyn Fn(&Vec<Line>) -> f64| {
            let needs = lines.iter().map(need).enumerate();
            let (region, need) = needs
                .max_by(|(_, a), (_, b)| a.total_cmp(b))
                .unwrap_or_default();
            (need > 0.0).then_some(region)
        };
        let count: usize = lines.iter().map(Vec::len).sum();
        let share = EVENLY * count as f64 / lines.len() as f64;
        let doubtful = !is_certain(lines);
        let uncertain = |lines: &Vec<Line>| if doubtful { uncertain(lines) } else { 0.0 };
        let scatter = |lines: &Vec<Line>| {
            let error = failure(lines).standard_error;
            error / (evaluations(core::slice::from_ref(lines)) as f64).sqrt()
        };
        let lacking = |lines: &Vec<Line>| share - lines.len() as f64;
        (most(&lacking).or_else(|| most(&uncertain)))
            .or_else(|| most(&scatter))
            .unwrap_or(0)
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
        let (directions, spent) = self.explore(limit);
        let sampler = Self {
            regions: Regions::new(self.dimension, &self.variables, &directions),
            ..self.clone()
        };
        (sampler, spent)
    }

    fn draw<L: LimitState>(&self, limit: &L, most: u64) -> LineProbability {
        let mut lines = vec![Vec::new(); self.regions()];
        let draw = |lines: &mut Vec<Vec<Line>>, region: usize, count: usize| {
            for _ in 0..count {
                if evaluations(lines) < most {
                    let index = lines[region].len() as u64;
                    lines[region].push(self.line(limit, region, index));
                }
            }
        };
        for region in 0..self.regions() {
            draw(&mut lines, region, self.first(region));
        }
        loop {
            let estimate = self.estimate(&lines);
            if estimate.reached || estimate.evaluations >= most || self.alone() {
                return estimate;
            }
            let region = Self::neediest(&lines);
            draw(&mut lines, region, MORE);
        }
    }
}

/// Mean over lines.
fn mean(lines: &[Line], of: fn(&Line) -> f64) -> Estimate {
    if lines.is_empty() {
        return Estimate {
            value: 0.0,
            standard_error: 0.0,
        };
    }
    let n = lines.len() as f64;
    let value = lines.iter().map(of).sum::<f64>() / n;
    let squares = lines.iter().map(|line| (of(line) - value).powi(2));
    let variance = squares.sum::<f64>() / (n - 1.0).max(1.0);
    Estimate {
        value,
        standard_error: (variance / n).sqrt(),
    }
}

/// The probability in a region, if its scatter is not known.
fn uncertain(lines: &[Line]) -> f64 {
    match contribute(lines) {
        true => 0.0,
        false => failure(lines).value,
    }
}

/// Whether the scatter is known of all that matters.
fn is_certain(lines: &[Vec<Line>]) -> bool {
    let all = lines.iter().map(|line| failure(line).value).sum::<f64>();
    lines.iter().map(|line| uncertain(line)).sum::<f64>() <= SHARE * all
}

fn failure(lines: &[Line]) -> Estimate {
    mean(lines, |line| line.fails)
}

/// Whether enough lines contribute for their scatter to be meaningful.
fn contribute(lines: &[Line]) -> bool {
    let largest = lines
        .iter()
        .fold(0.0_f64, |most, line| most.max(line.fails));
    if largest == 0.0 {
        return true;
    }
    let [sum, squares] = [1, 2].map(|power| {
        let parts = lines.iter().map(|line| (line.fails / largest).powi(power));
        parts.sum::<f64>()
    });
    sum * sum >= CONTRIBUTING * squares
}

fn evaluations(lines: &[Vec<Line>]) -> u64 {
    lines.iter().flatten().map(|line| line.evaluations).sum()
}
