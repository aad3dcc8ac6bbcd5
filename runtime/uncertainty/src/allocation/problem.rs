//! Cost and reliability as functions of the choices: logarithms of half-widths, which make reciprocal costs convex, and
//! nominal values as fractions of the way between their limits.

use eigentol_statistics::normal;
use eigentol_statistics::reliability::{DesignPoint, failure_regions};

use super::choices::Choices;
use crate::deviations::Deviations;
use crate::requirement::{FormSettings, Limit, LimitAt, Requirements, out_of_reach, slopes_at};
use crate::{Error, Vector};

/// Cost and reliability at one choice.
#[derive(Clone, Debug)]
pub(super) struct Evaluated {
    pub(super) cost: f64,
    pub(super) cost_slopes: Vec<f64>,
    /// One entry per requirement with a limit.
    pub(super) requirements: Vec<Reached>,
}

/// The reliability reached for one requirement.
#[derive(Clone, Debug)]
pub(super) struct Reached {
    pub(super) requirement: usize,
    /// Reliability index; infinite if no design within reach fails.
    pub(super) beta: f64,
    pub(super) slopes: Vec<f64>,
    pub(super) wanted: f64,
}

impl Reached {
    /// The shortfall of the reliability index.
    pub(super) fn shortfall(&self) -> f64 {
        self.wanted - self.beta
    }
}

impl Evaluated {
    /// The requirement with the largest shortfall or the smallest reserve.
    pub(super) fn worst(&self) -> Option<&Reached> {
        let by_shortfall = |a: &&Reached, b: &&Reached| a.shortfall().total_cmp(&b.shortfall());
        self.requirements.iter().max_by(by_shortfall)
    }

    pub(super) fn shortfall(&self) -> f64 {
        self.worst().map_or(f64::NEG_INFINITY, Reached::shortfall)
    }
}

pub(super) struct Problem<'a> {
    pub(super) requirements: &'a Requirements<'a>,
    pub(super) choices: &'a Choices<'a>,
    pub(super) limits: Vec<Limit>,
    pub(super) nominal: Vector,
    pub(super) half_widths: Vector,
    pub(super) search: Search,
}

/// How design points are searched at each choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Search {
    /// Once, from the centre of the distribution: enough where each limit has a single design point.
    Single,
    /// As for the reliability of a design: in all failure regions.
    Thorough,
}

impl Search {
    fn settings(self) -> FormSettings {
        let single = FormSettings { restarts: 0, regions: 1, ..FormSettings::default() };
        FormSettings {
            tolerance: 1e-10,
            ..match self {
                Self::Single => single,
                Self::Thorough => FormSettings::default(),
            }
        }
    }
}

impl Problem<'_> {
    /// The nominal values and half-widths of a choice.
    pub(super) fn design(&self, x: &[f64]) -> (Vector, Vector) {
        let (mut nominal, mut wide) = (self.nominal.clone(), self.half_widths.clone());
        let (logarithms, parts) = x.split_at(self.choices.half_widths.len());
        for (half_width, logarithm) in self.choices.half_widths.iter().zip(logarithms) {
            wide[half_width.variable] = logarithm.exp().clamp(half_width.limits.0, half_width.limits.1);
        }
        for (choice, part) in self.choices.nominals.iter().zip(parts) {
            let (low, high) = choice.limits;
            nominal[choice.variable] = (low + part * (high - low)).clamp(low, high);
        }
        (nominal, wide)
    }

    /// The start of the search, and the bounds of the choices.
    pub(super) fn start(&self) -> (Vec<f64>, Vec<(f64, f64)>) {
        let choices = self.choices.half_widths.iter();
        let mut x: Vec<f64> = choices.clone().map(|choice| self.half_widths[choice.variable].ln()).collect();
        let bounds = choices.map(|choice| (choice.limits.0.ln(), choice.limits.1.ln()));
        let mut bounds: Vec<(f64, f64)> = bounds.collect();
        for nominal in &self.choices.nominals {
            let (low, high) = nominal.limits;
            x.push((self.nominal[nominal.variable] - low) / (high - low));
            bounds.push((0.0, 1.0));
        }
        (x, bounds)
    }

    pub(super) fn evaluate(&self, x: &[f64]) -> Result<Evaluated, Error> {
        let (nominal, wide) = self.design(x);
        let deviations = self.requirements.deviations().moved(&nominal, &wide);
        let (cost, cost_slopes) = self.cost(x.len(), &wide)?;
        let mut reached: Vec<Reached> = Vec::new();
        for (requirement, failure) in self.choices.failure.iter().enumerate() {
            let parts = self
                .limits
                .iter()
                .filter(|limit| limit.requirement == requirement)
                .map(|limit| self.limit(&deviations, &wide, limit));
            let parts: Vec<Vec<(f64, Vec<f64>)>> = parts.collect::<Result<_, _>>()?;
            if !parts.is_empty() {
                let (beta, slopes) = joined(&parts.concat(), x.len());
                reached.push(Reached { requirement, beta, slopes, wanted: -normal::quantile(*failure) });
            }
        }
        Ok(Evaluated { cost, cost_slopes, requirements: reached })
    }

    fn cost(&self, size: usize, wide: &[f64]) -> Result<(f64, Vec<f64>), Error> {
        let (mut sum, mut slopes) = (0.0, vec![0.0; size]);
        for (choice, place) in self.choices.half_widths.iter().zip(&mut slopes) {
            let half_width = wide[choice.variable];
            let (cost, slope) = choice.cost.of(half_width);
            if !(cost.is_finite() && slope.is_finite()) {
                return Err(Error::setting(
                    "cost",
                    format!("half-width {half_width} costs {cost} with derivative {slope}"),
                ));
            }
            sum += cost;
            *place = slope * half_width;
        }
        Ok((sum, slopes))
    }

    /// Reliability index of each failure region of a limit, and its derivatives with respect to the choices.
    fn limit(&self, deviations: &Deviations<'_>, wide: &[f64], limit: &Limit) -> Result<Vec<(f64, Vec<f64>)>, Error> {
        let limit = LimitAt::new(self.requirements.responses(), limit.place, limit.alone, deviations);
        let points = match failure_regions(&limit, &self.search.settings()) {
            Ok(failure_regions) => failure_regions.design_points,
            Err(error) if out_of_reach(&error) => return Ok(Vec::new()),
            Err(error) => return Err(error.into()),
        };
        let part = |at: &DesignPoint| {
            let slopes = slopes_at(&limit, deviations, at)?;
            let half_widths = self
                .choices
                .half_widths
                .iter()
                .map(|half_width| slopes.by_half_width[half_width.variable].beta * wide[half_width.variable]);
            let nominals = self
                .choices
                .nominals
                .iter()
                .map(|nominal| slopes.by_nominal[nominal.variable].beta * (nominal.limits.1 - nominal.limits.0));
            Ok((at.beta, half_widths.chain(nominals).collect()))
        };
        points.iter().map(part).collect()
    }
}

/// Reliability index of the summed failure probabilities, `-Phi^-1(sum Phi(-beta_i))`; infinite without any.
fn joined(parts: &[(f64, Vec<f64>)], size: usize) -> (f64, Vec<f64>) {
    match parts {
        [] => (f64::INFINITY, vec![0.0; size]),
        [(beta, slopes)] => (*beta, slopes.clone()),
        _ => {
            let sum: f64 = parts.iter().map(|(beta, _)| normal::cdf(-beta)).sum();
            let least = parts.iter().map(|(beta, _)| *beta).fold(f64::INFINITY, f64::min);
            // Beyond the range of a double, or if several limits fail for certain, use the smallest index.
            let inverted = -normal::quantile(sum);
            let beta = if inverted.is_finite() { inverted } else { least };
            let mut slopes = vec![0.0; size];
            for (reliability_index, by) in parts {
                let weight = (0.5 * (beta - reliability_index) * (beta + reliability_index)).exp();
                for (sum, slope) in slopes.iter_mut().zip(by) {
                    *sum += weight * slope;
                }
            }
            (beta, slopes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_indices_have_the_derivatives_of_differences() {
        let at = |t: f64| {
            let parts = [(2.0 + 0.3 * t, vec![0.3]), (2.5 - t, vec![-1.0])];
            joined(&parts, 1)
        };
        let sum = normal::cdf(-2.0) + normal::cdf(-2.5);
        let (beta, slopes) = at(0.0);
        assert!((normal::cdf(-beta) / sum - 1.0).abs() < 1e-12);
        let difference = (at(1e-5).0 - at(-1e-5).0) / 2e-5;
        assert!((slopes[0] / difference - 1.0).abs() < 1e-7);
        assert_eq!(joined(&[], 2), (f64::INFINITY, vec![0.0; 2]));
    }
}
