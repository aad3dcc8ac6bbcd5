//! Methods of a study at one operating point.

use core::ops::Range;

use super::Study;
use super::deviating::{Table, Toleranced};
use crate::equilibrium::{self, Assembly, Equilibria, Search};
use crate::kernels::{BatchKernels, Kernels};
use crate::modes::{self, Whirls};
use crate::sensitivity::{self, EquilibriumShift, OutputSensitivities};
use crate::tolerance::{self, OutputTolerances, PartialMonteCarlo, Sampling};
use crate::{Coordinate, Equilibrium, Error, FirstOrder, Modes, MonteCarlo, Sensitivities};

impl<M: Kernels> Study<M> {
    /// Finds the dynamic equilibrium ([`equilibrium::equilibrium`]).
    #[doc = include_str!("example.txt")]
    /// let state = study.equilibrium()?;
    /// let theta = state.coordinates[Pendulum::theta.index()];
    /// assert!((theta.cos() - 1.5 * 9.81 / 25.0).abs() < 1e-12);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::NoEquilibrium`], [`Error::NotAssembled`], [`Error::UnboundedReactions`]; [`Error::NotFinite`],
    /// [`Error::Unphysical`], [`Error::OutsideDomain`] for values that no mechanism can have; [`Error::UnknownHandle`]
    /// for a handle that does not exist.
    pub fn equilibrium(&self) -> Result<Equilibrium, Error> {
        self.settings.equilibrium(&self.mechanism).cloned()
    }

    /// Assembles the mechanism, holding the coordinates that have a [`Study::start`] ([`equilibrium::assemble`]).
    #[doc = include_str!("example.txt")]
    /// let assembled = study.assembly()?;
    /// assert_eq!(assembled.coordinates, [1.0]);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::NotAssembled`], [`Error::NotFinite`], [`Error::Unphysical`], [`Error::OutsideDomain`],
    /// [`Error::UnknownHandle`].
    pub fn assembly(&self) -> Result<Assembly, Error> {
        self.settings.assembly(&self.mechanism)
    }

    /// Searches for distinct equilibria from many starts ([`equilibrium::find_equilibria`]).
    #[doc = include_str!("example.txt")]
    /// use eigentol::equilibrium::Search;
    ///
    /// // Hanging, upside down, and swung out to either side.
    /// let all = study.equilibria(&Search::new([-3.0], [3.5]))?;
    /// assert_eq!(all.len(), 4);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::WrongLength`], [`Error::NotFinite`], [`Error::Unphysical`], [`Error::NotAssembled`],
    /// [`Error::UnknownHandle`]. Finding none is not an error.
    pub fn equilibria(&self, search: &Search) -> Result<Equilibria, Error> {
        let (u, b) = (&self.settings.inputs, &self.settings.design);
        let start = self.settings.assembled_start(&self.mechanism)?;
        let held = self.settings.held_in(Some(search), &start);
        let search = held.as_ref().unwrap_or(search);
        let watch = self.settings.watch();
        equilibrium::find_equilibria(&self.mechanism, u, b, &start, search, watch)
    }

    /// Where to search for equilibria about the start values ([`Search::within`]).
    ///
    /// # Errors
    /// Those of [`Search::within`]; [`Error::NotAssembled`], [`Error::UnknownHandle`].
    pub fn search(&self, bounds: &[(Coordinate<M>, f64, f64)]) -> Result<Search, Error> {
        let start = self.settings.assembled_start(&self.mechanism)?;
        let bounds = bounds.iter();
        let bounds = bounds.map(|(x, low, high)| (x.any(), *low, *high));
        let bounds: Vec<_> = self.settings.held_bounds(&self.mechanism).chain(bounds).collect();
        Search::within(&self.settings.description, &start, &bounds)
    }

    /// Computes the natural modes ([`modes`](crate::modes::modes)). Their shapes are normalised by the mass matrix.
    #[doc = include_str!("example.txt")]
    /// use eigentol::Complex;
    /// use nalgebra::DMatrix;
    ///
    /// for mode in &study.modes()?.modes {
    ///     println!("{:?} rad/s", mode.frequency());
    /// }
    /// let shapes = DMatrix::from(study.modes()?.shapes());
    /// let mass = DMatrix::from(study.equilibrium()?.linear.mass).map(Complex::from);
    /// let product = shapes.adjoint() * mass * &shapes;
    /// assert!((product[(0, 0)].re - 1.0).abs() < 1e-12);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium`]; [`Error::SingularConfiguration`], [`Error::SingularMass`], [`Error::ModesNotFound`],
    /// [`Error::EigenvalueRange`]; of undamped modes [`Error::NonsymmetricStiffness`] and [`Error::NoUndampedModes`].
    pub fn modes(&self) -> Result<Modes, Error> {
        Ok(self.solved()?.1.clone())
    }

    /// Derivatives of the equilibrium with respect to every input and design variable
    /// ([`sensitivity::equilibrium_shift`]).
    #[doc = include_str!("example.txt")]
    /// let shift = study.equilibrium_shift()?;
    /// assert!(shift.by_input[Pendulum::theta.index()][Pendulum::omega.index()] > 0.0);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium`]; [`Error::SingularConfiguration`], [`Error::CriticalState`],
    /// [`Error::ClosesHereOnly`], [`Error::OutsideDomain`].
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        sensitivity::equilibrium_shift(&self.mechanism, state)
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    #[doc = include_str!("example.txt")]
    /// let outputs = study.outputs()?;
    /// println!("the angle is {} rad", outputs.values[Pendulum::angle.index()]);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium_shift`]; [`Error::InfiniteOutput`].
    pub fn outputs(&self) -> Result<OutputSensitivities, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        sensitivity::output_sensitivities(&self.mechanism, state)
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.output_tolerances()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::outputs`] and [`Study::tolerances`].
    pub fn output_tolerances(&self) -> Result<OutputTolerances, Error> {
        let table = Table::<dyn Kernels>::deviating(&self.settings, &self.mechanism)?;
        let state = table.state(self.settings.regular(&self.mechanism)?);
        let outputs = sensitivity::output_sensitivities(table.kernels(), &state)?;
        tolerance::output_tolerances(&outputs, self.settings.tolerances()?)
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    #[doc = include_str!("example.txt")]
    /// let slopes = study.sensitivities()?;
    /// let by_design = slopes.modes[0].frequency().map(|slopes| slopes.by_design);
    /// println!("{:?} rad/s per metre", by_design.map(|slopes| slopes[Pendulum::l.index()]));
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`]; [`Error::CriticalState`], [`Error::ClosesHereOnly`], [`Error::OutsideDomain`].
    pub fn sensitivities(&self) -> Result<Sensitivities, Error> {
        self.settings.sensitivities(&self.mechanism).cloned()
    }

    /// First-order spread of the modes and frequencies ([`tolerance::first_order`]).
    #[doc = include_str!("example.txt")]
    /// let spread = study.first_order()?;
    /// println!("{spread}");
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sensitivities`] and [`Study::tolerances`].
    pub fn first_order(&self) -> Result<FirstOrder, Error> {
        let toleranced = Toleranced::<dyn Kernels>::of(&self.settings, &self.mechanism)?;
        tolerance::first_order(toleranced.solved().1, &*toleranced.sensitivities()?, toleranced.tolerances)
    }

    /// Classifies each mode as whirling forward, backward or not at all ([`modes::whirls`](crate::modes::whirls)).
    #[doc = include_str!("example.txt")]
    /// for whirl in study.whirls()?.into_iter().flatten() {
    ///     println!("{whirl}");
    /// }
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`].
    pub fn whirls(&self) -> Result<Whirls, Error> {
        let (state, modes) = self.solved()?;
        Ok(modes::whirls(&self.mechanism, state, modes))
    }

    /// The equilibrium and its modes.
    pub(super) fn solved(&self) -> Result<(&Equilibrium, &Modes), Error> {
        self.settings.solved(&self.mechanism)
    }
}

impl<M: BatchKernels> Study<M> {
    /// Monte Carlo simulation that solves the equilibrium anew for every sample ([`tolerance::monte_carlo`]).
    #[doc = include_str!("example.txt")]
    /// let run = study.samples(500).monte_carlo()?;
    /// assert_eq!(run.counts.stable, 500);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`] and [`Study::tolerances`], of the nominal design; [`Error::Threads`].
    pub fn monte_carlo(&self) -> Result<MonteCarlo, Error> {
        let toleranced = Toleranced::<dyn BatchKernels>::of(&self.settings, &self.mechanism)?;
        let ((state, modes), sampling) = (toleranced.solved(), self.sampling());
        tolerance::monte_carlo(toleranced.kernels(), state, modes, toleranced.tolerances, &sampling)
    }

    /// Solves part of the samples of [`Study::monte_carlo`], possibly on another machine: merged parts give the same
    /// bits as the whole run.
    #[doc = include_str!("example.txt")]
    /// let study = study.samples(3000);
    /// let mut all = study.samples_between(1000..3000)?;
    /// all.merge(study.samples_between(0..1000)?)?;
    /// all.check_complete()?;
    /// assert_eq!(all.result(), study.monte_carlo()?);
    ///
    /// // The samples themselves, if they are kept.
    /// let mut part = study.keep_samples(true).samples_between(300..400)?;
    /// let samples = part.take_samples();
    /// assert_eq!((samples.len(), samples[0].0), (100, 300));
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::monte_carlo`]; [`Error::Setting`] for a range beyond the samples.
    pub fn samples_between(&self, range: Range<u64>) -> Result<PartialMonteCarlo, Error> {
        self.sample_modes(&self.sampling().range(Some(range)))
    }

    /// Like [`Study::samples_between`], with custom settings, for example to watch and stop a run
    /// ([`tolerance::partial_monte_carlo`]).
    #[doc = include_str!("example.txt")]
    /// use std::sync::atomic::{AtomicBool, Ordering};
    ///
    /// let study = study.samples(10_000).threads(1);
    /// let stop = AtomicBool::new(false);
    /// // Enough after the first samples; a handler of Ctrl-C would do the same.
    /// let progress = |_| stop.store(true, Ordering::Relaxed);
    /// let sampling = study.sampling().progress(Some(&progress)).stop(Some(&stop));
    /// let mut part = study.sample_modes(&sampling)?;
    /// assert_eq!((part.result().samples, part.result().planned), (256, 10_000));
    ///
    /// // Nothing is lost: later the rest follows.
    /// study.resume_samples(&mut part, &study.sampling())?;
    /// assert_eq!(part.result(), study.monte_carlo()?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::samples_between`].
    pub fn sample_modes(&self, sampling: &Sampling<'_>) -> Result<PartialMonteCarlo, Error> {
        let toleranced = Toleranced::<dyn BatchKernels>::of(&self.settings, &self.mechanism)?;
        let (state, modes) = toleranced.solved();
        tolerance::partial_monte_carlo(toleranced.kernels(), state, modes, toleranced.tolerances, sampling)
    }

    /// Solves the missing samples of a run, unless it is stopped again; see [`Study::sample_modes`].
    ///
    /// # Errors
    /// As [`Study::sample_modes`]; [`Error::OtherRun`] where it is not a run of this study.
    pub fn resume_samples(&self, done: &mut PartialMonteCarlo, sampling: &Sampling<'_>) -> Result<(), Error> {
        let part = |range| self.sample_modes(&sampling.clone().range(Some(range)));
        // Reject a run of another study before any work is done.
        done.merge(part(0..0)?)?;
        for range in done.missing() {
            done.merge(part(range)?)?;
        }
        Ok(())
    }
}
