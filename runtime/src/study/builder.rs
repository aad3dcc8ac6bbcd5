//! A study, and how it is set up.

use super::settings::{Settings, Width};
use crate::equilibrium::Policy;
use crate::kernels::Kernels;
use crate::modes::Family;
use crate::scalar::Instructions;
use crate::tolerance::Tolerances;
use crate::{Coordinate, Description, DesignVariable, Error, Input, Matrix, Output};

/// A mechanism at one operating point, with tolerances and settings.
///
/// ```
/// use eigentol::{Study, mechanism};
///
/// mechanism! {
///     mechanism Pendulum {
///         input  omega: rad/s;
///         design m = 3.0 kg;
///         design l = 1.0 m +/- 3%;
///         gravity 9.81 m/s^2 along -z;
///         body shaft: massless;
///         body bar: rod(mass: m, length: l, along: -z);
///         joint spin:  revolute(z) from ground to shaft, driven at omega;
///         joint theta: revolute(y) from shaft to bar;
///         output angle = theta;
///     }
/// }
///
/// let study = Study::new(Pendulum).input(Pendulum::omega, 5.0).start(Pendulum::theta, 1.0);
/// println!("{}", study.first_order()?);
/// # Ok::<(), eigentol::Error>(())
/// ```
///
/// The examples below go on with this one. A study starts from the declared nominal values and tolerances, inputs and start values
/// zero, a stable equilibrium wanted. Values are SI. Every question solves what it needs; of several about one operating point ask
/// what [`Study::solve`] returns.
///
/// Handles such as `Pendulum::omega` belong to their mechanism. That of another one does not compile:
///
/// ```compile_fail,E0308
/// # use eigentol::{Study, mechanism};
/// # mechanism! {
/// #     mechanism Pendulum {
/// #         body bar: rod(mass: 3 kg, length: 1 m, along: -z);
/// #         gravity 9.81 m/s^2 along -z;
/// #         joint theta: revolute(y) from ground to bar;
/// #     }
/// # }
/// # mechanism! {
/// #     mechanism Slider {
/// #         body block: point(mass: 1 kg);
/// #         joint x: prismatic(x) from ground to block;
/// #         force hold: spring(on: x, stiffness: 100 N/m);
/// #     }
/// # }
/// let study = Study::new(Pendulum).start(Slider::x, 0.1);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Study<M> {
    pub(super) mechanism: M,
    pub(super) settings: Settings,
}

impl<M: Kernels> Study<M> {
    /// A study of `mechanism` at its nominal design.
    pub fn new(mechanism: M) -> Self {
        let settings = Settings::new(mechanism.description());
        Self {
            mechanism,
            settings,
        }
    }

    /// Sets an input, SI.
    #[must_use]
    pub fn input(mut self, input: Input<M>, value: f64) -> Self {
        self.settings.set_input(input.any(), value);
        self
    }

    /// Sets a design variable, SI.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let longer = study.clone().design(Pendulum::l, 2.0);
    /// assert!(longer.modes()?.frequencies()[0] > study.modes()?.frequencies()[0]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    #[must_use]
    pub fn design(mut self, variable: DesignVariable<M>, value: f64) -> Self {
        self.settings.set_design(variable.any(), value);
        self
    }

    /// Sets where the search for an equilibrium starts, SI. A mechanism with constraints is first assembled with this
    /// coordinate held at the value: give as many as are independent, and the others a [`Study::guess`].
    #[must_use]
    pub fn start(mut self, coordinate: Coordinate<M>, value: f64) -> Self {
        self.settings.set_start(coordinate.any(), value, true);
        self
    }

    /// Sets from where a dependent coordinate is moved when a mechanism with constraints is assembled, SI: it chooses the
    /// assembly mode. Without constraints the same as [`Study::start`].
    #[must_use]
    pub fn guess(mut self, coordinate: Coordinate<M>, value: f64) -> Self {
        self.settings.set_start(coordinate.any(), value, false);
        self
    }

    /// Sets the half-width of a tolerance, SI.
    #[must_use]
    pub fn tolerance(mut self, variable: DesignVariable<M>, half_width: f64) -> Self {
        let width = Width::Absolute(half_width);
        self.settings.set_width(variable.any(), width);
        self
    }

    /// Sets the half-width of a tolerance as a fraction of the variable's value, whatever value it is given, before or
    /// after: 0.03 for 3 %.
    #[must_use]
    pub fn relative_tolerance(mut self, variable: DesignVariable<M>, fraction: f64) -> Self {
        let width = Width::Relative(fraction);
        self.settings.set_width(variable.any(), width);
        self
    }

    /// Sets how many standard deviations a tolerance holds (3 unless set).
    #[must_use]
    pub fn sigma_level(mut self, level: f64) -> Self {
        self.settings.sigma_level = level;
        self
    }

    /// Couples the design variables by a correlation matrix (independent unless set).
    #[must_use]
    pub fn correlation(mut self, matrix: impl Into<Matrix>) -> Self {
        self.settings.correlation = Some(matrix.into());
        self
    }

    /// Chooses which equilibrium is wanted.
    #[must_use]
    pub fn policy(mut self, policy: Policy) -> Self {
        self.settings.policy = policy;
        self
    }

    /// Chooses which modes are wanted; unless set, those that leave nothing out: undamped where `Chat` is zero and `Khat`
    /// symmetric, general ones otherwise ([`Family::of`]).
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.settings.family = Some(family);
        self
    }

    /// Sets the number of Monte Carlo samples (3000 unless set).
    #[must_use]
    pub fn samples(mut self, samples: usize) -> Self {
        self.settings.samples = samples;
        self
    }

    /// Sets the seed of the samples (0 unless set).
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.settings.seed = seed;
        self
    }

    /// Chooses one of the independent sequences of samples of the seed (0 unless set): one for each point of a sweep
    /// keeps the errors of the points apart.
    #[must_use]
    pub fn stream(mut self, stream: u64) -> Self {
        self.settings.stream = stream;
        self
    }

    /// Chooses the vector instructions with which a Monte Carlo run solves several samples, and a sweep several values, side
    /// by side where the mechanism allows it (the best of the processor unless set); `None` solves each alone. The two differ in
    /// the last bits, which instructions are taken does not matter; a run says which it was
    /// ([`MonteCarlo::side_by_side`](crate::MonteCarlo::side_by_side)).
    #[must_use]
    pub fn vectors(mut self, vectors: Option<Instructions>) -> Self {
        self.settings.vectors = vectors;
        self
    }

    /// Sets the number of threads of a Monte Carlo run; 0 takes what the machine has, more than 256 count as 256 or as what the
    /// machine has if that is more.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.settings.threads = threads;
        self
    }

    /// Asks a Monte Carlo run to return every sample.
    #[must_use]
    pub fn keep_samples(mut self, keep: bool) -> Self {
        self.settings.keep_samples = keep;
        self
    }

    /// Sets into how many steps a range is cut when something is looked for in it (200 unless set).
    #[must_use]
    pub fn steps(mut self, steps: usize) -> Self {
        self.settings.steps = steps;
        self
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// Names, units and nominal values of what the mechanism has.
    pub fn description(&self) -> &Description {
        &self.settings.description
    }

    /// The coordinate, or other unknown, of this name.
    pub fn find_coordinate(&self, name: &str) -> Option<Coordinate<M>> {
        let mut all = self.description().coordinates.iter();
        all.position(|info| info.name == *name).map(Coordinate::new)
    }

    /// The input of this name.
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let study = match study.find_input("omega") {
    ///     Some(speed) => study.input(speed, 4.0),
    ///     None => study,
    /// };
    /// assert_eq!(study.input_values(), [4.0]);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    pub fn find_input(&self, name: &str) -> Option<Input<M>> {
        let mut all = self.description().inputs.iter();
        all.position(|info| info.name == *name).map(Input::new)
    }

    /// The design variable of this name.
    pub fn find_design(&self, name: &str) -> Option<DesignVariable<M>> {
        let mut all = self.description().design.iter();
        all.position(|info| info.name == *name)
            .map(DesignVariable::new)
    }

    /// The output of this name.
    pub fn find_output(&self, name: &str) -> Option<Output<M>> {
        let mut all = self.description().outputs.iter();
        all.position(|info| info.name == *name).map(Output::new)
    }

    /// The inputs, SI.
    pub fn input_values(&self) -> &[f64] {
        &self.settings.inputs
    }

    /// The design variables, SI.
    pub fn design_values(&self) -> &[f64] {
        &self.settings.design
    }

    /// Start values as set, SI, not assembled.
    pub fn start_values(&self) -> &[f64] {
        &self.settings.start
    }

    /// The tolerances as set.
    ///
    /// # Errors
    /// [`Error::Setting`] when they make no sense; [`Error::UnknownHandle`].
    pub fn tolerances(&self) -> Result<Tolerances, Error> {
        self.settings.tolerances()
    }
}
