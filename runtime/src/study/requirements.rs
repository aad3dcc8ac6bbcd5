//! Requirements of a study: the probability of meeting them, and the cheapest tolerances that do.

use super::subject::SolvedSubject;
use super::{Solved, Study};
use crate::Error;
use crate::allocation::{Allocation, Choices, allocate};
use crate::kernels::DirectionalKernels;
use crate::requirement::{
    Chances, FormSettings, Probabilities, RareFailure, Reliability, Requirement, Requirements,
    SamplingSettings,
};
use crate::tolerance::Sampling;

impl<M: DirectionalKernels> Solved<'_, M> {
    /// How probable it is that each requirement, and that any, is failed, with nothing to choose: by design points,
    /// lines of designs, or the study's number of samples ([`Requirements::probabilities`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let found = study.solve()?.probability(&[Requirement::at_least(first, 3.9)])?;
    /// assert!(found.each[0].value < 1e-6 && found.each[0].interval.upper < 1e-6);
    /// println!("{found}");
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`], [`Requirements::new`] and [`Requirements::probabilities`].
    pub fn probability(&self, wanted: &[Requirement]) -> Result<Probabilities, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .probability(wanted)
    }

    /// Probabilities of meeting the requirements, jointly and individually, from the study's number of samples
    /// ([`Requirements::chances`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let wanted = [Requirement::at_least(first, 4.0), Requirement::Stable];
    /// println!("{}", study.solve()?.chances(&wanted)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`], [`Requirements::new`] and [`Requirements::chances`].
    pub fn chances(&self, wanted: &[Requirement]) -> Result<Chances, Error> {
        self.chances_by(wanted, &self.study.sampling())
    }

    /// Like [`Solved::chances`], with custom settings, for example a range of the samples, or a run to watch and stop.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let (study, wanted) = (study.samples(1000), [Requirement::at_least(first, 4.0)]);
    /// let part = |range| study.chances_by(&wanted, &study.sampling().range(Some(range)));
    /// let failed = part(0..300)?.all.failed + part(300..1000)?.all.failed;
    /// assert_eq!(failed, study.chances(&wanted)?.all.failed);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::chances`].
    pub fn chances_by(
        &self,
        wanted: &[Requirement],
        sampling: &Sampling<'_>,
    ) -> Result<Chances, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .chances_by(wanted, sampling)
    }

    /// Failure probabilities from design points, with importance factors and exact derivatives
    /// ([`Requirements::reliability`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::Requirement;
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let found = study.solve()?.reliability(&[Requirement::at_least(first, 4.0)])?;
    /// assert!(found.verified());
    /// println!("{found}");
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`], [`Requirements::new`] and [`Requirements::reliability`].
    pub fn reliability(&self, wanted: &[Requirement]) -> Result<Reliability, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .reliability(wanted)
    }

    /// Estimates a small probability of failing any requirement by importance sampling about the design points
    /// ([`Requirements::rare_failure`]), with the seed, stream and threads of the study.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::requirement::{Requirement, SamplingSettings};
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let settings = SamplingSettings::default();
    /// println!("{}", study.solve()?.rare_failure(&[Requirement::at_least(first, 3.9)], &settings)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::reliability`] and [`Requirements::rare_failure`].
    pub fn rare_failure(
        &self,
        wanted: &[Requirement],
        settings: &SamplingSettings,
    ) -> Result<RareFailure, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .rare_failure(wanted, settings)
    }

    /// Finds the cheapest tolerances that meet the requirements, checked with the study's number of samples
    /// ([`allocation::allocate`](crate::allocation::allocate)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::allocation::{Choices, Cost, HalfWidth};
    /// use eigentol::requirement::Requirement;
    /// use eigentol::response::Response;
    /// use eigentol::Quantity;
    ///
    /// let first = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    /// let length = HalfWidth {
    ///     variable: Pendulum::l.index(),
    ///     limits: (1e-3, 0.1),
    ///     cost: Cost::reciprocal(0.0, 1.0, 1.0),
    /// };
    /// let choices = Choices { half_widths: vec![length], nominals: vec![], failure: vec![1e-3] };
    /// println!("{}", study.solve()?.allocation(&[Requirement::at_least(first, 4.0)], &choices)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`], [`Requirements::new`] and [`allocation::allocate`](crate::allocation::allocate).
    pub fn allocation(
        &self,
        wanted: &[Requirement],
        choices: &Choices<'_>,
    ) -> Result<Allocation, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .allocation(wanted, choices)
    }
}

impl<M: DirectionalKernels> Study<M> {
    /// How probable it is that requirements are failed; see [`Solved::probability`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::probability`].
    pub fn probability(&self, wanted: &[Requirement]) -> Result<Probabilities, Error> {
        self.solve()?.probability(wanted)
    }

    /// Probabilities of meeting requirements; see [`Solved::chances`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::chances`].
    pub fn chances(&self, wanted: &[Requirement]) -> Result<Chances, Error> {
        self.solve()?.chances(wanted)
    }

    /// Probabilities of meeting requirements, with custom settings; see [`Solved::chances_by`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::chances`].
    pub fn chances_by(
        &self,
        wanted: &[Requirement],
        sampling: &Sampling<'_>,
    ) -> Result<Chances, Error> {
        self.solve()?.chances_by(wanted, sampling)
    }

    /// Failure probabilities from design points; see [`Solved::reliability`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::reliability`].
    pub fn reliability(&self, wanted: &[Requirement]) -> Result<Reliability, Error> {
        self.solve()?.reliability(wanted)
    }

    /// A small probability of failing any requirement; see [`Solved::rare_failure`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::rare_failure`].
    pub fn rare_failure(
        &self,
        wanted: &[Requirement],
        settings: &SamplingSettings,
    ) -> Result<RareFailure, Error> {
        self.solve()?.rare_failure(wanted, settings)
    }

    /// The cheapest tolerances that meet requirements; see [`Solved::allocation`].
    ///
    /// # Errors
    /// As [`Study::modes`] and [`Solved::allocation`].
    pub fn allocation(
        &self,
        wanted: &[Requirement],
        choices: &Choices<'_>,
    ) -> Result<Allocation, Error> {
        self.solve()?.allocation(wanted, choices)
    }
}

impl SolvedSubject<'_, dyn DirectionalKernels + '_> {
    fn probability(&self, wanted: &[Requirement]) -> Result<Probabilities, Error> {
        self.deviating(|own| {
            let watch = own.settings.watch();
            let requirements = own.requirements(wanted)?.watched(watch);
            // The designs report themselves.
            let sampling = own.settings.sampling().progress(None);
            requirements.probabilities(&sampling.stop(watch.stop))
        })
    }

    fn chances_by(
        &self,
        wanted: &[Requirement],
        sampling: &Sampling<'_>,
    ) -> Result<Chances, Error> {
        self.deviating(|own| own.requirements(wanted)?.chances(sampling))
    }

    fn reliability(&self, wanted: &[Requirement]) -> Result<Reliability, Error> {
        self.deviating(|own| {
            own.requirements(wanted)?
                .watched(own.settings.watch())
                .reliability(&FormSettings::default())
        })
    }

    fn rare_failure(
        &self,
        wanted: &[Requirement],
        settings: &SamplingSettings,
    ) -> Result<RareFailure, Error> {
        self.deviating(|own| {
            let settings = SamplingSettings {
                seed: own.settings.seed,
                stream: own.settings.stream,
                ..settings.clone()
            };
            let requirements = own.requirements(wanted)?.watched(own.settings.watch());
            let about = requirements.reliability(&FormSettings::default())?;
            requirements.rare_failure(&about, &settings, own.settings.threads)
        })
    }

    fn allocation(
        &self,
        wanted: &[Requirement],
        choices: &Choices<'_>,
    ) -> Result<Allocation, Error> {
        self.deviating(|own| {
            let sampling = own.settings.sampling();
            allocate(&own.requirements(wanted)?, choices, &sampling)
        })
    }

    fn requirements(&self, wanted: &[Requirement]) -> Result<Requirements<'_>, Error> {
        let tolerances = self.settings.tolerances()?;
        let (at, modes) = (self.equilibrium, self.modes);
        Requirements::new(self.kernels, at, modes, tolerances, wanted.to_vec())
    }
}
