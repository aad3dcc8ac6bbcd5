//! A study whose equilibrium and modes are solved once for all questions.

use core::ops::Range;

use super::Study;
use super::subject::SolvedSubject;
use crate::clusters::{self, ClusterTolerance, DirectionalDerivatives};
use crate::kernels::{BatchKernels, CurvatureKernels, DirectionalKernels, Kernels, PictureKernels};
use crate::modes::{self, Whirls};
use crate::picture::{self, ModePictures, Scene};
use crate::second_order::{self, Band, ModeCurvature, ModeMargin, OutputCurvature, SecondOrder};
use crate::sensitivity::{self, EquilibriumShift, OutputSensitivities, Quantity};
use crate::shapes::{self, ShapeSensitivity};
use crate::tolerance::{self, OutputTolerances, PartialMonteCarlo, Sampling};
use crate::{Equilibrium, Error, FirstOrder, Modes, MonteCarlo, Output, Sensitivities};

/// The equilibrium and the modes of a study, solved once for all questions that build on them.
///
/// Methods have the same names as those of [`Study`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solved<'a, M> {
    pub(super) study: &'a Study<M>,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// Its modes.
    pub modes: Modes,
}

impl<'a, M: Kernels> Solved<'a, M> {
    /// An unsolved value, to be solved in place: the results are large to move.
    #[inline]
    pub(super) fn blank(study: &'a Study<M>) -> Self {
        let settings = &study.settings;
        Self {
            study,
            equilibrium: settings.blank_state(),
            modes: Modes::empty(settings.family(), &settings.description),
        }
    }

    #[inline]
    pub(super) fn solve(&mut self) -> Result<(), Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        study
            .settings
            .solve_into(&study.mechanism, equilibrium, modes)
    }

    /// Derivatives of the equilibrium with respect to every input and design variable
    /// ([`sensitivity::equilibrium_shift`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.equilibrium_shift()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::CriticalState`], [`Error::ClosesHereOnly`], [`Error::OutsideDomain`].
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift, Error> {
        sensitivity::equilibrium_shift(&self.study.mechanism, &self.equilibrium)
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.outputs()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::equilibrium_shift`]; [`Error::InfiniteOutput`].
    pub fn outputs(&self) -> Result<OutputSensitivities, Error> {
        sensitivity::output_sensitivities(&self.study.mechanism, &self.equilibrium)
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.output_tolerances()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::equilibrium_shift`] and [`Study::tolerances`].
    pub fn output_tolerances(&self) -> Result<OutputTolerances, Error> {
        self.subject::<dyn Kernels>(&self.study.mechanism)
            .output_tolerances()
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.sensitivities()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::equilibrium_shift`].
    pub fn sensitivities(&self) -> Result<Sensitivities, Error> {
        sensitivity::sensitivities(&self.study.mechanism, &self.equilibrium, &self.modes)
    }

    /// First-order spread of the modes and frequencies ([`tolerance::first_order`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.first_order()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`] and [`Study::tolerances`].
    pub fn first_order(&self) -> Result<FirstOrder, Error> {
        self.subject::<dyn Kernels>(&self.study.mechanism)
            .first_order()
    }

    /// Classifies each mode as whirling forward, backward or not at all ([`modes::whirls`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// for whirl in study.solve()?.whirls().into_iter().flatten() {
    ///     println!("{whirl}");
    /// }
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    #[must_use]
    pub fn whirls(&self) -> Whirls {
        modes::whirls(&self.study.mechanism, &self.equilibrium, &self.modes)
    }
}

impl<M: PictureKernels> Solved<'_, M> {
    /// The visible scene at the equilibrium: poses and shapes of the bodies ([`picture::scene`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let scene = study.solve()?.picture()?;
    /// println!("{}: {:?}", scene.bodies[1].name, scene.bodies[1].pose);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideDomain`].
    pub fn picture(&self) -> Result<Scene, Error> {
        let Equilibrium {
            coordinates,
            inputs,
            design,
            ..
        } = &self.equilibrium;
        picture::scene(&self.study.mechanism, coordinates, inputs, design)
    }

    /// Poses of all bodies over one period of a mode (counted from 0), at `phases` evenly spaced phases.
    ///
    /// The largest displacement to either side is the fraction `amplitude` of the size of the mechanism
    /// ([`picture::mode_pictures`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let swing = study.solve()?.mode_pictures(0, 24, 0.1)?;
    /// println!("{:?}", swing.frames[6][1].position);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchMode`], [`Error::OutsideDomain`], [`Error::Setting`].
    pub fn mode_pictures(
        &self,
        mode: usize,
        phases: usize,
        amplitude: f64,
    ) -> Result<ModePictures, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        let mechanism = &study.mechanism;
        picture::mode_pictures(mechanism, equilibrium, modes, mode, phases, amplitude)
    }
}

impl<M: DirectionalKernels> Solved<'_, M> {
    /// Derivatives of the eigenvalue of one mode (counted from 0), and of all eigenvalues equal to it, along a
    /// direction in the space of inputs and design variables ([`clusters::directional_derivatives`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let slopes = study.solve()?.directional_derivatives(0, (&[1.0], &[0.0, 0.0]))?;
    /// println!("{:?} rad/s per rad/s", slopes.frequencies);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`]; [`Error::WrongLength`], [`Error::NoSuchMode`], [`Error::Defective`].
    pub fn directional_derivatives(
        &self,
        mode: usize,
        direction: (&[f64], &[f64]),
    ) -> Result<DirectionalDerivatives, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        clusters::directional_derivatives(&study.mechanism, equilibrium, modes, mode, direction)
    }

    /// Derivatives of the mode shapes of one mode, counted from 0 ([`shapes::shape_sensitivity`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let slopes = study.solve()?.shape_sensitivity(0)?;
    /// println!("{}", slopes.right_by_design[Pendulum::l.index()][Pendulum::theta.index()]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`]; [`Error::NoSuchMode`], [`Error::ClusteredMode`].
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        shapes::shape_sensitivity(&study.mechanism, equilibrium, modes, mode)
    }

    /// Finds the clusters of modes that mix within the tolerances, and their spread ([`clusters::clusters`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// assert!(study.solve()?.clusters()?.is_empty());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`] and [`Study::tolerances`].
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance>, Error> {
        self.subject::<dyn DirectionalKernels>(&self.study.mechanism)
            .clusters()
    }
}

impl<M: CurvatureKernels> Solved<'_, M> {
    /// First and second derivatives of one mode, counted from 0 ([`second_order::mode_curvature`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let second = study.solve()?.mode_curvature(0)?.lambda.by_design;
    /// println!("{second:?}");
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::sensitivities`]; [`Error::NoSuchMode`], [`Error::ClusteredMode`].
    pub fn mode_curvature(&self, mode: usize) -> Result<ModeCurvature, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        second_order::mode_curvature(&study.mechanism, equilibrium, modes, mode)
    }

    /// First and second derivatives of one output ([`second_order::output_curvature`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let angle = study.solve()?.output_curvature(Pendulum::angle)?;
    /// let l = Pendulum::l.index();
    /// println!("{} rad per square metre", angle.second.by_design[l][l]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::outputs`]; [`Error::NoSensitivity`] where the output is not smooth.
    pub fn output_curvature(&self, output: Output<M>) -> Result<OutputCurvature, Error> {
        let (mechanism, at) = (&self.study.mechanism, &self.equilibrium);
        second_order::output_curvature(mechanism, at, output.any())
    }

    /// Second-order spread of every mode ([`second_order::second_order`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.solve()?.second_order()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`]; a mode without second derivatives carries its own error.
    pub fn second_order(&self) -> Result<SecondOrder, Error> {
        self.subject::<dyn CurvatureKernels>(&self.study.mechanism)
            .second_order()
    }

    /// Probability that the frequency of one mode (counted from 0) lies in a forbidden band
    /// ([`second_order::mode_margin`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::second_order::Band;
    ///
    /// let band = Band::around(Pendulum::omega.any(), 0.1);
    /// println!("{}", study.solve()?.margin(0, band)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::mode_curvature`] and [`Study::tolerances`]; [`Error::NotOscillating`], and [`Error::Setting`] for
    /// an invalid band.
    pub fn margin(&self, mode: usize, band: Band) -> Result<ModeMargin, Error> {
        self.margin_of(mode, Quantity::Frequency, band)
    }

    /// Like [`Solved::margin`], for any quantity of the mode: with [`Quantity::Growth`] between zero and infinity it is
    /// the probability that the mode is unstable.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::Quantity;
    /// use eigentol::second_order::Band;
    ///
    /// let band = Band::around(Pendulum::omega.any(), 0.1);
    /// println!("{}", study.solve()?.margin_of(0, Quantity::NaturalFrequency, band)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::margin`].
    pub fn margin_of(
        &self,
        mode: usize,
        quantity: Quantity,
        band: Band,
    ) -> Result<ModeMargin, Error> {
        self.subject::<dyn CurvatureKernels>(&self.study.mechanism)
            .margin((mode, quantity), band)
    }
}

impl<M: BatchKernels> Solved<'_, M> {
    /// Monte Carlo simulation that solves the equilibrium anew for every sample ([`tolerance::monte_carlo`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let study = study.samples(500);
    /// println!("{}", study.solve()?.monte_carlo()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::tolerances`]; [`Error::Threads`].
    pub fn monte_carlo(&self) -> Result<MonteCarlo, Error> {
        self.drawn(&self.study.sampling())
    }

    /// Like [`Solved::monte_carlo`], calling `progress` with the number of samples done since its last call.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let study = study.samples(500);
    /// let dots = |_| print!(".");
    /// println!("{}", study.solve()?.monte_carlo_with_progress(&dots)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Solved::monte_carlo`].
    pub fn monte_carlo_with_progress(
        &self,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<MonteCarlo, Error> {
        self.drawn(&self.study.sampling().progress(Some(progress)))
    }

    fn drawn(&self, sampling: &Sampling<'_>) -> Result<MonteCarlo, Error> {
        self.subject::<dyn BatchKernels>(&self.study.mechanism)
            .monte_carlo(sampling)
    }

    /// See [`Study::samples_between`].
    ///
    /// # Errors
    /// As [`Study::samples_between`].
    pub fn samples_between(&self, range: Range<u64>) -> Result<PartialMonteCarlo, Error> {
        self.sample_modes(&self.study.sampling().range(Some(range)))
    }

    /// See [`Study::sample_modes`].
    ///
    /// # Errors
    /// As [`Study::sample_modes`].
    pub fn sample_modes(&self, sampling: &Sampling<'_>) -> Result<PartialMonteCarlo, Error> {
        self.subject::<dyn BatchKernels>(&self.study.mechanism)
            .partial_monte_carlo(sampling)
    }

    /// See [`Study::resume_samples`].
    ///
    /// # Errors
    /// As [`Study::resume_samples`].
    pub fn resume_samples(
        &self,
        done: &mut PartialMonteCarlo,
        sampling: &Sampling<'_>,
    ) -> Result<(), Error> {
        let part = |range| self.sample_modes(&sampling.clone().range(Some(range)));
        // Reject a run of another study before any work is done.
        done.merge(part(0..0)?)?;
        for range in done.missing() {
            done.merge(part(range)?)?;
        }
        Ok(())
    }
}

impl SolvedSubject<'_, dyn Kernels + '_> {
    fn output_tolerances(&self) -> Result<OutputTolerances, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let outputs = sensitivity::output_sensitivities(own.kernels, own.equilibrium)?;
            tolerance::output_tolerances(&outputs, tolerances)
        })
    }

    fn first_order(&self) -> Result<FirstOrder, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let slopes = sensitivity::sensitivities(own.kernels, own.equilibrium, own.modes)?;
            tolerance::first_order(own.modes, &slopes, tolerances)
        })
    }
}

impl SolvedSubject<'_, dyn DirectionalKernels + '_> {
    fn clusters(&self) -> Result<Vec<ClusterTolerance>, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            clusters::clusters(own.kernels, own.equilibrium, own.modes, tolerances)
        })
    }
}

impl SolvedSubject<'_, dyn CurvatureKernels + '_> {
    fn second_order(&self) -> Result<SecondOrder, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let (at, modes) = (own.equilibrium, own.modes);
            Ok(second_order::second_order(
                own.kernels,
                at,
                modes,
                tolerances,
            ))
        })
    }

    fn margin(&self, what: (usize, Quantity), band: Band) -> Result<ModeMargin, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let (at, modes) = (own.equilibrium, own.modes);
            second_order::mode_margin(own.kernels, at, modes, what, tolerances, band)
        })
    }
}

impl SolvedSubject<'_, dyn BatchKernels + '_> {
    fn monte_carlo(&self, sampling: &Sampling<'_>) -> Result<MonteCarlo, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let (at, modes) = (own.equilibrium, own.modes);
            tolerance::monte_carlo(own.kernels, at, modes, tolerances, sampling)
        })
    }

    fn partial_monte_carlo(&self, sampling: &Sampling<'_>) -> Result<PartialMonteCarlo, Error> {
        self.deviating(|own| {
            let tolerances = own.settings.tolerances()?;
            let (at, modes) = (own.equilibrium, own.modes);
            tolerance::partial_monte_carlo(own.kernels, at, modes, tolerances, sampling)
        })
    }
}
