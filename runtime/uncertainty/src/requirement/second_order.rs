//! The probability of failing a requirement, from the second-order model of its response.

use super::kinds::{Requirement, actual};
use crate::algebra::{Vector, add_scaled};
use crate::clusters::groups;
use crate::deviations::Deviations;
use crate::error::NoDerivative;
use crate::judge::{Event, Judgement, Lines};
use crate::kernels::{CurvatureKernels, Kernels};
use crate::quadratic::QuadraticModels;
use crate::response::{Realisation, Response, Responses};
use crate::second_order::{Margin, Quadratic, margin};
use crate::tolerance::Tolerances;
use crate::{Description, Equilibrium, Error, Modes, Shared};

/// The probability of failing a requirement, from the exact distribution of the second-order model of its response.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SecondOrderFailure {
    /// The requirement.
    pub wanted: Requirement,
    /// The ends of the bands of values that fail at the nominal design, SI; an end may be infinite.
    #[cfg_attr(feature = "serde", serde(with = "eigentol_statistics::serial::exact"))]
    pub bands: Vec<(f64, f64)>,
    /// Probabilities of these bands, distance, and derivatives with respect to design variables and half-widths; SI. If
    /// a band deviates, they refer to the response times the ratio of the nominal centre of the band to the actual one.
    pub margin: Margin,
    /// Total derivatives of the first-order probability with respect to each input, per SI unit: the response, its
    /// standard deviation and a band around the input all move. `None` where [`Margin::derivatives`] is, and for a
    /// response along an input.
    pub by_input: Option<Vector>,
    /// The probability of failing the requirement by designs solved anew, which judges the other two. A design without
    /// a stable equilibrium fails, of which a model of the response knows nothing.
    pub judgement: Judgement,
    /// The other modes that tolerances mix with the one required ([`clusters`](crate::clusters::clusters)). If there are
    /// any, no series of this mode alone describes it, and neither model can be relied on.
    pub mixed_with: Vec<usize>,
    /// The inputs of the operating point, SI.
    pub inputs: Vector,
    /// The mechanism it belongs to.
    pub description: Shared<Description>,
}

impl SecondOrderFailure {
    /// Whether designs solved anew confirm the second-order probability
    /// ([`Judged::confirms`](crate::judge::Judged::confirms)).
    #[must_use]
    pub fn verified(&self) -> bool {
        self.judgement.confirms(self.margin.corrected.value)
    }
}

/// Probability of failing a requirement to first and second order, with its sensitivities, judged by designs solved
/// anew.
///
/// # Errors
/// [`Error::NoSensitivity`] for [`Requirement::Stable`], which has no series, and where a response has none;
/// [`Error::NotOscillating`] for a mode without the quantity required; [`Error::NoResponse`] for a critical value or
/// crossing that does not exist; [`Error::ClusteredMode`], [`Error::CriticalState`], [`Error::OutsideDomain`];
/// [`Error::NoSuchMode`], [`Error::UnknownHandle`], [`Error::WrongLength`]; [`Error::Setting`] for an invalid band.
pub fn second_order_failure(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    wanted: Requirement,
) -> Result<SecondOrderFailure, Error> {
    wanted.check(mechanism, at)?;
    let response = wanted.response().ok_or(Error::NoSensitivity { reason: NoDerivative::Stability })?;
    let responses = Responses::new(mechanism, at, modes, vec![response])?;
    let model = QuadraticModels::new(mechanism, &responses).of(response)?;
    let reciprocal = reciprocal_slopes(mechanism, at, &wanted);
    let relative = relative(&model.quadratic, &reciprocal);
    let limits = wanted.limits();
    let bands = limits.iter().map(|limit| limit.band(mechanism, &at.inputs, &at.design));
    let bands: Vec<(f64, f64)> = bands.collect();
    let mut margin = margin(&relative, tolerances, &bands)?;
    let derivatives = margin.derivatives.as_ref().zip(model.by_input.as_ref());
    let by_input = derivatives.map(|(derivatives, (first, mixed))| {
        Vector::from_fn(at.inputs.len(), |k| {
            let (low, high) = wanted.band_slopes(mechanism, &at.inputs, &at.design, k);
            // The derivative of the reciprocal `u / (u + d)` with respect to `d` is `r = -1/u`, and the derivative of
            // `r` with respect to `u` is `r^2`.
            let bend = if wanted.moves_with(k) { relative.value } else { 0.0 };
            let slopes =
                Vector::from_fn(reciprocal.len(), |j| mixed[k][j] + reciprocal[j] * (first[k] + bend * reciprocal[j]));
            let sigma = tolerances.covariance(&relative.slopes, &slopes) / margin.sigma;
            derivatives.along(first[k], sigma, low, high)
        })
    });
    let deviations = Deviations::new(tolerances, &at.design)?;
    let distance = |design: &[f64], realisation: &Realisation| {
        let value = realisation.values.first().copied().flatten();
        wanted.distance(&responses, design, realisation.outcome, value)
    };
    let lines = Lines::along(&deviations, &relative.slopes, margin.distance);
    let judgement = Event::new(&responses, &deviations, &distance).judge(&lines)?;
    if let Some(judged) = judgement.judged() {
        let error = judged.error_of(margin.corrected.value);
        margin.corrected = margin.corrected.with_model_error(error);
    }
    Ok(SecondOrderFailure {
        wanted,
        bands,
        margin,
        by_input,
        judgement,
        mixed_with: match response {
            Response::Mode { mode, .. } => mixed_with(mechanism, at, modes, tolerances, mode)?,
            _ => Vec::new(),
        },
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}

/// The modes that tolerances mix with this one.
fn mixed_with(
    mechanism: &dyn CurvatureKernels,
    at: &Equilibrium,
    modes: &Modes,
    tolerances: &Tolerances,
    mode: usize,
) -> Result<Vec<usize>, Error> {
    let groups = groups(mechanism, at, modes, tolerances)?;
    let group = groups.into_iter().find(|group| group.contains(&mode));
    let mut others = group.unwrap_or_default();
    others.retain(|other| *other != mode);
    Ok(others)
}

/// Relative derivatives of the reciprocal of the band's centre with respect to each design variable. For a deviation
/// `d` of the input the reciprocal is `u / (u + d)`, with `u` the present value of the input.
fn reciprocal_slopes(mechanism: &dyn Kernels, at: &Equilibrium, wanted: &Requirement) -> Vector {
    let slope = |design: usize| match mechanism.input_of_deviation(design) {
        Some(input) if wanted.moves_with(input) => -actual(mechanism, input, &at.inputs, &at.design).recip(),
        _ => 0.0,
    };
    Vector::from_fn(at.design.len(), slope)
}

/// The model of `f r`, where the reciprocal `r` has nominal value one and the given slopes. A quantity `f` lies in a
/// band about `u + d` exactly where `f u / (u + d)` lies in the band about `u`.
fn relative(model: &Quadratic, reciprocal: &[f64]) -> Quadratic {
    let (f, s, r) = (model.value, &model.slopes, reciprocal);
    let mut curvature = model.curvature.clone();
    for (i, row) in curvature.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value += s[i] * r[j] + s[j] * r[i] + 2.0 * f * r[i] * r[j];
        }
    }
    Quadratic { value: f, slopes: add_scaled(s, f, r), curvature }
}
