//! Requirements of a study: the probability of meeting them, and the cheapest tolerances that do.

use super::Study;
use super::deviating::Toleranced;
use crate::Error;
use crate::allocation::{Allocation, Choices, allocate};
use crate::kernels::CurvatureKernels;
use crate::requirement::{Chances, FormSettings, Probabilities, Reliability, Requirement, Requirements};
use crate::tolerance::Sampling;

impl<M: CurvatureKernels> Study<M> {
    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points,
    /// lines of designs, or the study's number of samples ([`Requirements::probabilities`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    #[doc = include_str!("frequency.txt")]
    /// let found = study.probability(&[Requirement::at_least(frequency, 3.9)])?;
    /// assert!(found.each[0].value < 1e-6 && found.each[0].interval.upper < 1e-6);
    /// println!("{found}");
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`], [`Study::tolerances`], [`Requirements::new`] and [`Requirements::probabilities`].
    pub fn probability(&self, wanted: &[Requirement]) -> Result<Probabilities, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        let requirements = toleranced.requirements(wanted)?.watched(self.settings.watch());
        // The designs report themselves.
        requirements.probabilities(&self.sampling().progress(None))
    }

    /// Probabilities of meeting the requirements, jointly and individually, from the study's number of samples
    /// ([`Requirements::chances`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    #[doc = include_str!("frequency.txt")]
    /// let wanted = [Requirement::at_least(frequency, 4.0), Requirement::Stable];
    /// println!("{}", study.chances(&wanted)?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`], [`Study::tolerances`], [`Requirements::new`] and [`Requirements::chances`].
    pub fn chances(&self, wanted: &[Requirement]) -> Result<Chances, Error> {
        self.chances_by(wanted, &self.sampling())
    }

    /// Like [`Study::chances`], with custom settings, for example a range of the samples, or a run to watch and stop.
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    #[doc = include_str!("frequency.txt")]
    /// let (study, wanted) = (study.samples(1000), [Requirement::at_least(frequency, 4.0)]);
    /// let part = |range| study.chances_by(&wanted, &study.sampling().range(Some(range)));
    /// let failed = part(0..300)?.all.failed + part(300..1000)?.all.failed;
    /// assert_eq!(failed, study.chances(&wanted)?.all.failed);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::chances`].
    pub fn chances_by(&self, wanted: &[Requirement], sampling: &Sampling<'_>) -> Result<Chances, Error> {
        TolerancedMachine::of(&self.settings, &self.mechanism)?.requirements(wanted)?.chances(sampling)
    }

    /// Failure probabilities from design points, with importance factors and exact derivatives
    /// ([`Requirements::reliability`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    #[doc = include_str!("frequency.txt")]
    /// let found = study.reliability(&[Requirement::at_least(frequency, 4.0)])?;
    /// assert!(found.verified());
    /// println!("{found}");
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`], [`Study::tolerances`], [`Requirements::new`] and [`Requirements::reliability`].
    pub fn reliability(&self, wanted: &[Requirement]) -> Result<Reliability, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        toleranced.requirements(wanted)?.watched(self.settings.watch()).reliability(&FormSettings::default())
    }

    /// Finds the cheapest tolerances that meet the requirements, checked with the study's number of samples
    /// ([`allocation::allocate`](crate::allocation::allocate)).
    #[doc = include_str!("example.txt")]
    /// use eigentol::allocation::{Choices, Cost, HalfWidth};
    /// use eigentol::requirement::Requirement;
    #[doc = include_str!("frequency.txt")]
    /// let length = HalfWidth {
    ///     variable: Pendulum::l.index(),
    ///     limits: (1e-3, 0.1),
    ///     cost: Cost::reciprocal(0.0, 1.0, 1.0),
    /// };
    /// let choices = Choices { half_widths: vec![length], nominals: vec![], failure: vec![1e-3] };
    /// println!("{}", study.allocation(&[Requirement::at_least(frequency, 4.0)], &choices)?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`], [`Study::tolerances`], [`Requirements::new`] and
    /// [`allocation::allocate`](crate::allocation::allocate).
    pub fn allocation(&self, wanted: &[Requirement], choices: &Choices<'_>) -> Result<Allocation, Error> {
        let toleranced = TolerancedMachine::of(&self.settings, &self.mechanism)?;
        allocate(&toleranced.requirements(wanted)?, choices, &self.sampling())
    }
}

/// What requirements are about.
type TolerancedMachine<'a> = Toleranced<'a, dyn CurvatureKernels + 'a>;

impl TolerancedMachine<'_> {
    fn requirements(&self, wanted: &[Requirement]) -> Result<Requirements<'_>, Error> {
        let (state, modes) = self.solved();
        Requirements::new(self.kernels(), state, modes, self.tolerances, wanted.to_vec())
    }
}
