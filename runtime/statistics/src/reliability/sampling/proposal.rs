//! The distribution from which samples are drawn.

use crate::Error;
use crate::reliability::form::DesignPoint;
use crate::reliability::random::NormalSamples;
use crate::reliability::vector::dot;

/// A mixture of standard normal densities, each shifted to a centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    centres: Vec<Vec<f64>>,
    weights: Vec<f64>,
}

impl Proposal {
    /// The standard normal density itself: plain Monte Carlo.
    pub fn standard(dimension: usize) -> Self {
        Self { centres: vec![vec![0.0; dimension]], weights: vec![1.0] }
    }

    /// Densities at the design points, weighted half equally and half by their first-order probabilities.
    ///
    /// If the origin fails, a design point is replaced by the origin, because failure is not rare there.
    ///
    /// # Errors
    ///
    /// If there are no design points, or if they have different numbers of coordinates.
    pub fn around(design_points: &[DesignPoint]) -> Result<Self, Error> {
        let largest = design_points.iter().map(DesignPoint::ln_probability).fold(f64::NEG_INFINITY, f64::max);
        let relative = design_points.iter().map(|p| (p.ln_probability() - largest).exp());
        let relative: Vec<f64> = relative.collect();
        let sum: f64 = relative.iter().sum();
        let equal = 1.0 / design_points.len() as f64;
        let weights = relative.iter().map(|p| 0.5 * equal + 0.5 * p / sum);
        let centre = |point: &DesignPoint| match point.beta {
            beta if beta < 0.0 => vec![0.0; point.point.len()],
            _ => point.point.clone(),
        };
        Self::mixture(design_points.iter().map(centre).collect(), weights.collect())
    }

    /// Densities at arbitrary centres, with weights in any unit.
    ///
    /// # Errors
    ///
    /// If there are no centres, if they have different numbers of coordinates, or if a number is not finite or a weight
    /// is not positive.
    pub fn mixture(centres: Vec<Vec<f64>>, weights: Vec<f64>) -> Result<Self, Error> {
        let wrong = |setting, reason: &str| Err(Error::Setting { setting, reason: reason.into() });
        let Some(dimension) = centres.first().map(Vec::len) else {
            return wrong("centres", "at least one is needed");
        };
        let lengths = [(weights.len(), centres.len(), "weights of centres")].into_iter();
        let coordinates = centres.iter().map(|c| (c.len(), dimension, "coordinates of a centre"));
        for (found, expected, kind) in lengths.chain(coordinates) {
            if found != expected {
                return Err(Error::WrongLength { kind, found, expected });
            }
        }
        if centres.iter().flatten().any(|z| !z.is_finite()) {
            return wrong("centres", "a coordinate is not finite");
        }
        if weights.iter().any(|w| !(*w > 0.0 && w.is_finite())) {
            return wrong("weights", "one is not positive and finite");
        }
        let sum: f64 = weights.iter().sum();
        Ok(Self { centres, weights: weights.iter().map(|w| w / sum).collect() })
    }

    /// The same with the standard normal density itself as a component of this weight: it reaches failures far from all
    /// centres (a defensive mixture; Hesterberg 1995, *Weighted average importance sampling and defensive mixture
    /// distributions*).
    ///
    /// # Errors
    ///
    /// If the weight is not inside (0, 1).
    pub fn defended(mut self, weight: f64) -> Result<Self, Error> {
        if !(weight > 0.0 && weight < 1.0) {
            return Err(Error::Setting { setting: "weight", reason: format!("{weight} is not inside (0, 1)") });
        }
        self.weights.iter_mut().for_each(|x| *x *= 1.0 - weight);
        self.weights.push(weight);
        self.centres.push(vec![0.0; self.dimension()]);
        Ok(self)
    }

    /// Number of variables.
    pub fn dimension(&self) -> usize {
        self.centres[0].len()
    }

    /// Logarithm of a typical density ratio: weights are computed relative to it, so that their squares neither
    /// overflow nor underflow.
    pub(super) fn ln_scale(&self) -> f64 {
        let halves = self.centres.iter().map(|c| -0.5 * dot(c, c));
        halves.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Draws a sample and returns the logarithm of its weight, the ratio of the standard normal density to this one.
    pub(super) fn draw(&self, samples: &mut NormalSamples, z: &mut [f64]) -> f64 {
        let (choice, sample) = samples.next_with_choice();
        let mut sum = 0.0;
        let mut chosen = 0;
        for (k, weight) in self.weights.iter().enumerate() {
            if choice >= sum {
                chosen = k;
            }
            sum += weight;
        }
        for ((z, sample), centre) in z.iter_mut().zip(sample).zip(&self.centres[chosen]) {
            *z = sample + centre;
        }
        let parts = self.centres.iter().zip(&self.weights);
        let exponents = parts.map(|(c, weight)| weight.ln() + dot(z, c) - 0.5 * dot(c, c));
        let exponents: Vec<f64> = exponents.collect();
        let largest = exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = exponents.iter().map(|e| (e - largest).exp()).sum();
        -(largest + sum.ln())
    }
}
