//! Effect of tolerances on arbitrary responses: quantities of modes, outputs, critical values of an input.

use super::Study;
use super::deviating::Toleranced;
use super::settings::Settings;
use crate::kernels::SummaryKernels;
use crate::propagation::{
    self, Controlled, Effort, Influence, Points, Propagation, Sampler, Samples, WorstCase,
};
use crate::response::{Response, Responses};
use crate::{Error, Watch};

impl<M: SummaryKernels> Study<M> {
    /// Computes how tolerances spread the given responses, with their covariance, by the best affordable method
    /// ([`propagation::propagate`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.propagate(&[frequency, Response::Output(Pendulum::angle.any())])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Study::tolerances`]; [`Error::NoSuchMode`], [`Error::UnknownHandle`],
    /// [`Error::Setting`] for an invalid response; [`Error::Threads`].
    pub fn propagate(&self, wanted: &[Response]) -> Result<Propagation, Error> {
        self.settings.propagate(&self.mechanism, wanted)
    }

    /// Samples the given responses at any kind of points, over any range of them ([`propagation::sampled`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::propagation::{Points, Sampler};
    /// use eigentol::response::Response;
    ///
    /// let angle = Response::Output(Pendulum::angle.any());
    /// let sampler = Sampler::new(Points::LatinHypercube).samples(800);
    /// println!("{}", study.sample_responses(&[angle], &sampler)?.propagation()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for invalid settings of the sampler.
    pub fn sample_responses(
        &self,
        wanted: &[Response],
        sampler: &Sampler<'_>,
    ) -> Result<Samples, Error> {
        self.settings
            .sample_responses(&self.mechanism, wanted, sampler)
    }

    /// Smallest and largest value of each response over the box of tolerance limits ([`propagation::worst_case`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.worst_case(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`].
    pub fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        self.settings.worst_case(&self.mechanism, wanted)
    }

    /// Means and standard deviations of the responses from few random samples, with the Taylor model as a control
    /// variate ([`propagation::controlled`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.samples(200).controlled(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for fewer than three samples.
    pub fn controlled(&self, wanted: &[Response]) -> Result<Controlled, Error> {
        self.settings.controlled(&self.mechanism, wanted)
    }

    /// Attributes the scatter of the responses to the variables ([`propagation::influence`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.influence(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for too few samples.
    pub fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        self.settings.influence(&self.mechanism, wanted)
    }
}

impl Settings {
    fn propagate(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
    ) -> Result<Propagation, Error> {
        let effort = self.effort();
        self.about(kernels, wanted, self.watch(), |own, responses| {
            propagation::propagate(own.kernels(), responses, own.tolerances, effort)
        })
    }

    fn sample_responses(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
        sampler: &Sampler<'_>,
    ) -> Result<Samples, Error> {
        let watch = self.watch();
        let mut sampler = sampler.clone();
        sampler.progress = sampler.progress.or(watch.progress);
        sampler.stop = sampler.stop.or(watch.stop);
        self.about(kernels, wanted, Watch::default(), |own, responses| {
            propagation::sampled(responses, own.tolerances, &sampler)
        })
    }

    fn worst_case(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
    ) -> Result<WorstCase, Error> {
        self.about(kernels, wanted, self.watch(), |own, responses| {
            propagation::worst_case(responses, own.tolerances)
        })
    }

    fn controlled(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
    ) -> Result<Controlled, Error> {
        let effort = self.effort();
        let sampler = Sampler::new(Points::Random)
            .samples(effort.samples)
            .seed(effort.seed)
            .stream(effort.stream)
            .threads(effort.threads);
        self.about(kernels, wanted, self.watch(), |own, responses| {
            propagation::controlled(own.kernels(), responses, own.tolerances, &sampler)
        })
    }

    fn influence(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
    ) -> Result<Influence, Error> {
        let effort = self.effort();
        self.about(kernels, wanted, self.watch(), |own, responses| {
            propagation::influence(responses, own.tolerances, effort)
        })
    }

    /// The effort that the settings allow: at least one solution for each sample.
    fn effort(&self) -> Effort {
        let effort = Effort::default().samples(self.samples as u64);
        effort
            .solutions(effort.solutions.max(effort.samples))
            .seed(self.seed)
            .stream(self.stream)
            .threads(self.threads)
    }

    /// Builds the responses and passes them to `question`.
    fn about<R>(
        &self,
        kernels: &dyn SummaryKernels,
        wanted: &[Response],
        watch: Watch<'_>,
        question: impl FnOnce(
            &Toleranced<'_, dyn SummaryKernels + '_>,
            &Responses<'_>,
        ) -> Result<R, Error>,
    ) -> Result<R, Error> {
        let own = self.toleranced(kernels, self.solved(kernels)?)?;
        let (state, modes) = own.solved();
        let responses = Responses::side_by_side(own.kernels(), state, modes, wanted.to_vec())?;
        question(&own, &responses.vectors(self.vectors).watched(watch))
    }
}
