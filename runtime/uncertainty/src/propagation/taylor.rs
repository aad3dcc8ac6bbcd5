//! First- and second-order propagation, for any distribution of the variables.

use eigentol_statistics::normal;
use eigentol_statistics::summary::Partial;

use super::expansion::{Expansion, Polynomials, expansions};
use super::gather::{Gathered, Task};
use super::moments::{self, ExactMoments};
use super::result::{Estimated, Method, Propagation, QUANTILES, Quantile, ResponseSpread};
use super::space::Space;
use crate::Error;
use crate::algebra::{Matrix, times};
use crate::judge::doubts_of_models;
use crate::kernels::CurvatureKernels;
use crate::response::Responses;
use crate::tolerance::{Counts, Outcome, Points, Sampling, Tolerances};

/// What third derivatives contribute to a standard deviation, relative to `r^2`: `(2 - p) / (1 - p)` for a power `p`.
const THIRD: f64 = 3.0;

/// Number of samples of the expansions themselves, for results without a closed form.
const SAMPLES: usize = 1 << 15;

/// First-order propagation of tolerances, for any distribution.
///
/// Mean and standard deviation are exact for the linear model, as is the skewness unless dependent variables are not
/// normal. Quantiles are exact for normal variables. Anything without a closed form comes from samples of the model.
/// Errors are the differences from second order, if second derivatives exist. The error of the standard deviation also
/// includes what third derivatives may add ([`second_order`]).
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::first_order;
///
/// let all = first_order(&Pendulum, &responses, &tolerances)?;
/// let sigma = all.spreads[0].as_ref().and_then(|spread| spread.sigma).expect("it has slopes");
/// assert!((sigma.value - 0.0214).abs() < 1e-4 && sigma.error < Some(1e-4));
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism.
pub fn first_order(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
) -> Result<Propagation, Error> {
    taylor(mechanism, responses, tolerances, Method::FirstOrder)
}

/// Second-order propagation of tolerances, for any distribution.
///
/// The mean is exact for the quadratic model, as is the standard deviation unless dependent variables are not normal.
/// Skewness, quantiles and covariances come from samples of the model. Responses without second derivatives have no
/// spread: quantities of modes that are too close together, outputs that are not smooth, transcritical branch points.
///
/// Errors extrapolate the difference from first order like a series: it is multiplied by `r`, the ratio of the
/// contributions of curvature and slopes to the standard deviation. The error of the standard deviation itself is the
/// whole difference plus `3 r^2` times the standard deviation: as much as the neglected third derivatives contribute to
/// that of a square root, such as a frequency. Near a critical state the series does not converge, and these error
/// estimates do not hold: there are [`doubts`](Propagation::doubts) instead.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::second_order;
///
/// let all = second_order(&Pendulum, &responses, &tolerances)?;
/// let mean = all.spreads[0].as_ref().map(|spread| spread.mean).expect("it has slopes");
/// assert!((mean.value - 4.04169).abs() < 1e-4 && mean.error < Some(1e-5));
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism.
pub fn second_order(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
) -> Result<Propagation, Error> {
    taylor(mechanism, responses, tolerances, Method::SecondOrder)
}

fn taylor(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    method: Method,
) -> Result<Propagation, Error> {
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let expansions = expansions(mechanism, responses)?;
    let parts = samples(&space, &expansions)?;
    let all = Models { samples: Gathered(&parts), expansions: &expansions, tolerances };
    let count = expansions.len();
    let second = method == Method::SecondOrder;
    let (mut spreads, mut covariance) = (Vec::new(), Matrix::zeros(count, count));
    let mut with_design = Matrix::from_fn(count, at.design.len(), |_, _| None);
    for (i, expansion) in expansions.iter().enumerate() {
        let Some(expansion) = expansion.as_ref().filter(|x| !second || x.curvature.is_some()) else {
            spreads.push(None);
            continue;
        };
        let spread = all.spread(i, expansion, second)?;
        if second {
            for j in 0..count {
                covariance[i][j] = all.samples.covariance(count + i, count + j)?;
            }
            covariance[i][i] = (spread.sigma).map(|sigma| sigma.value * sigma.value);
            with_design[i].fill(Some(0.0));
            for (k, &variable) in space.variables().iter().enumerate() {
                with_design[i][variable] = all.samples.covariance(count + i, 2 * count + k)?;
            }
        } else {
            for (j, other) in expansions.iter().enumerate() {
                let other = other.as_ref();
                covariance[i][j] = other.map(|other| tolerances.covariance(&expansion.slopes, &other.slopes));
            }
            let factor = tolerances.factor();
            let all = times(factor, &times(&factor.transpose(), &expansion.slopes));
            for (slot, value) in with_design[i].iter_mut().zip(&all) {
                *slot = Some(*value);
            }
        }
        spreads.push(Some(spread));
    }
    let mut counts = Counts::default();
    counts.add(Outcome::from(at.stability), 1);
    let propagation = Propagation {
        method,
        reason: String::new(),
        wanted: responses.wanted().to_vec(),
        spreads,
        doubts: Vec::new(),
        covariance,
        with_design,
        evaluations: 1,
        counts,
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    };
    Ok(propagation.doubted(doubts_of_models(responses, tolerances)))
}

/// Samples the expansions: to first order, then to second.
fn samples(space: &Space<'_>, expansions: &[Option<Expansion>]) -> Result<Vec<Partial>, Error> {
    let scale = |expansion: &Option<Expansion>| {
        let own = expansion.as_ref();
        let sigma = own.map_or(0.0, |x| space.tolerances.sigma(&x.slopes));
        let value = own.map_or(0.0, |x| x.value);
        (value, if sigma > 0.0 && sigma.is_finite() { sigma } else { 1.0 })
    };
    let scales: Vec<_> = expansions.iter().map(scale).collect();
    let task =
        Task { model: &Polynomials { space, expansions }, space, scales: [&scales[..], &scales].concat(), unknowns: 0 };
    task.gather(&Sampling::default().points(Points::Sobol).samples(SAMPLES))
}

struct Models<'a> {
    samples: Gathered<'a>,
    expansions: &'a [Option<Expansion>],
    tolerances: &'a Tolerances,
}

impl Models<'_> {
    fn spread(&self, i: usize, expansion: &Expansion, second: bool) -> Result<ResponseSpread, Error> {
        let first = self.model(i, expansion, None)?;
        let Some(curvature) = &expansion.curvature else {
            return Ok(first.without_errors());
        };
        let other = self.model(i, expansion, Some(curvature))?;
        let ratio = self.ratio(expansion, curvature);
        let (mut spread, other, share) = if second { (other, first, ratio) } else { (first, other, 1.0) };
        add_difference(&mut spread, &other, share);
        let sigma = spread.sigma.as_mut();
        if let Some((sigma, error)) = sigma.and_then(|sigma| Some((sigma.value, sigma.error.as_mut()?))) {
            *error += THIRD * ratio * ratio * sigma;
        }
        Ok(spread)
    }

    /// Ratio of the contributions of curvature (to the standard deviation and, if means are shifted, to the slopes) to
    /// that of the slopes; at most 1.
    fn ratio(&self, expansion: &Expansion, curvature: &Matrix) -> f64 {
        let columns = self.tolerances.factor().transpose();
        let curved = columns.iter().map(|row| times(curvature, row));
        let squares: f64 = curved.flat_map(|row| times(&columns, &row)).map(|element| 0.5 * element * element).sum();
        let bent = self.tolerances.sigma(&times(curvature, self.tolerances.shifts()));
        let ratio = (squares.sqrt() + bent) / self.tolerances.sigma(&expansion.slopes);
        if ratio < 1.0 { ratio } else { 1.0 }
    }

    /// The spread of an expansion, including the errors of sampling it.
    fn model(&self, i: usize, expansion: &Expansion, curvature: Option<&Matrix>) -> Result<ResponseSpread, Error> {
        let index = if curvature.is_some() { self.expansions.len() + i } else { i };
        let exact = match curvature {
            None => moments::first_order(expansion, self.tolerances),
            Some(curvature) => moments::second_order(expansion, curvature, self.tolerances),
        };
        let nominal = Some(expansion.value);
        let sampled = self.samples.spread(index, nominal)?;
        let certain = |value: f64| Estimated::new(value, Some(0.0));
        let ExactMoments { mean, sigma, skewness } = exact;
        let normal = curvature.is_none() && self.tolerances.is_normal();
        let quantiles = match (sigma, sampled.as_ref()) {
            (Some(sigma), _) if normal => exactly_normal(mean, sigma),
            (_, sampled) => sampled.map_or(Vec::new(), |all| all.quantiles.clone()),
        };
        let of_samples = sampled.as_ref();
        Ok(ResponseSpread {
            nominal,
            mean: certain(mean),
            sigma: sigma.map(certain).or(of_samples.and_then(|all| all.sigma)),
            skewness: skewness.map(certain).or(of_samples.and_then(|all| all.skewness)),
            quantiles,
            share: 1.0,
        })
    }
}

fn exactly_normal(mean: f64, sigma: f64) -> Vec<Quantile> {
    QUANTILES
        .map(|probability| Quantile {
            probability,
            value: mean + sigma * normal::quantile(probability),
            error: Some(0.0),
        })
        .into()
}

/// Adds the fraction `share` of the difference from another spread to each error, and the whole difference to that of
/// the standard deviation.
fn add_difference(response_spread: &mut ResponseSpread, other: &ResponseSpread, share: f64) {
    let further = |estimated: &mut Estimated, other: Option<Estimated>, share: f64| {
        let difference = other.map(|other| share * (estimated.value - other.value).abs());
        estimated.error = estimated.error.zip(difference).map(|(a, b)| a + b);
    };
    further(&mut response_spread.mean, Some(other.mean), share);
    if let Some(sigma) = &mut response_spread.sigma {
        further(sigma, other.sigma, 1.0);
    }
    if let Some(skewness) = &mut response_spread.skewness {
        further(skewness, other.skewness, share);
    }
    for (quantile, other) in response_spread.quantiles.iter_mut().zip(&other.quantiles) {
        let difference = share * (quantile.value - other.value).abs();
        quantile.error = quantile.error.map(|error| error + difference);
    }
}
