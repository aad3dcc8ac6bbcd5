//! Several requirements at once, each replaced by the tangent plane at its design point: first-order system reliability
//! (Hohenbichler and Rackwitz 1983, *First-order concepts in system reliability*, Structural Safety 1).

mod bivariate;
mod factor;
mod multinormal;
mod slice;

pub use bivariate::probability_above;
pub use multinormal::{QuadratureSettings, box_probability};

use bivariate::both_above;

use super::form::DesignPoint;
use super::sampling::{Estimate, Interval};
use super::vector::dot;
use crate::Error;
use crate::normal::cdf;

/// Requirements given by their reliability indices and the correlations of their linearised limit states.
///
/// # Examples
///
/// ```
/// use eigentol_statistics::reliability::system::{FirstOrderSystem, QuadratureSettings};
///
/// let correlation = vec![vec![1.0, 0.5], vec![0.5, 1.0]];
/// let system = FirstOrderSystem::new(vec![3.0, 3.5], correlation)?;
/// let bounds = system.series_bounds();
/// let failure = system.series_probability(&QuadratureSettings::default())?;
/// // The bounds of two requirements meet.
/// assert!((bounds.lower / bounds.upper - 1.0).abs() < 1e-12);
/// assert!((failure.value / bounds.upper - 1.0).abs() < 1e-3);
/// # Ok::<(), eigentol_statistics::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FirstOrderSystem {
    /// In descending order of failure probability.
    betas: Vec<f64>,
    correlation: Vec<Vec<f64>>,
}

impl FirstOrderSystem {
    /// Creates a system from reliability indices and the correlation matrix of the linearised limit states, row by row.
    ///
    /// # Errors
    ///
    /// If there are no requirements, if an index is not finite, if lengths differ, or if the matrix is not a
    /// correlation matrix.
    pub fn new(betas: Vec<f64>, correlation: Vec<Vec<f64>>) -> Result<Self, Error> {
        if let Some(wrong) = betas.iter().find(|beta| !beta.is_finite()) {
            return Err(Error::Setting { setting: "betas", reason: format!("{wrong} is not finite") });
        }
        let bounds: Vec<Interval> = betas.iter().map(|&beta| safe(beta)).collect();
        factor::factorise(&bounds, &correlation)?;
        let mut order: Vec<usize> = (0..betas.len()).collect();
        order.sort_by(|&a, &b| betas[a].total_cmp(&betas[b]));
        let row = |&i: &usize| order.iter().map(|&j| correlation[i][j]).collect();
        Ok(Self { betas: order.iter().map(|&i| betas[i]).collect(), correlation: order.iter().map(row).collect() })
    }

    /// Creates a system from design points: one per requirement or, in a series system, several.
    ///
    /// # Errors
    ///
    /// If there are none, or if they have different numbers of coordinates.
    pub fn of(design_points: &[DesignPoint]) -> Result<Self, Error> {
        let expected = design_points.first().map_or(0, |p| p.direction.len());
        if let Some(wrong) = design_points.iter().find(|p| p.direction.len() != expected) {
            return Err(Error::WrongLength {
                kind: "coordinates of a design point",
                found: wrong.direction.len(),
                expected,
            });
        }
        let correlation = |(i, a): (usize, &DesignPoint)| {
            let entry = |(j, b): (usize, &DesignPoint)| match i == j {
                true => 1.0,
                false => dot(&a.direction, &b.direction).clamp(-1.0, 1.0),
            };
            design_points.iter().enumerate().map(entry).collect()
        };
        Self::new(
            design_points.iter().map(|p| p.beta).collect(),
            design_points.iter().enumerate().map(correlation).collect(),
        )
    }

    /// Bounds on the probability that at least one requirement fails (Ditlevsen 1979, *Narrow reliability bounds for
    /// structural systems*, J. Struct. Mech. 7), from pairwise probabilities.
    pub fn series_bounds(&self) -> Interval {
        let (mut lower, mut upper) = (0.0, 0.0);
        for (i, (&beta, row)) in self.betas.iter().zip(&self.correlation).enumerate() {
            let single = cdf(-beta);
            let earlier = self.betas[..i].iter().zip(row);
            let pairs = earlier.map(|(&other, &r)| both_above(beta, other, r));
            let (sum, most) = pairs.fold((0.0, 0.0_f64), |(sum, most), p| (sum + p, most.max(p)));
            lower += (single - sum).max(0.0);
            upper += (single - most).max(0.0);
        }
        Interval { lower, upper: f64::min(upper, 1.0) }
    }

    /// Probability that at least one requirement fails: that the first fails, or the second but not the first, and so
    /// on, so that small probabilities keep their relative accuracy.
    ///
    /// # Errors
    ///
    /// If a setting is invalid.
    pub fn series_probability(&self, settings: &QuadratureSettings) -> Result<Estimate, Error> {
        let (mut value, mut variance) = (0.0, 0.0);
        for i in 0..self.betas.len() {
            let mut bounds: Vec<Interval> = self.betas[..i].iter().map(|&b| safe(b)).collect();
            bounds.push(failed(self.betas[i]));
            let part = self.probability_of(&bounds, settings)?;
            value += part.value;
            variance += part.standard_error.powi(2);
        }
        Ok(Estimate { value: f64::min(value, 1.0), standard_error: variance.sqrt() })
    }

    /// Probability that all requirements are met.
    ///
    /// # Errors
    ///
    /// If a setting is invalid.
    pub fn all_met(&self, settings: &QuadratureSettings) -> Result<Estimate, Error> {
        let bounds: Vec<Interval> = self.betas.iter().map(|&beta| safe(beta)).collect();
        self.probability_of(&bounds, settings)
    }

    /// Probability that all requirements fail.
    ///
    /// # Errors
    ///
    /// If a setting is invalid.
    pub fn parallel_probability(&self, settings: &QuadratureSettings) -> Result<Estimate, Error> {
        let bounds: Vec<Interval> = self.betas.iter().map(|&beta| failed(beta)).collect();
        self.probability_of(&bounds, settings)
    }

    /// Probability of a box in the leading variables.
    fn probability_of(&self, bounds: &[Interval], settings: &QuadratureSettings) -> Result<Estimate, Error> {
        let rows = self.correlation[..bounds.len()].iter();
        let correlation: Vec<Vec<f64>> = rows.map(|row| row[..bounds.len()].to_vec()).collect();
        box_probability(bounds, &correlation, settings)
    }
}

/// The requirement is met: its standard normal variable is below beta.
fn safe(beta: f64) -> Interval {
    Interval { lower: f64::NEG_INFINITY, upper: beta }
}

fn failed(beta: f64) -> Interval {
    Interval { lower: beta, upper: f64::INFINITY }
}
