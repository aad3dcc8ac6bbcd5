//! Effect of tolerances on arbitrary responses: quantities of modes, outputs, critical values of an input.

use super::subject::SolvedSubject;
use super::{Solved, Study};
use crate::kernels::{CurvatureKernels, SummaryKernels};
use crate::propagation::{
    self, Controlled, Effort, Influence, Points, Propagation, Sampler, Samples, WorstCase,
};
use crate::response::{Response, Responses};
use crate::tolerance::Tolerances;
use crate::{Error, Watch};

impl<M: SummaryKernels> Study<M> {
    /// Computes how tolerances spread the given responses, with their covariance, by the best affordable method
    /// ([`propagation::propagate`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::Quantity;
    /// use eigentol::response::Response;
    ///
    /// let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// println!("{}", study.propagate(&[frequency, Response::Output(Pendulum::angle.any())])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::solve`] and [`Study::tolerances`]; [`Error::NoSuchMode`], [`Error::UnknownHandle`],
    /// [`Error::Setting`] for an invalid response; [`Error::Threads`].
    pub fn propagate(&self, wanted: &[Response]) -> Result<Propagation, Error> {
        self.solve()?.propagate(wanted)
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
        self.solve()?.sample_responses(wanted, sampler)
    }

    /// Smallest and largest value of each response over the box of tolerance limits ([`propagation::worst_case`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::Quantity;
    /// use eigentol::response::Response;
    ///
    /// let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// println!("{}", study.worst_case(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`].
    pub fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        self.solve()?.worst_case(wanted)
    }

    /// Means and standard deviations of the responses from few random samples, with the Taylor model as a control
    /// variate ([`propagation::controlled`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::Quantity;
    /// use eigentol::response::Response;
    ///
    /// let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// println!("{}", study.samples(200).controlled(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for fewer than three samples.
    pub fn controlled(&self, wanted: &[Response]) -> Result<Controlled, Error> {
        self.solve()?.controlled(wanted)
    }

    /// Attributes the scatter of the responses to the variables ([`propagation::influence`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::Quantity;
    /// use eigentol::response::Response;
    ///
    /// let frequency = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// println!("{}", study.influence(&[frequency])?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for too few samples.
    pub fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        self.solve()?.influence(wanted)
    }
}

impl<M: SummaryKernels> Solved<'_, M> {
    /// See [`Study::propagate`].
    ///
    /// # Errors
    /// As [`Study::propagate`].
    pub fn propagate(&self, wanted: &[Response]) -> Result<Propagation, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .propagate(wanted)
    }

    /// See [`Study::sample_responses`].
    ///
    /// # Errors
    /// As [`Study::sample_responses`].
    pub fn sample_responses(
        &self,
        wanted: &[Response],
        sampler: &Sampler<'_>,
    ) -> Result<Samples, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .sample_responses(wanted, sampler)
    }

    /// See [`Study::worst_case`].
    ///
    /// # Errors
    /// As [`Study::worst_case`].
    pub fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .worst_case(wanted)
    }

    /// See [`Study::controlled`].
    ///
    /// # Errors
    /// As [`Study::controlled`].
    pub fn controlled(&self, wanted: &[Response]) -> Result<Controlled, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .controlled(wanted)
    }

    /// See [`Study::influence`].
    ///
    /// # Errors
    /// As [`Study::influence`].
    pub fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        self.subject::<dyn SummaryKernels>(&self.study.mechanism)
            .influence(wanted)
    }
}

impl SolvedSubject<'_, dyn SummaryKernels + '_> {
    fn propagate(&self, wanted: &[Response]) -> Result<Propagation, Error> {
        let (watch, effort) = (self.settings.watch(), self.effort());
        self.about(wanted, watch, |mechanism, responses, tolerances| {
            propagation::propagate(mechanism, responses, tolerances, effort)
        })
    }

    fn sample_responses(
        &self,
        wanted: &[Response],
        sampler: &Sampler<'_>,
    ) -> Result<Samples, Error> {
        let watch = self.settings.watch();
        let mut sampler = sampler.clone();
        sampler.progress = sampler.progress.or(watch.progress);
        sampler.stop = sampler.stop.or(watch.stop);
        self.about(wanted, Watch::default(), |_, responses, tolerances| {
            propagation::sampled(responses, tolerances, &sampler)
        })
    }

    fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        let watch = self.settings.watch();
        self.about(wanted, watch, |_, responses, tolerances| {
            propagation::worst_case(responses, tolerances)
        })
    }

    fn controlled(&self, wanted: &[Response]) -> Result<Controlled, Error> {
        let (watch, effort) = (self.settings.watch(), self.effort());
        let sampler = Sampler::new(Points::Random)
            .samples(effort.samples)
            .seed(effort.seed)
            .stream(effort.stream)
            .threads(effort.threads);
        self.about(wanted, watch, |mechanism, responses, tolerances| {
            propagation::controlled(mechanism, responses, tolerances, &sampler)
        })
    }

    fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        let (watch, effort) = (self.settings.watch(), self.effort());
        self.about(wanted, watch, |_, responses, tolerances| {
            propagation::influence(responses, tolerances, effort)
        })
    }

    /// The effort that the settings allow: at least one solution for each sample.
    fn effort(&self) -> Effort {
        let settings = self.settings;
        let effort = Effort::default().samples(settings.samples as u64);
        effort
            .solutions(effort.solutions.max(effort.samples))
            .seed(settings.seed)
            .stream(settings.stream)
            .threads(settings.threads)
    }

    /// Builds the responses and passes them to `question`.
    fn about<R>(
        &self,
        wanted: &[Response],
        watch: Watch<'_>,
        question: impl FnOnce(&dyn CurvatureKernels, &Responses<'_>, &Tolerances) -> Result<R, Error>,
    ) -> Result<R, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let (at, modes) = (own.equilibrium, own.modes);
            let responses = Responses::side_by_side(own.kernels, at, modes, wanted.to_vec())?;
            let responses = responses.vectors(own.settings.vectors).watched(watch);
            question(own.kernels, &responses, tolerances)
        })
    }
}
