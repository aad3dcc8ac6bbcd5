//! A study with its equilibrium and modes: what follows from them is not solved again for every question.

use super::Study;
use crate::clusters::{self, ClusterTolerance, DirectionalDerivatives};
use crate::kernels::{BatchKernels, CurvatureKernels, DirectionalKernels, Kernels};
use crate::modes::{self, Whirl};
use crate::second_order::{self, Band, ModeCurvature, ModeMargin, SecondOrder};
use crate::sensitivity::{self, EquilibriumShift, OutputSensitivities, Quantity};
use crate::shapes::{self, ShapeSensitivity};
use crate::summary::{self, Summary};
use crate::tolerance::{self, OutputTolerances};
use crate::{Equilibrium, Error, FirstOrder, Modes, MonteCarlo, Sensitivities};

/// The equilibrium and the modes of a study, and what else can be asked of them. Each method is that of [`Study`] of the same
/// name.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved<'a, M> {
    pub(super) study: &'a Study<M>,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// Its modes.
    pub modes: Modes,
}

impl<M: Kernels> Solved<'_, M> {
    /// How the equilibrium moves ([`sensitivity::equilibrium_shift`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift, Error> {
        sensitivity::equilibrium_shift(&self.study.mechanism, &self.equilibrium)
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn outputs(&self) -> Result<OutputSensitivities, Error> {
        sensitivity::output_sensitivities(&self.study.mechanism, &self.equilibrium)
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    ///
    /// # Errors
    /// Those of output sensitivities and tolerances.
    pub fn output_tolerances(&self) -> Result<OutputTolerances, Error> {
        let tolerances = self.study.tolerances()?;
        tolerance::output_tolerances(&self.outputs()?, &tolerances)
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn sensitivities(&self) -> Result<Sensitivities, Error> {
        sensitivity::sensitivities(&self.study.mechanism, &self.equilibrium, &self.modes)
    }

    /// First-order spread of the frequencies ([`tolerance::first_order`]).
    ///
    /// # Errors
    /// Those of sensitivities and tolerances.
    pub fn first_order(&self) -> Result<FirstOrder, Error> {
        let tolerances = self.study.tolerances()?;
        let slopes = self.sensitivities()?;
        tolerance::first_order(&self.modes, &slopes, &tolerances)
    }

    /// How each mode whirls ([`modes::whirls`]).
    pub fn whirls(&self) -> Vec<Option<Whirl>> {
        modes::whirls(&self.study.mechanism, &self.equilibrium, &self.modes)
    }
}

impl<M: DirectionalKernels> Solved<'_, M> {
    /// Derivatives of the eigenvalues of one mode, counted from 0, and of those equal to it, along a change of inputs and
    /// design variables ([`clusters::directional_derivatives`]).
    ///
    /// # Errors
    /// Those of the function.
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

    /// Derivatives of the shapes of one mode, counted from 0 ([`shapes::shape_sensitivity`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        shapes::shape_sensitivity(&study.mechanism, equilibrium, modes, mode)
    }

    /// The modes that tolerances bring together, and their spread ([`clusters::clusters`]).
    ///
    /// # Errors
    /// Those of tolerances and the function.
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance>, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        clusters::clusters(&study.mechanism, equilibrium, modes, &study.tolerances()?)
    }
}

impl<M: CurvatureKernels> Solved<'_, M> {
    /// First and second derivatives of one mode, counted from 0 ([`second_order::mode_curvature`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn mode_curvature(&self, mode: usize) -> Result<ModeCurvature, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        second_order::mode_curvature(&study.mechanism, equilibrium, modes, mode)
    }

    /// Spread of every mode to second order ([`second_order::second_order`]).
    ///
    /// # Errors
    /// Those of tolerances; a mode without second derivatives says so itself.
    pub fn second_order(&self) -> Result<SecondOrder, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        let tolerances = study.tolerances()?;
        Ok(second_order::second_order(
            &study.mechanism,
            equilibrium,
            modes,
            &tolerances,
        ))
    }

    /// First order, second order, clusters, and for each mode whether its standard deviation is to be believed
    /// ([`summary::summary`]).
    ///
    /// # Errors
    /// Those of tolerances and the function.
    pub fn summary(&self) -> Result<Summary, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        summary::summary(&study.mechanism, equilibrium, modes, &study.tolerances()?)
    }

    /// Probability that the frequency of one mode, counted from 0, lies in a forbidden band
    /// ([`second_order::mode_margin`]).
    ///
    /// # Errors
    /// Those of tolerances and the function.
    pub fn margin(&self, mode: usize, band: Band) -> Result<ModeMargin, Error> {
        self.margin_of(mode, Quantity::Frequency, band)
    }

    /// As [`Solved::margin`] for any quantity of the mode: [`Quantity::Growth`] between zero and infinity is the
    /// probability that it is unstable.
    ///
    /// # Errors
    /// As [`Solved::margin`].
    pub fn margin_of(
        &self,
        mode: usize,
        quantity: Quantity,
        band: Band,
    ) -> Result<ModeMargin, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        let tolerances = study.tolerances()?;
        let what = (mode, quantity);
        second_order::mode_margin(
            &study.mechanism,
            equilibrium,
            modes,
            what,
            &tolerances,
            band,
        )
    }
}

impl<M: BatchKernels> Solved<'_, M> {
    /// Monte Carlo with re-solved equilibria ([`tolerance::monte_carlo`]).
    ///
    /// # Errors
    /// Those of tolerances and the function.
    pub fn monte_carlo(&self) -> Result<MonteCarlo, Error> {
        self.sample(None)
    }

    /// As [`Solved::monte_carlo`]; `progress` is called with a number of samples whenever that many more are done.
    ///
    /// # Errors
    /// As [`Solved::monte_carlo`].
    pub fn monte_carlo_with_progress(
        &self,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<MonteCarlo, Error> {
        self.sample(Some(progress))
    }

    fn sample(&self, progress: Option<&(dyn Fn(usize) + Sync)>) -> Result<MonteCarlo, Error> {
        let Self {
            study,
            equilibrium,
            modes,
        } = self;
        let tolerances = study.tolerances()?;
        let sampling = study.settings.sampling(progress);
        tolerance::monte_carlo(&study.mechanism, equilibrium, modes, &tolerances, &sampling)
    }
}
