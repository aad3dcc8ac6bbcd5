//! Sampling with the Taylor model as a control variate: only what the model does not explain needs sampling.

use super::expansion::{Expansion, expansions};
use super::gather::{Gathered, Scale, Task};
use super::model::{DesignRoom, Designs, Evaluated, Model, Take};
use super::moments;
use super::result::{Estimated, Method};
use super::space::Space;
use crate::algebra::Vector;
use crate::kernels::CurvatureKernels;
use crate::response::{Response, Responses};
use crate::tolerance::{Counts, Points, Sampling, Tolerances};
use crate::{Description, Error, Shared};

/// Mean and standard deviation of a response, corrected with those of its Taylor model. SI.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ControlledSpread {
    /// Mean, with its standard error.
    pub mean: Estimated,
    /// Standard deviation, with its standard error.
    pub sigma: Estimated,
    /// Number of plain samples that one of these is worth for the mean: the ratio of the response variance to the
    /// variance that the model leaves unexplained. Infinite if the model is exact.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub worth: f64,
    /// Number of plain samples that one of these is worth for the standard deviation.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub worth_of_sigma: f64,
    /// Order of the model: [`Method::FirstOrder`] or [`Method::SecondOrder`].
    pub model: Method,
}

/// Spreads of several responses from sampling with control variates.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Controlled {
    /// The responses requested.
    pub wanted: Vec<Response>,
    /// One per response; `None` if the response has no slopes at the nominal design, or if some samples lack it,
    /// because the model's mean over the remaining samples is unknown.
    pub spreads: Vec<Option<ControlledSpread>>,
    /// Outcomes of the samples.
    pub counts: Counts,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism they belong to.
    pub description: Shared<Description>,
}

/// Mean and standard deviation of each response from random samples, with its Taylor model, whose mean and standard
/// deviation are known exactly, as a control variate. The model is of second order if the response has second
/// derivatives and dependent variables are normal, otherwise of first order. Only the difference is left to chance
/// (Glasserman, Monte Carlo Methods in Financial Engineering, 2003, section 4.1).
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::controlled;
/// use eigentol::tolerance::Sampling;
///
/// let sampling = Sampling::default().samples(500);
/// let all = controlled(&Pendulum, &responses, &tolerances, &sampling)?;
/// let spread = all.spreads[0].expect("every bar swings");
/// assert!(spread.worth > 1000.0 && spread.mean.error < Some(1e-4));
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// As [`sampled`](super::sampled); [`Error::Setting`] for points that are not random, and for fewer than three samples.
pub fn controlled(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
) -> Result<Controlled, Error> {
    let refused = |setting, reason: &str| {
        let reason = reason.to_owned();
        Err(Error::Setting { setting, reason })
    };
    if sampling.points != Points::Random {
        return refused("points", "standard errors of control variates need random ones");
    }
    if sampling.samples < 3 {
        return refused("samples", "two tell no error of a standard deviation");
    }
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let expansions = expansions(mechanism, responses)?;
    let controls: Vec<Option<Control<'_>>> =
        (expansions.iter()).map(|expansion| Some(Control::of(expansion.as_ref()?, tolerances))).collect();
    let scales = controls.iter().flat_map(|control| control.as_ref().map_or([(0.0, 1.0); QUANTITIES], Control::scales));
    let task = Task {
        scales: scales.collect(),
        model: &Pairs { designs: Designs::new(responses, &space), nominal: space.nominal, controls: &controls },
        space: &space,
        unknowns: at.coordinates.len(),
    };
    let parts = task.gather(sampling)?;
    let samples = Gathered(&parts);
    let spreads = controls.iter().enumerate();
    let spreads = spreads.map(|(i, item)| match item {
        None => Ok(None),
        Some(own) => own.spread(&samples, QUANTITIES * i),
    });
    Ok(Controlled {
        wanted: responses.wanted().to_vec(),
        spreads: spreads.collect::<Result<_, Error>>()?,
        counts: Counts::of_parts(&parts),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}

/// Quantities per response: its value, that of the model, and the squared deviations of both from the mean of the
/// model.
const QUANTITIES: usize = 4;

/// A model with exact mean and standard deviation.
struct Control<'a> {
    expansion: &'a Expansion,
    model: Method,
    mean: f64,
    sigma: f64,
}

impl<'a> Control<'a> {
    fn of(expansion: &'a Expansion, tolerances: &Tolerances) -> Self {
        let second = (expansion.curvature.as_ref())
            .map(|curvature| moments::second_order(expansion, curvature, tolerances))
            .and_then(|exact| Some((exact.mean, exact.sigma?)));
        let (model, (mean, sigma)) = match second {
            Some(exact) => (Method::SecondOrder, exact),
            None => {
                let exact = moments::first_order(expansion, tolerances);
                (Method::FirstOrder, (exact.mean, tolerances.sigma(&expansion.slopes)))
            }
        };
        Self { expansion, model, mean, sigma }
    }

    fn scales(&self) -> [Scale; QUANTITIES] {
        let usable = |scale: f64| {
            if scale > 0.0 && scale.is_finite() { scale } else { 1.0 }
        };
        let value = (self.mean, usable(self.sigma));
        let square = (0.0, usable(self.sigma * self.sigma));
        [value, value, square, square]
    }

    fn value(&self, x: &[f64]) -> f64 {
        match self.model {
            Method::SecondOrder => self.expansion.second_order(x),
            _ => None,
        }
        .unwrap_or_else(|| self.expansion.first_order(x))
    }

    /// The spread from the samples, whose quantities for this response start at `index`.
    fn spread(&self, samples: &Gathered<'_>, index: usize) -> Result<Option<ControlledSpread>, Error> {
        if samples.count(index)? < samples.total() {
            return Ok(None);
        }
        let first = corrected(samples, index, self.mean)?;
        let square = corrected(samples, index + 2, self.sigma * self.sigma)?;
        let (Some(first), Some(square)) = (first, square) else {
            return Ok(None);
        };
        let variance = square.value - (first.value - self.mean).powi(2);
        if variance < 0.0 {
            return Ok(None);
        }
        let sigma = variance.sqrt();
        let error = if sigma > 0.0 { 0.5 * square.error / sigma } else { 0.0 };
        Ok(Some(ControlledSpread {
            mean: Estimated::new(first.value, Some(first.error)),
            sigma: Estimated::new(sigma, Some(error)),
            worth: first.worth,
            worth_of_sigma: square.worth,
            model: self.model,
        }))
    }
}

/// A mean corrected with a control variate.
struct Corrected {
    value: f64,
    error: f64,
    worth: f64,
}

/// The mean of the quantity at `index`, with the next quantity, whose mean `known` is exact, as control variate:
/// `f - beta (g - known)`, `beta = Cov(f, g) / Var(g)`.
fn corrected(samples: &Gathered<'_>, index: usize, known: f64) -> Result<Option<Corrected>, Error> {
    let covariance = |i, j| samples.covariance(i, j);
    let all = (covariance(index, index)?, covariance(index, index + 1)?, covariance(index + 1, index + 1)?);
    let (Some(variance), Some(both), Some(other)) = all else {
        return Ok(None);
    };
    let (Some(f), Some(g)) = (samples.mean(index)?, samples.mean(index + 1)?) else {
        return Ok(None);
    };
    let slope = if other > 0.0 { both / other } else { 0.0 };
    let left = (variance - slope * both).max(0.0);
    // A fully explained variance, up to rounding.
    let exact = left <= 1e-14 * variance;
    Ok(Some(Corrected {
        value: f - slope * (g - known),
        error: (left / samples.count(index)? as f64).sqrt(),
        worth: match (variance > 0.0, exact) {
            (false, _) => 1.0,
            (true, true) => f64::INFINITY,
            (true, false) => variance / left,
        },
    }))
}

/// Responses of the mechanism paired with those of their models.
struct Pairs<'a> {
    designs: Designs<'a>,
    nominal: &'a [f64],
    controls: &'a [Option<Control<'a>>],
}

impl Model for Pairs<'_> {
    type Room = DesignRoom;

    fn room(&self) -> DesignRoom {
        self.designs.room()
    }

    fn evaluate(&self, room: &mut DesignRoom, points: &[Vector], take: &mut Take<'_>) -> Result<(), Error> {
        let mut values = vec![None; QUANTITIES * self.controls.len()];
        self.designs.evaluate(room, points, &mut |k, evaluated| {
            let moved = evaluated.design.iter().zip(self.nominal);
            let x: Vector = moved.map(|(value, nominal)| value - nominal).collect();
            let all = self.controls.iter().zip(evaluated.values);
            values.fill(None);
            for ((control, value), places) in all.zip(values.chunks_exact_mut(QUANTITIES)) {
                if let (Some(control), Some(f)) = (control, value) {
                    let g = control.value(&x);
                    let square = |value: f64| (value - control.mean).powi(2);
                    places.copy_from_slice(&[Some(*f), Some(g), Some(square(*f)), Some(square(g))]);
                }
            }
            take(k, Evaluated { values: &values, ..evaluated })
        })
    }
}
