//! Effect of tolerances on arbitrary responses: quantities of modes, outputs, critical values of an input.

use super::Study;
use super::deviating::Toleranced;
use crate::kernels::SummaryKernels;
use crate::propagation::{
    self, Controlled, Effort, Influence, Points, Propagation, Sampler, Samples, WorstCase,
};
use crate::response::{Response, Responses};
use crate::{Error, Watch};

impl<M: SummaryKernels> Study<M> {
    /// Computes how tolerances spread the given responses, with their covariance, by the best affordable method
    /// ([`propagation::propagate`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.propagate(&[frequency, Response::Output(Pendulum::angle.any())])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`] and [`Study::tolerances`]; [`Error::NoSuchMode`], [`Error::UnknownHandle`],
    /// [`Error::Setting`] for an invalid response; [`Error::Threads`].
    pub fn propagate(&self, wanted: &[Response]) -> Result<Propagation, Error> {
        let own = Own::of(&self.settings, &self.mechanism)?;
        let responses = own.responses(wanted)?;
        propagation::propagate(own.kernels(), &responses, own.tolerances, own.effort())
    }

    /// Samples the given responses at any kind of points, over any range of them ([`propagation::sampled`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::propagation::{Points, Sampler};
    /// use eigentol::response::Response;
    ///
    /// let angle = Response::Output(Pendulum::angle.any());
    /// let sampler = Sampler::new(Points::LatinHypercube).samples(800);
    /// println!("{}", study.sample_responses(&[angle], &sampler)?.propagation()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for invalid settings of the sampler.
    pub fn sample_responses(
        &self,
        wanted: &[Response],
        sampler: &Sampler<'_>,
    ) -> Result<Samples, Error> {
        let own = Own::of(&self.settings, &self.mechanism)?;
        let responses = own.responses(wanted)?.watched(Watch::default());
        let watch = self.settings.watch();
        let mut sampler = sampler.clone();
        sampler.progress = sampler.progress.or(watch.progress);
        sampler.stop = sampler.stop.or(watch.stop);
        propagation::sampled(&responses, own.tolerances, &sampler)
    }

    /// Smallest and largest value of each response over the box of tolerance limits ([`propagation::worst_case`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.worst_case(&[frequency])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`].
    pub fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        let own = Own::of(&self.settings, &self.mechanism)?;
        let responses = own.responses(wanted)?;
        propagation::worst_case(&responses, own.tolerances)
    }

    /// Means and standard deviations of the responses from few random samples, with the Taylor model as a control
    /// variate ([`propagation::controlled`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.samples(200).controlled(&[frequency])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for fewer than three samples.
    pub fn controlled(&self, wanted: &[Response]) -> Result<Controlled, Error> {
        let own = Own::of(&self.settings, &self.mechanism)?;
        let responses = own.responses(wanted)?;
        let effort = own.effort();
        let sampler = Sampler::new(Points::Random)
            .samples(effort.samples)
            .seed(effort.seed)
            .stream(effort.stream)
            .threads(effort.threads);
        propagation::controlled(own.kernels(), &responses, own.tolerances, &sampler)
    }

    /// Attributes the scatter of the responses to the variables ([`propagation::influence`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.influence(&[frequency])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for too few samples.
    pub fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        let own = Own::of(&self.settings, &self.mechanism)?;
        let responses = own.responses(wanted)?;
        propagation::influence(&responses, own.tolerances, own.effort())
    }
}

/// What responses are about.
type Own<'a> = Toleranced<'a, dyn SummaryKernels + 'a>;

impl Own<'_> {
    fn responses(&self, wanted: &[Response]) -> Result<Responses<'_>, Error> {
        let ((state, modes), settings) = (self.solved(), self.settings());
        let responses = Responses::side_by_side(self.kernels(), state, modes, wanted.to_vec())?;
        Ok(responses
            .vectors(settings.vectors)
            .watched(settings.watch()))
    }

    /// The effort that the settings allow: at least one solution for each sample.
    fn effort(&self) -> Effort {
        let settings = self.settings();
        let effort = Effort::default().samples(settings.samples as u64);
        effort
            .solutions(effort.solutions.max(effort.samples))
            .seed(settings.seed)
            .stream(settings.stream)
            .threads(settings.threads)
    }
}
