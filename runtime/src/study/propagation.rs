//! Effect of tolerances on arbitrary responses: quantities of modes, outputs, critical values of an input.

use super::Study;
use super::deviating::Toleranced;
use crate::kernels::SummaryKernels;
use crate::propagation::{self, Influence, Propagation, SOLUTIONS, Samples, WorstCase};
use crate::response::{Response, Responses};
use crate::tolerance::Sampling;
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
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        let responses = toleranced.responses(wanted)?;
        let sampling = self.settings.sampling();
        // At least one solution for each sample.
        let solutions = SOLUTIONS.max(sampling.samples as u64);
        propagation::propagate(toleranced.kernels(), &responses, toleranced.tolerances, solutions, &sampling)
    }

    /// Samples the given responses at any kind of points, over any range of them ([`propagation::sampled`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::response::Response;
    /// use eigentol::tolerance::Points;
    ///
    /// let angle = Response::Output(Pendulum::angle.any());
    /// let sampling = study.sampling().points(Points::LatinHypercube).samples(800);
    /// println!("{}", study.sample_responses(&[angle], &sampling)?.propagation()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for invalid settings.
    pub fn sample_responses(&self, wanted: &[Response], sampling: &Sampling<'_>) -> Result<Samples, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        let responses = toleranced.responses(wanted)?.watched(Watch::default());
        propagation::sampled(&responses, toleranced.tolerances, sampling)
    }

    /// Smallest and largest value of each response over the box of tolerance limits ([`propagation::worst_case`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.worst_case(&[frequency])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`].
    pub fn worst_case(&self, wanted: &[Response]) -> Result<WorstCase, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        let responses = toleranced.responses(wanted)?;
        propagation::worst_case(&responses, toleranced.tolerances)
    }

    /// Attributes the scatter of the responses to the variables ([`propagation::influence`]).
    #[doc = include_str!("example.txt")]
    #[doc = include_str!("frequency.txt")]
    /// println!("{}", study.influence(&[frequency])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::propagate`]; [`Error::Setting`] for too few samples.
    pub fn influence(&self, wanted: &[Response]) -> Result<Influence, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        let responses = toleranced.responses(wanted)?;
        propagation::influence(&responses, toleranced.tolerances, &self.settings.sampling())
    }
}

/// What responses are about.
type TolerancedMachine<'a> = Toleranced<'a, dyn SummaryKernels + 'a>;

impl TolerancedMachine<'_> {
    fn responses(&self, wanted: &[Response]) -> Result<Responses<'_>, Error> {
        let ((state, modes), settings) = (self.solved(), self.settings());
        let responses = Responses::side_by_side(self.kernels(), state, modes, wanted.to_vec())?;
        Ok(responses.vectors(settings.vectors).watched(settings.watch()))
    }
}
