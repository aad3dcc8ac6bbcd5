//! Spreads of forced vibrations, right at a resonance too: the condensed resolvent in place of the mechanism.

use super::gather::{Gathered, Scale, Task, nominal_scales};
use super::model::{DesignRoom, Designs, Evaluated, Model, Take};
use super::result::{Method, Propagation};
use super::sampled::propagation_of;
use super::space::Space;
use crate::algebra::Vector;
use crate::forced::Resolvent;
use crate::kernels::CurvatureKernels;
use crate::response::{Response, Responses, Vibration};
use crate::tolerance::{Outcome, Sampling, Tolerances};
use crate::{Description, Equilibrium, Error};

/// Models of several vibrations, one resolvent for each harmonic in them.
struct Vibrations<'a> {
    harmonics: Vec<Option<Resolvent<'a>>>,
    wanted: Vec<Vibration>,
    description: &'a Description,
    space: &'a Space<'a>,
}

impl<'a> Vibrations<'a> {
    fn new(
        mechanism: &'a dyn CurvatureKernels,
        at: &'a Equilibrium,
        wanted: &[Response],
        space: &'a Space<'a>,
    ) -> Result<Self, Error> {
        let one = |response: &Response| match response {
            Response::Vibration(vibration) => Ok(*vibration),
            _ => Err(Error::setting("responses", "only vibrations have this model")),
        };
        let wanted: Vec<Vibration> = wanted.iter().map(one).collect::<Result<_, Error>>()?;
        let d = &*at.description;
        let own: Vec<usize> = wanted.iter().flat_map(|vibration| vibration.harmonics(d)).collect();
        let firsts = d.excitations.iter().enumerate().filter(|(k, info)| info.with == *k);
        let models = firsts.enumerate().map(|(harmonic, (with, _))| {
            if own.contains(&harmonic) {
                Resolvent::new(mechanism, at, with, space.variables()).map(Some)
            } else {
                Ok(None)
            }
        });
        Ok(Self { harmonics: models.collect::<Result<_, Error>>()?, wanted, description: d, space })
    }
}

impl Model for Vibrations<'_> {
    type Room = (Vector, Vec<Option<f64>>);

    fn room(&self) -> Self::Room {
        (self.space.nominal.into(), vec![None; self.wanted.len()])
    }

    fn evaluate(&self, (design, values): &mut Self::Room, points: &[Vector], take: &mut Take<'_>) -> Result<(), Error> {
        for (k, z) in points.iter().enumerate() {
            self.space.design(z, design);
            let amplitudes: Vec<_> = self.harmonics.iter().map(|model| model.as_ref()?.amplitudes(design)).collect();
            for (value, vibration) in values.iter_mut().zip(&self.wanted) {
                *value = vibration.value(self.description, |harmonic, output| {
                    let (frequency, outputs) = amplitudes.get(harmonic)?.as_ref()?;
                    let y = (*outputs.get(output.index())?)?;
                    Some(vibration.measure.of(*frequency, y))
                });
            }
            let outcome = Outcome::Stable;
            take(k, Evaluated { design, outcome, values })?;
        }
        Ok(())
    }
}

/// Spreads of amplitudes of forced vibrations from many samples of a model that is cheap and stays right at a resonance,
/// where the amplitude to first order fails: the inverse of the dynamic stiffness, condensed to the directions in which
/// it nearly vanishes, with total derivatives, and exact forces. [`sampled`](super::sampled) solves every design anew and
/// says how good the model is, and so do the checks: `checked` designs are solved anew, and the spreads of both over them
/// compared, so that the scatter of sampling cancels. A check is `None` for a response that fewer than two of them have; there
/// are none if nothing is `checked`.
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for responses that are no vibrations
/// and for invalid settings, those of the shift of the equilibrium, [`Error::Threads`].
pub fn vibrations(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
    checked: usize,
) -> Result<(Propagation, Vec<Option<VibrationCheck>>), Error> {
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let model = Vibrations::new(mechanism, at, responses.wanted(), &space)?;
    let (nominal, scales) = nominal_scales(responses, tolerances)?;
    let task = Task { model: &model, scales: scales.clone(), unknowns: at.coordinates.len(), space: &space };
    let parts = task.gather(sampling)?;
    let propagation = propagation_of(
        Method::Resolvent(sampling.points),
        &parts,
        (responses.wanted(), &nominal),
        (&space.variables(), at.design.len()),
        (&at.inputs, &at.description),
    )?;
    let checks = match checked {
        0 => Vec::new(),
        number => check(&model, responses, &scales, &sampling.clone().samples(number))?,
    };
    Ok((propagation, checks))
}

/// How far the spread by the model of [`vibrations`] is from that of the same designs solved anew.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VibrationCheck {
    /// Number of designs solved anew that have the vibration, whatever their stability.
    pub samples: u64,
    /// Relative error of the model's standard deviation.
    pub sigma: f64,
    /// Relative error of the value below which 99 % of the designs lie.
    pub upper: f64,
}

/// Compares the model with designs solved anew.
fn check(
    model: &Vibrations<'_>,
    responses: &Responses<'_>,
    scales: &[Scale],
    sampling: &Sampling<'_>,
) -> Result<Vec<Option<VibrationCheck>>, Error> {
    let space = model.space;
    let both = Both { designs: Designs::new(responses, space), model };
    let unknowns = responses.nominal().coordinates.len();
    let parts = Task { model: &both, scales: [scales, scales].concat(), unknowns, space }.gather(sampling)?;
    let (gathered, count) = (Gathered(&parts), scales.len());
    let compared = |k: usize| {
        let sigma = |index| -> Result<_, Error> {
            let spread = gathered.spread(index, None)?;
            Ok(spread.and_then(|spread| Some(spread.sigma?.value)))
        };
        let upper = |index| gathered.quantile(index, UPPER);
        let sigma = relative(sigma(count + k)?, sigma(k)?);
        let upper = relative(upper(count + k)?, upper(k)?);
        let samples = gathered.count(k)?;
        Ok(sigma.zip(upper).map(|(sigma, upper)| VibrationCheck { samples, sigma, upper }))
    };
    (0..count).map(compared).collect()
}

/// Share of the designs below the upper end that is compared.
const UPPER: f64 = 0.99;

/// The relative error of a number of the model, if both exist.
fn relative(value: Option<f64>, right: Option<f64>) -> Option<f64> {
    let (value, right) = value.zip(right)?;
    Some(if right == value { 0.0 } else { value / right - 1.0 })
}

/// The mechanism and the model, at the same designs; designs that fail have neither value.
struct Both<'a> {
    designs: Designs<'a>,
    model: &'a Vibrations<'a>,
}

impl Model for Both<'_> {
    type Room = (DesignRoom, <Vibrations<'static> as Model>::Room);

    fn room(&self) -> Self::Room {
        (self.designs.room().unjudged(), self.model.room())
    }

    fn evaluate(&self, (exact, model): &mut Self::Room, points: &[Vector], take: &mut Take<'_>) -> Result<(), Error> {
        for (k, z) in points.iter().enumerate() {
            let one = std::slice::from_ref(z);
            let mut values: Vec<Option<f64>> = Vec::new();
            let mut outcome = Outcome::Stable;
            self.designs.evaluate(exact, one, &mut |_, solved| {
                values = solved.values.to_vec();
                outcome = solved.outcome;
                Ok(())
            })?;
            self.model.evaluate(model, one, &mut |_, predicted| {
                let exact = values.clone();
                values.extend(predicted.values.iter().zip(exact).map(|(x, exact)| exact.and(*x)));
                take(k, Evaluated { design: predicted.design, outcome, values: &values })
            })?;
        }
        Ok(())
    }
}
