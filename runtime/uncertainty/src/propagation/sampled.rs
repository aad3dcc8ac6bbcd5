//! Sampling: every design is solved anew, and every failure is counted.

use super::gather::{Gathered, Task, nominal_scales};
use super::model::Designs;
use super::result::{Method, Propagation};
use super::space::Space;
use crate::algebra::{Matrix, Vector};
use crate::response::{Response, Responses};
#[cfg(feature = "serde")]
use crate::tolerance::Outcome;
use crate::tolerance::run::{Format, Run};
use crate::tolerance::{Counts, Fingerprint, Points, Sampling, Tolerances};
use crate::{Description, Error, Shared};
use eigentol_statistics::summary::Partial;

/// Statistics of a set of samples. Parts of a run merge to the same bits as the whole, however it was split.
///
/// With the feature `serde` it can be serialised; only the same version of the format can be read.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self", expecting = "samples of responses"))]
#[non_exhaustive]
pub struct Samples {
    format: Format,
    /// The kind of points.
    pub points: Points,
    /// The responses requested.
    pub wanted: Vec<Response>,
    run: Run,
    nominal: Vec<Option<f64>>,
    /// The varying design variables, and the number of all design variables.
    variables: (Vec<usize>, usize),
}

/// Samples designs according to the tolerances and solves each anew, starting from the nominal equilibrium, on the
/// stable branch.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::sampled;
/// use eigentol::tolerance::{Points, Sampling};
///
/// let sampling = Sampling::default().points(Points::Sobol).samples(1024);
/// let samples = sampled(&responses, &tolerances, &sampling)?;
/// let all = samples.propagation()?;
/// let spread = all.spreads[0].as_ref().expect("every bar swings");
/// let sigma = spread.sigma.expect("many samples");
/// assert!((sigma.value - 0.0214).abs() < 2e-4 && sigma.error < Some(1e-4));
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for invalid settings,
/// [`Error::Threads`]. Samples that fail are counted, not errors.
pub fn sampled(responses: &Responses<'_>, tolerances: &Tolerances, sampling: &Sampling<'_>) -> Result<Samples, Error> {
    if sampling.samples == 0 {
        return Err(Error::setting("samples", "there must be one"));
    }
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let (nominal, scales) = nominal_scales(responses, tolerances)?;
    let designs = Designs::new(responses, &space);
    let task = Task { model: &designs, scales, unknowns: at.coordinates.len(), space: &space };
    Ok(Samples {
        format: Format,
        points: sampling.points,
        wanted: responses.wanted().to_vec(),
        run: Run {
            fingerprint: fingerprint(responses, tolerances, sampling, designs.side_by_side()),
            of_each: sampling.of_each()?,
            parts: task.gather(sampling)?,
            inputs: at.inputs.clone(),
            description: at.description.clone(),
        },
        nominal,
        variables: (space.variables(), at.design.len()),
    })
}

/// Identifies the model and settings behind the samples.
fn fingerprint(
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    sampling: &Sampling<'_>,
    side_by_side: bool,
) -> Fingerprint {
    let (at, modes) = (responses.nominal(), responses.modes());
    let mut all = Fingerprint::new(responses.mechanism(), at, modes, tolerances)
        .with("points", format!("{:?}", sampling.points))
        .with("solved", if side_by_side { "side by side" } else { "one by one" })
        .with("samples", sampling.samples)
        .with("randomisations", sampling.groups())
        .with("seed", sampling.seed)
        .with("stream", sampling.stream);
    for (k, response) in responses.wanted().iter().enumerate() {
        all = all.with(format!("response {}", k + 1), format!("{response:?}"));
    }
    all
}

impl Samples {
    /// Adds further samples of the same run.
    ///
    /// # Errors
    /// [`Error::OtherRun`] for samples of another run, [`Error::SamplesOverlap`] for samples that have already been
    /// added; in either case nothing is added.
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        self.run.merge(other.run)
    }

    eigentol_tolerance::of_run!();

    /// Outcomes of the samples.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.run.counts()
    }

    /// The spread of the responses over the samples done so far.
    ///
    /// # Errors
    /// Those of the sample statistics; none is known to occur.
    pub fn propagation(&self) -> Result<Propagation, Error> {
        propagation_of(
            Method::Sampled(self.points),
            &self.run.parts,
            (&self.wanted, &self.nominal),
            (&self.variables.0, self.variables.1),
            (&self.run.inputs, &self.run.description),
        )
    }
}

/// The spreads of responses over samples; `variables` are those that vary, and the number of all.
pub(super) fn propagation_of(
    method: Method,
    parts: &[Partial],
    (wanted, nominal): (&[Response], &[Option<f64>]),
    (variables, all): (&[usize], usize),
    (inputs, description): (&Vector, &Shared<Description>),
) -> Result<Propagation, Error> {
    let (responses, gathered) = (wanted.len(), Gathered(parts));
    let mut spreads = Vec::new();
    let mut covariance = Matrix::zeros(responses, responses);
    let mut with_design = Matrix::from_fn(responses, all, |_, _| Some(0.0));
    for i in 0..responses {
        spreads.push(gathered.spread(i, nominal[i])?);
        for j in 0..responses {
            covariance[i][j] = gathered.covariance(i, j)?;
        }
        for (k, &variable) in variables.iter().enumerate() {
            with_design[i][variable] = gathered.covariance(i, responses + k)?;
        }
    }
    let counts = Counts::of_parts(parts);
    Ok(Propagation {
        method,
        reason: String::new(),
        wanted: wanted.to_vec(),
        doubts: vec![Vec::new(); spreads.len()],
        spreads,
        covariance,
        with_design,
        evaluations: counts.total() as u64,
        counts,
        inputs: inputs.clone(),
        description: description.clone(),
    })
}

#[cfg(feature = "serde")]
eigentol_statistics::checked!(Samples);

#[cfg(feature = "serde")]
impl Samples {
    fn checked(self) -> Result<Self, &'static str> {
        let (varied, variables) = &self.variables;
        let quantities = self.wanted.len() + varied.len();
        self.run.check(quantities, Outcome::ALL.len())?;
        if self.nominal.len() == self.wanted.len() && varied.iter().all(|variable| variable < variables) {
            Ok(self)
        } else {
            Err("the parts of these samples do not fit together")
        }
    }
}
