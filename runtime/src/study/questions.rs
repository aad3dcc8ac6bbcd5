//! What a study can be asked at one operating point.

use super::{Solved, Study};
use crate::clusters::{ClusterTolerance, DirectionalDerivatives};
use crate::equilibrium::{self, Assembly, Search};
use crate::kernels::{BatchKernels, CurvatureKernels, DirectionalKernels, Kernels};
use crate::modes::Whirl;
use crate::second_order::{Band, ModeCurvature, ModeMargin, SecondOrder};
use crate::sensitivity;
use crate::sensitivity::{EquilibriumShift, OutputSensitivities, Quantity};
use crate::shapes::ShapeSensitivity;
use crate::summary::Summary;
use crate::tolerance;
use crate::tolerance::OutputTolerances;
use crate::{Equilibrium, Error, FirstOrder, Modes, MonteCarlo, Sensitivities};

impl<M: Kernels> Study<M> {
    /// The dynamic equilibrium ([`equilibrium::equilibrium`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let state = study.equilibrium()?;
    /// let theta = state.coordinates[Pendulum::theta.index()];
    /// assert!((theta.cos() - 1.5 * 9.81 / 25.0).abs() < 1e-12);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the function, and [`Error::UnknownHandle`] when a builder method was given a handle that does not exist.
    pub fn equilibrium(&self) -> Result<Equilibrium, Error> {
        self.settings.equilibrium(&self.mechanism)
    }

    /// The mechanism put together, coordinates with a [`Study::start`] held ([`equilibrium::assemble`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn assembly(&self) -> Result<Assembly, Error> {
        self.settings.assembly(&self.mechanism)
    }

    /// Distinct equilibria from many starts ([`equilibrium::find_equilibria`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn equilibria(&self, search: &Search) -> Result<Vec<Equilibrium>, Error> {
        let (u, b) = (&self.settings.inputs, &self.settings.design);
        let start = self.settings.assembled_start(&self.mechanism)?;
        equilibrium::find_equilibria(&self.mechanism, u, b, &start, search)
    }

    /// The equilibrium and its modes, to ask several questions of them.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let solved = study.solve()?;
    /// println!("{}{}", solved.equilibrium, solved.modes);
    /// println!("{}{}", solved.first_order()?, solved.second_order()?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::modes`].
    pub fn solve(&self) -> Result<Solved<'_, M>, Error> {
        let (equilibrium, modes) = self.settings.solve(&self.mechanism)?;
        Ok(Solved {
            study: self,
            equilibrium,
            modes,
        })
    }

    /// The natural modes ([`modes`](crate::modes::modes)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// for mode in &study.modes()?.modes {
    ///     println!("{:?} rad/s", mode.frequency());
    /// }
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn modes(&self) -> Result<Modes, Error> {
        Ok(self.solve()?.modes)
    }

    /// How the equilibrium moves ([`sensitivity::equilibrium_shift`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let shift = study.equilibrium_shift()?;
    /// assert!(shift.by_input[Pendulum::theta.index()][Pendulum::omega.index()] > 0.0);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        sensitivity::equilibrium_shift(&self.mechanism, &state)
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let outputs = study.outputs()?;
    /// println!("the angle is {} rad", outputs.values[Pendulum::angle.index()]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn outputs(&self) -> Result<OutputSensitivities, Error> {
        let state = self.settings.regular(&self.mechanism)?;
        sensitivity::output_sensitivities(&self.mechanism, &state)
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    ///
    /// # Errors
    /// Those of equilibrium, output sensitivities and tolerances.
    pub fn output_tolerances(&self) -> Result<OutputTolerances, Error> {
        let outputs = self.outputs()?;
        tolerance::output_tolerances(&outputs, &self.tolerances()?)
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let slopes = study.sensitivities()?;
    /// let by_design = slopes.modes[0].omega_by_design.as_ref();
    /// println!("{:?} rad/s per metre", by_design.map(|slopes| slopes[Pendulum::l.index()]));
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the equilibrium, the modes and the function.
    pub fn sensitivities(&self) -> Result<Sensitivities, Error> {
        self.solve()?.sensitivities()
    }

    /// First-order spread of the frequencies ([`tolerance::first_order`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let spread = study.first_order()?;
    /// println!("{spread}");
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of equilibrium, modes, sensitivities and tolerances.
    pub fn first_order(&self) -> Result<FirstOrder, Error> {
        self.solve()?.first_order()
    }

    /// How each mode whirls ([`modes::whirls`](crate::modes::whirls)).
    ///
    /// # Errors
    /// Those of equilibrium and modes.
    pub fn whirls(&self) -> Result<Vec<Option<Whirl>>, Error> {
        Ok(self.solve()?.whirls())
    }
}

impl<M: DirectionalKernels> Study<M> {
    /// Derivatives of the eigenvalues of one mode, counted from 0, and of those equal to it, along a change of inputs and
    /// design variables ([`directional_derivatives`](crate::clusters::directional_derivatives)).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn directional_derivatives(
        &self,
        mode: usize,
        direction: (&[f64], &[f64]),
    ) -> Result<DirectionalDerivatives, Error> {
        self.solve()?.directional_derivatives(mode, direction)
    }

    /// Derivatives of the shapes of one mode, counted from 0 ([`shape_sensitivity`](crate::shapes::shape_sensitivity)).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity, Error> {
        self.solve()?.shape_sensitivity(mode)
    }

    /// The modes that tolerances bring together, and their spread ([`clusters`](crate::clusters::clusters)).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance>, Error> {
        self.solve()?.clusters()
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// First and second derivatives of one mode, counted from 0 ([`mode_curvature`](crate::second_order::mode_curvature)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let second = study.mode_curvature(0)?.lambda.by_design;
    /// let l = Pendulum::l.index();
    /// println!("{} 1/s^2 per square metre", second[l][l]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn mode_curvature(&self, mode: usize) -> Result<ModeCurvature, Error> {
        self.solve()?.mode_curvature(mode)
    }

    /// Spread of every mode to second order ([`second_order`](crate::second_order::second_order)).
    ///
    /// # Errors
    /// Those of equilibrium, modes and tolerances; a mode without second derivatives says so itself.
    pub fn second_order(&self) -> Result<SecondOrder, Error> {
        self.solve()?.second_order()
    }

    /// First order, second order, clusters, and for each mode whether its standard deviation is to be believed
    /// ([`summary`](crate::summary::summary)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// assert!(study.summary()?.trusted());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn summary(&self) -> Result<Summary, Error> {
        self.solve()?.summary()
    }

    /// Probability that the frequency of one mode, counted from 0, lies in a forbidden band
    /// ([`mode_margin`](crate::second_order::mode_margin)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// use eigentol::second_order::Band;
    ///
    /// let band = Band::Between { low: 4.1, high: 4.2 };
    /// println!("{}", study.margin(0, band)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn margin(&self, mode: usize, band: Band) -> Result<ModeMargin, Error> {
        self.solve()?.margin(mode, band)
    }

    /// As [`Study::margin`] for any quantity of the mode: [`Quantity::Growth`] between zero and infinity is the
    /// probability that it is unstable.
    ///
    /// # Errors
    /// As [`Study::margin`].
    pub fn margin_of(
        &self,
        mode: usize,
        quantity: Quantity,
        band: Band,
    ) -> Result<ModeMargin, Error> {
        self.solve()?.margin_of(mode, quantity, band)
    }
}

impl<M: BatchKernels> Study<M> {
    /// Monte Carlo with re-solved equilibria ([`tolerance::monte_carlo`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let run = study.samples(500).monte_carlo()?;
    /// assert_eq!(run.counts.stable, 500);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the nominal equilibrium and modes, of the tolerances, and [`Error::Threads`].
    pub fn monte_carlo(&self) -> Result<MonteCarlo, Error> {
        self.solve()?.monte_carlo()
    }

    /// As [`Study::monte_carlo`]; `progress` is called with a number of samples whenever that many more are done.
    ///
    /// # Errors
    /// As [`Study::monte_carlo`].
    pub fn monte_carlo_with_progress(
        &self,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<MonteCarlo, Error> {
        self.solve()?.monte_carlo_with_progress(progress)
    }
}
