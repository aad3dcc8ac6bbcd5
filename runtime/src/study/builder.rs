//! The [`Study`] type and its settings.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::parameter::Parameter;
use super::settings::Settings;
use super::value::Value;
use super::variation::Variation;
use crate::equilibrium::Policy;
use crate::kernels::Kernels;
use crate::modes::Family;
use crate::scalar::Instructions;
use crate::tolerance::{Distribution, Sampling, Tolerances};
use crate::{
    Coordinate, Description, DesignVariable, Equilibrium, Error, Excitation, Input, Law, Matrix, Output, Text,
};

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
/// The examples below continue this one. A study starts with the declared nominal values and tolerances, with all
/// inputs and start values zero, and looks for a stable equilibrium. Values are in SI units unless wrapped in
/// [`InDeclaredUnit`](crate::InDeclaredUnit). Each question solves whatever it needs. The study keeps the equilibrium and
/// the modes for the next question, and its clones share them, until a setting moves the operating point.
///
/// Handles such as `Pendulum::omega` belong to their mechanism. Using a handle of another mechanism does not compile:
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

/// Setters of plain settings.
macro_rules! setters {
    ($($(#[$doc:meta])* $name:ident: $kind:ty,)*) => {$(
        $(#[$doc])*
        #[must_use]
        pub fn $name(mut self, $name: $kind) -> Self {
            self.settings.$name = $name;
            self
        }
    )*};
}

macro_rules! finders {
    ($($(#[$doc:meta])* $find:ident: $handle:ident, $kind:literal, $list:ident;)*) => {$(
        $(#[$doc])*
        pub fn $find(&self, name: &str) -> Result<$handle<M>, Error> {
            self.find($kind, name, self.description().$list.iter().map(|info| &info.name)).map($handle::new)
        }
    )*};
}

impl<M: Kernels> Study<M> {
    /// Creates a study of `mechanism` at its nominal design.
    #[must_use]
    pub fn new(mechanism: M) -> Self {
        let settings = Settings::new(mechanism.description());
        Self { mechanism, settings }
    }

    /// Sets the value of an input.
    #[must_use]
    pub fn input(mut self, input: Input<M>, value: impl Into<Value>) -> Self {
        self.settings.set_value(input.any().into(), value.into());
        self
    }

    /// Sets the value of a design variable.
    ///
    /// A declared tolerance keeps its absolute half-width, even if it was declared in percent (use
    /// [`Study::relative_tolerance`] for one that scales with the value).
    #[doc = include_str!("example.txt")]
    /// let longer = study.clone().design(Pendulum::l, 2.0);
    /// assert!(longer.modes()?.frequencies()[0] > study.modes()?.frequencies()[0]);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn design(mut self, variable: DesignVariable<M>, value: impl Into<Value>) -> Self {
        self.settings.set_value(variable.any().into(), value.into());
        self
    }

    /// Sets the value at which the search for an equilibrium starts.
    ///
    /// If the given values are those of an equilibrium, it is the answer even if it is unstable
    /// ([`Note::Stays`](crate::equilibrium::Note::Stays)).
    ///
    /// A mechanism with constraints is first assembled with this coordinate held at the value: give start values to as
    /// many coordinates as are independent, and a [`Study::guess`] to the others.
    #[must_use]
    pub fn start(mut self, coordinate: Coordinate<M>, value: impl Into<Value>) -> Self {
        self.settings.set_start(coordinate.any(), value.into(), true);
        self
    }

    /// Holds an unknown at a value where steady motions come in a family: the lean of a wheel that rolls in a circle, the
    /// speed of one that rolls straight ahead.
    ///
    /// As many unknowns are held as the family has parameters, and derivatives hold them too: with another choice they
    /// compare other members. Without this, those with a [`start`](Self::start) are held, then speeds of coasting
    /// coordinates in the order of declaration; [`Equilibrium::notes`](crate::Equilibrium::notes) tells.
    #[must_use]
    pub fn hold(mut self, unknown: Coordinate<M>, value: impl Into<Value>) -> Self {
        self.settings.hold(unknown.any(), value.into());
        self
    }

    /// Takes the equilibrium nearest to the start values whatever its stability ([`Policy::Nearest`]).
    #[must_use]
    pub fn stay(self) -> Self {
        self.policy(Policy::Nearest)
    }

    /// Takes this equilibrium, found before ([`Self::equilibria`]), whatever its stability.
    #[must_use]
    pub fn at(mut self, state: &Equilibrium) -> Self {
        self.settings.start_at(&state.coordinates);
        self.stay()
    }

    /// Sets the initial guess of a dependent coordinate for the assembly of a mechanism with constraints.
    ///
    /// The guess selects the assembly mode. Without constraints this is equivalent to [`Study::start`].
    #[must_use]
    pub fn guess(mut self, coordinate: Coordinate<M>, value: impl Into<Value>) -> Self {
        self.settings.set_start(coordinate.any(), value.into(), false);
        self
    }

    /// Sets the tolerance half-width of a design variable or an input.
    ///
    /// The half-width does not change when the parameter is later given another value; nor does a declared tolerance of
    /// a design variable, even one in percent (use [`Study::relative_tolerance`] for one that scales with the value). A
    /// declared tolerance of an input in percent follows the value. The distribution is unchanged: normal unless set
    /// otherwise.
    #[doc = include_str!("example.txt")]
    /// // The speed wanders by 0.1 rad/s about whatever value it has.
    /// let spread = study.clone().tolerance(Pendulum::omega, 0.1).first_order()?;
    /// assert!(spread.modes[0].lambda.sigma > study.first_order()?.modes[0].lambda.sigma);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn tolerance(mut self, parameter: impl Into<Parameter<M>>, half_width: impl Into<Value>) -> Self {
        let half_width = half_width.into();
        self.settings.set_limits(parameter.into().any(), half_width.negative(), half_width);
        self
    }

    /// Sets the half-width of a tolerance as a fraction of the value: 0.03 for 3 %.
    ///
    /// It scales with the value, whether that is set before or after.
    #[must_use]
    pub fn relative_tolerance(mut self, parameter: impl Into<Parameter<M>>, fraction: f64) -> Self {
        let limits = (-fraction, fraction);
        self.settings.vary(parameter.into().any(), |setting| setting.set_limits(limits, true));
        self
    }

    /// Sets the limits of a tolerance as deviations from the value, lower limit first: `(0.0, 0.1e-3)` for a bore of
    /// +0.1 -0 mm.
    #[doc = include_str!("example.txt")]
    /// let longer = study.limits(Pendulum::l, 0.0, 0.02);
    /// assert!((longer.tolerances()?.shifts()[Pendulum::l.index()] - 0.01).abs() < 1e-15);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn limits(
        mut self,
        parameter: impl Into<Parameter<M>>,
        lower: impl Into<Value>,
        upper: impl Into<Value>,
    ) -> Self {
        self.settings.set_limits(parameter.into().any(), lower.into(), upper.into());
        self
    }

    /// Sets the distribution of a parameter between its tolerance limits.
    #[doc = include_str!("example.txt")]
    /// use eigentol::Law;
    ///
    /// let uniform = study.clone().law(Pendulum::l, Law::Uniform);
    /// let (uniform, normal) = (uniform.tolerances()?, study.tolerances()?);
    /// // Limits hold three standard deviations of a normal variable and the square root of three of a uniform one.
    /// let ratio = uniform.sigmas()[Pendulum::l.index()] / normal.sigmas()[Pendulum::l.index()];
    /// assert!((ratio - 3.0_f64.sqrt()).abs() < 1e-12);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn law(mut self, parameter: impl Into<Parameter<M>>, law: Law) -> Self {
        self.settings.vary(parameter.into().any(), |setting| setting.set_law(law));
        self
    }

    /// Sets the distribution of a parameter's values (SI), independently of its nominal value.
    #[doc = include_str!("example.txt")]
    /// use eigentol::tolerance::Distribution;
    ///
    /// let measured = Distribution::empirical(&[0.98, 1.01, 1.0, 1.03, 0.99])?;
    /// let study = study.distribution(Pendulum::l, measured);
    /// println!("{}", study.monte_carlo()?);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn distribution(mut self, parameter: impl Into<Parameter<M>>, values: Distribution) -> Self {
        self.settings.vary(parameter.into().any(), |setting| *setting = Variation::Values(values));
        self
    }

    /// Sets how many standard deviations the half-width of a tolerance represents (3 by default).
    #[must_use]
    pub fn sigma_level(mut self, level: f64) -> Self {
        self.settings.set_sigma_level(level);
        self
    }

    /// Sets the correlation matrix of the design variables followed by the inputs that have a tolerance. By default only
    /// those are correlated that the declaration says are.
    #[must_use]
    pub fn correlation(mut self, matrix: impl Into<Matrix>) -> Self {
        self.settings.set_correlation(matrix.into());
        self
    }

    /// The correlation matrix as set, or else as declared; `None` if all are independent.
    #[must_use]
    pub fn correlation_matrix(&self) -> Option<Matrix> {
        self.settings.correlation()
    }

    /// Chooses which equilibrium to look for.
    #[must_use]
    pub fn policy(mut self, policy: Policy) -> Self {
        self.settings.set_policy(policy);
        self
    }

    /// Chooses the family of modes to compute.
    ///
    /// By default it is the family that neglects nothing: undamped modes where `Chat` is zero and `Khat` symmetric,
    /// general modes otherwise ([`Family::of`]).
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.settings.set_family(family);
        self
    }

    setters! {
        /// Sets the number of Monte Carlo samples (3000 by default).
        samples: usize,
        /// Sets the seed of the random samples (0 by default).
        seed: u64,
        /// Selects one of the independent sample sequences of the seed (0 by default).
        ///
        /// With a different stream at each point of a sweep, the sampling errors of the points are independent.
        stream: u64,
        /// Chooses the vector instructions used to solve several samples (in Monte Carlo runs and response studies) or
        /// several input values (in sweeps) at once, where the mechanism allows it. The default is the best set that the
        /// processor supports; `None` solves one at a time. Scalar and vector results differ in the last bits; all
        /// instruction sets give identical bits. A run reports which way was used
        /// ([`MonteCarlo::side_by_side`](crate::MonteCarlo::side_by_side)).
        vectors: Option<Instructions>,
        /// Sets the number of threads of a Monte Carlo run; 0, the default, uses all available.
        ///
        /// The limit is 256, or the number the machine has if that is larger.
        threads: usize,
        /// Makes Monte Carlo runs return every sample.
        keep_samples: bool,
        /// Sets the number of steps used to search a range (200 by default).
        steps: usize,
    }

    /// Registers a callback for long computations.
    ///
    /// It is called from any thread with the number of steps done since its last call: samples, input values, branch
    /// points or tolerance choices.
    #[doc = include_str!("example.txt")]
    /// let study = study.progress(|steps| print!("{}", ".".repeat(steps)));
    /// study.campbell(Pendulum::omega, &[4.0, 4.5, 5.0], &[1.0])?;
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn progress(mut self, progress: impl Fn(usize) + Send + Sync + 'static) -> Self {
        self.settings.watcher.progress = Some(Arc::new(progress));
        self
    }

    /// Stops long computations soon after `flag` becomes true, for example from another thread or a Ctrl-C handler.
    ///
    /// Samples, sweeps and branches return what is done so far; anything that is useless when incomplete returns
    /// [`Error::Stopped`].
    #[doc = include_str!("example.txt")]
    /// use std::sync::Arc;
    /// use std::sync::atomic::{AtomicBool, Ordering};
    ///
    /// let flag = Arc::new(AtomicBool::new(false));
    /// let own = Arc::clone(&flag);
    /// // After the first value.
    /// let study = study.stop(flag).progress(move |_| own.store(true, Ordering::Relaxed));
    /// assert_eq!(study.campbell(Pendulum::omega, &[4.0, 4.5, 5.0], &[1.0])?.points.len(), 1);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn stop(mut self, flag: Arc<AtomicBool>) -> Self {
        self.settings.watcher.stop = Some(flag);
        self
    }

    /// The mechanism under study.
    #[must_use]
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// Names, units and nominal values of the mechanism.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.settings.description
    }

    finders! {
        /// Looks up a coordinate, or another unknown, by name.
        ///
        /// # Errors
        /// [`Error::UnknownName`], which lists the names that exist.
        find_coordinate: Coordinate, "coordinate", coordinates;

        /// Looks up an input by name, for names known only at run time.
        #[doc = include_str!("example.txt")]
        /// let speed = study.find_input("omega")?;
        /// let study = study.input(speed, 4.0);
        /// assert_eq!(study.input_values(), [4.0]);
        ///
        /// let error = study.find_input("speed").unwrap_err();
        /// assert_eq!(error.to_string(), "`Pendulum` has no input `speed`: it has `omega`");
        #[doc = include_str!("end.txt")]
        /// # Errors
        /// [`Error::UnknownName`], which lists the names that exist.
        find_input: Input, "input", inputs;

        /// Looks up a design variable by name.
        #[doc = include_str!("example.txt")]
        /// let length = study.find_design("l")?;
        /// assert_eq!(length, Pendulum::l);
        #[doc = include_str!("end.txt")]
        /// # Errors
        /// [`Error::UnknownName`], which lists the names that exist.
        find_design: DesignVariable, "design variable", design;

        /// Looks up an output by name.
        ///
        /// # Errors
        /// [`Error::UnknownName`], which lists the names that exist.
        find_output: Output, "output", outputs;

        /// Looks up an excitation by name.
        ///
        /// # Errors
        /// [`Error::UnknownName`], which lists the names that exist.
        find_excitation: Excitation, "excitation", excitations;
    }

    fn find<'a>(
        &self,
        kind: &'static str,
        name: &str,
        mut names: impl Iterator<Item = &'a Text> + Clone,
    ) -> Result<usize, Error> {
        let known = names.clone();
        names.position(|x| *x == *name).ok_or_else(|| Error::UnknownName {
            kind,
            name: name.to_owned(),
            mechanism: self.description().name.clone(),
            known: known.cloned().collect(),
        })
    }

    /// Values of the inputs, SI.
    #[must_use]
    pub fn input_values(&self) -> &[f64] {
        &self.settings.inputs
    }

    /// Values of the design variables, SI.
    #[must_use]
    pub fn design_values(&self) -> &[f64] {
        &self.settings.design
    }

    /// Start values as set (before assembly), SI.
    #[must_use]
    pub fn start_values(&self) -> &[f64] {
        &self.settings.start
    }

    /// The inputs that have a tolerance. In correlation matrices they follow the design variables, in this order.
    #[doc = include_str!("example.txt")]
    /// assert!(study.deviating_inputs().is_empty());
    /// let study = study.relative_tolerance(Pendulum::omega, 0.01);
    /// assert_eq!(study.deviating_inputs(), [Pendulum::omega]);
    #[doc = include_str!("end.txt")]
    #[must_use]
    pub fn deviating_inputs(&self) -> Vec<Input<M>> {
        self.settings.deviating_inputs().into_iter().map(|input| Input::new(input.index())).collect()
    }

    /// The tolerances that result from the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the tolerances are invalid; [`Error::UnknownHandle`].
    pub fn tolerances(&self) -> Result<Tolerances, Error> {
        self.settings.tolerances().cloned()
    }

    /// The sampling settings of this study ([`Study::samples`], [`Study::seed`] and so on).
    ///
    /// Add a range, progress callback or stop flag for [`Study::sample_modes`].
    #[must_use]
    pub fn sampling(&self) -> Sampling<'_> {
        self.settings.sampling()
    }
}
