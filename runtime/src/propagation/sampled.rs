//! Sampling: every design is solved anew, and every failure is counted.

use core::ops::Range;

use super::gather::{Gathered, Scale, Task};
use super::result::{Method, Propagation};
use super::sampler::{Points, Sampler};
use super::space::Space;
use crate::algebra::{Matrix, Vector};
use crate::response::{Response, Responses};
use crate::tolerance::{Counts, Tolerances};
use crate::{Description, Error, Shared};

/// What is known of some samples. Parts of a run merge to the same bits as the whole, however it was split.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Samples {
    /// Which points.
    pub points: Points,
    /// What was asked for.
    pub wanted: Vec<Response>,
    /// Seed, stream, and samples of each randomisation.
    run: (u64, u64, u64),
    gathered: Gathered,
    nominal: Vec<Option<f64>>,
    /// The design variables that vary.
    variables: Vec<usize>,
    tolerances: Tolerances,
    inputs: Vector,
    description: Shared<Description>,
}

/// Samples designs by their tolerances and solves each anew, from the nominal equilibrium, on the stable branch.
///
/// ```
#[doc = include_str!("example.txt")]
/// use eigentol::propagation::{Points, Sampler, sampled};
///
/// let sampler = Sampler::new(Points::Sobol).samples(1024);
/// let samples = sampled(&responses, &tolerances, &sampler)?;
/// let all = samples.propagation()?;
/// let spread = all.spreads[0].as_ref().expect("every bar swings");
/// let sigma = spread.sigma.expect("many samples");
/// assert!((sigma.value - 0.0214).abs() < 2e-4 && sigma.error < Some(1e-4));
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongLength`] for tolerances of another mechanism, [`Error::Setting`] for a sampler that makes no sense, [`Error::Threads`].
/// Samples that fail are counted, not errors.
pub fn sampled(
    responses: &Responses<'_>,
    tolerances: &Tolerances,
    sampler: &Sampler<'_>,
) -> Result<Samples, Error> {
    let at = responses.nominal();
    let space = Space::new(at, tolerances)?;
    let nominal = responses.with_gradients(&mut responses.workspace(), &at.design)?;
    let slopes = nominal.gradients.iter().map(Option::as_deref);
    let scales = slopes.zip(&nominal.values);
    let task = Task {
        model: responses,
        scales: scales
            .map(|(slopes, value)| scale(*value, slopes, tolerances))
            .collect(),
        unknowns: at.coordinates.len(),
        space: &space,
    };
    Ok(Samples {
        points: sampler.points,
        wanted: responses.wanted().to_vec(),
        run: (sampler.seed, sampler.stream, sampler.of_each()?),
        gathered: task.gather(sampler)?,
        nominal: nominal.values,
        variables: space.variables(),
        tolerances: tolerances.clone(),
        inputs: at.inputs.clone(),
        description: at.description.clone(),
    })
}

/// About the nominal value, as far as first order says.
fn scale(value: Option<f64>, slopes: Option<&[f64]>, tolerances: &Tolerances) -> Scale {
    let value = value.unwrap_or(0.0);
    let sigma = slopes.map_or(0.0, |slopes| tolerances.sigma(slopes));
    let candidates = [sigma, 1e-3 * value.abs()];
    let usable = candidates
        .into_iter()
        .find(|scale| *scale > 0.0 && scale.is_finite());
    (value, usable.unwrap_or(1.0))
}

impl Samples {
    /// Adds other samples of the same run.
    ///
    /// # Errors
    /// [`Error::Setting`] for samples of another run, and for those that have been added already; nothing has been added then.
    pub fn merge(&mut self, other: Self) -> Result<(), Error> {
        let key = |one: &Self| (one.points, one.run, one.gathered.parts.len());
        let same = key(self) == key(&other)
            && self.wanted == other.wanted
            && self.tolerances == other.tolerances
            && self.inputs == other.inputs
            && self.nominal == other.nominal;
        if !same {
            return Err(Error::Setting {
                setting: "samples",
                reason: "they are of another run: ask the same of the same study, with the same sampler but for its range"
                    .to_owned(),
            });
        }
        let mut gathered = self.gathered.clone();
        gathered.merge(other.gathered)?;
        self.gathered = gathered;
        Ok(())
    }

    /// The ranges of samples that are done, in order and apart.
    #[must_use]
    pub fn ranges(&self) -> Vec<Range<u64>> {
        let of_each = self.run.2;
        let mut all: Vec<Range<u64>> = Vec::new();
        for (group, part) in self.gathered.parts.iter().enumerate() {
            let first = group as u64 * of_each;
            for own in part.ranges() {
                let own = own.start + first..own.end + first;
                match all.last_mut() {
                    Some(last) if last.end == own.start => last.end = own.end,
                    _ => all.push(own),
                }
            }
        }
        all
    }

    /// What became of the samples.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.gathered.counts()
    }

    /// How the responses are spread over the samples that are done.
    ///
    /// # Errors
    /// None that is known of: those of the statistics of samples.
    pub fn propagation(&self) -> Result<Propagation, Error> {
        let responses = self.wanted.len();
        let mut spreads = Vec::new();
        let mut covariance = Matrix::zeros(responses, responses);
        let mut with_design =
            Matrix::from_fn(responses, self.tolerances.sigmas().len(), |_, _| Some(0.0));
        for i in 0..responses {
            spreads.push(self.gathered.spread(i, self.nominal[i])?);
            for j in 0..responses {
                covariance[i][j] = self.gathered.covariance(i, j)?;
            }
            for (k, &variable) in self.variables.iter().enumerate() {
                with_design[i][variable] = self.gathered.covariance(i, responses + k)?;
            }
        }
        let counts = self.counts();
        Ok(Propagation {
            method: Method::Sampled(self.points),
            reason: String::new(),
            wanted: self.wanted.clone(),
            spreads,
            covariance,
            with_design,
            evaluations: counts.total() as u64,
            counts,
            inputs: self.inputs.clone(),
            description: self.description.clone(),
        })
    }
}
