//! The front door: a mechanism, the values to study it at, and what to ask of it.

mod along;
mod questions;

use crate::constraints::Structure;
use crate::equilibrium::{Following, Policy};
use crate::lanes::Instructions;
use crate::modes::Family;
use crate::room;
use crate::tolerance::Tolerances;
use crate::{Coordinate, DesignVariable, Error, Input, Mechanism};

/// Half-width of a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Width {
    /// SI.
    Absolute(f64),
    /// Of the variable's value.
    Relative(f64),
}

/// A mechanism at one operating point, with tolerances and settings.
///
/// Starts from the declared nominal values and tolerances, inputs and start values zero, a stable equilibrium wanted.
/// Values are SI. Every question solves what it needs; use the functions of the modules to reuse results. Questions about a large
/// mechanism (more than 256 coordinates times coordinates and design variables) run on a thread with a stack of their own; the
/// functions of the modules need one of up to 32 MiB for 64 coordinates without optimisation.
#[derive(Clone, Debug, PartialEq)]
pub struct Study<M, const N: usize, const U: usize, const P: usize, const O: usize> {
    mechanism: M,
    inputs: [f64; U],
    design: [f64; P],
    start: [f64; N],
    /// Which coordinates keep their start value when a mechanism with constraints is assembled.
    held: [bool; N],
    policy: Policy,
    family: Option<Family>,
    half_widths: [Width; P],
    sigma_level: f64,
    correlation: Option<Box<[[f64; P]; P]>>,
    samples: usize,
    seed: u64,
    stream: u64,
    threads: usize,
    vectors: Option<Instructions>,
    keep_samples: bool,
    steps: usize,
    fault: Option<Error>,
}

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Study<M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// A study of `mechanism` at its nominal design.
    pub fn new(mechanism: M) -> Self {
        let design = M::DESCRIPTION.design;
        Self {
            mechanism,
            inputs: [0.0; U],
            design: core::array::from_fn(|j| design.get(j).map_or(0.0, |info| info.nominal)),
            start: [0.0; N],
            held: [false; N],
            policy: Policy::Stable,
            family: None,
            half_widths: core::array::from_fn(|j| {
                Width::Absolute(design.get(j).map_or(0.0, |info| info.tolerance))
            }),
            sigma_level: 3.0,
            correlation: None,
            samples: 3000,
            seed: 0,
            stream: 0,
            threads: 0,
            vectors: Some(Instructions::best()),
            keep_samples: false,
            steps: 200,
            fault: None,
        }
    }

    /// Sets an input, SI.
    #[must_use]
    pub fn input(mut self, input: Input, value: f64) -> Self {
        match self.inputs.get_mut(input.0) {
            Some(place) => *place = value,
            None => self.refuse("input", input.0, U),
        }
        self
    }

    /// Sets a design variable, SI.
    #[must_use]
    pub fn design(mut self, variable: DesignVariable, value: f64) -> Self {
        match self.design.get_mut(variable.0) {
            Some(place) => *place = value,
            None => self.refuse("design variable", variable.0, P),
        }
        self
    }

    /// Sets where the search for an equilibrium starts, SI. A mechanism with constraints is first assembled with this
    /// coordinate held at the value: give as many as are independent, and the others a [`Study::guess`].
    #[must_use]
    pub fn start(self, coordinate: Coordinate, value: f64) -> Self {
        self.from(coordinate, value, true)
    }

    /// Sets from where a dependent coordinate is moved when a mechanism with constraints is assembled, SI: it chooses the
    /// assembly mode. Without constraints the same as [`Study::start`].
    #[must_use]
    pub fn guess(self, coordinate: Coordinate, value: f64) -> Self {
        self.from(coordinate, value, false)
    }

    fn from(mut self, coordinate: Coordinate, value: f64, held: bool) -> Self {
        match self.start.get_mut(coordinate.0) {
            Some(place) => {
                *place = value;
                self.held[coordinate.0] = held;
            }
            None => self.refuse("coordinate", coordinate.0, N),
        }
        self
    }

    /// Sets the half-width of a tolerance, SI.
    #[must_use]
    pub fn tolerance(self, variable: DesignVariable, half_width: f64) -> Self {
        self.width(variable, Width::Absolute(half_width))
    }

    /// Sets the half-width of a tolerance as a fraction of the variable's value, whatever value it is given, before or
    /// after: 0.03 for 3 %.
    #[must_use]
    pub fn relative_tolerance(self, variable: DesignVariable, fraction: f64) -> Self {
        self.width(variable, Width::Relative(fraction))
    }

    fn width(mut self, variable: DesignVariable, width: Width) -> Self {
        match self.half_widths.get_mut(variable.0) {
            Some(place) => *place = width,
            None => self.refuse("design variable", variable.0, P),
        }
        self
    }

    /// Sets how many standard deviations a tolerance holds (3 unless set).
    #[must_use]
    pub fn sigma_level(mut self, level: f64) -> Self {
        self.sigma_level = level;
        self
    }

    /// Couples the design variables by a correlation matrix (independent unless set).
    #[must_use]
    pub fn correlation(mut self, matrix: [[f64; P]; P]) -> Self {
        self.correlation = Some(Box::new(matrix));
        self
    }

    /// Chooses which equilibrium is wanted.
    #[must_use]
    pub fn policy(mut self, policy: Policy) -> Self {
        self.policy = policy;
        self
    }

    /// Chooses which modes are wanted; unless set, those that leave nothing out: undamped where `Chat` is zero and `Khat`
    /// symmetric, general ones otherwise ([`Family::of`]).
    #[must_use]
    pub fn family(mut self, family: Family) -> Self {
        self.family = Some(family);
        self
    }

    /// Sets the number of Monte Carlo samples (3000 unless set).
    #[must_use]
    pub fn samples(mut self, samples: usize) -> Self {
        self.samples = samples;
        self
    }

    /// Sets the seed of the samples (0 unless set).
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Chooses one of the independent sequences of samples of the seed (0 unless set): one for each point of a sweep
    /// keeps the errors of the points apart.
    #[must_use]
    pub fn stream(mut self, stream: u64) -> Self {
        self.stream = stream;
        self
    }

    /// Chooses the vector instructions with which a Monte Carlo run solves several samples, and a sweep several values, side
    /// by side where the mechanism allows it (the best of the processor unless set); `None` solves each alone. The two differ in
    /// the last bits, which instructions are taken does not matter; a run says which it was
    /// ([`MonteCarlo::side_by_side`](crate::MonteCarlo::side_by_side)).
    #[must_use]
    pub fn vectors(mut self, vectors: Option<Instructions>) -> Self {
        self.vectors = vectors;
        self
    }

    /// Sets the number of threads of a Monte Carlo run; 0 takes what the machine has, more than 256 count as 256 or as what the
    /// machine has if that is more.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// Asks a Monte Carlo run to return every sample.
    #[must_use]
    pub fn keep_samples(mut self, keep: bool) -> Self {
        self.keep_samples = keep;
        self
    }

    /// Sets into how many steps a range is cut when something is looked for in it (200 unless set).
    #[must_use]
    pub fn steps(mut self, steps: usize) -> Self {
        self.steps = steps;
        self
    }

    fn following(&self) -> Following {
        Following {
            policy: self.policy,
            family: self.family,
            vectors: self.vectors,
        }
    }

    fn refuse(&mut self, kind: &'static str, index: usize, count: usize) {
        let mechanism = M::DESCRIPTION.name;
        self.fault.get_or_insert(Error::UnknownHandle {
            kind,
            index,
            mechanism,
            count,
        });
    }

    #[inline]
    fn ready(&self) -> Result<(), Error> {
        match &self.fault {
            None => Ok(()),
            Some(fault) => Err(fault.clone()),
        }
    }

    /// Answers a question, of a large mechanism on a thread with stack enough.
    #[inline]
    fn ask<T: Send>(
        &self,
        question: impl FnOnce(&Self) -> Result<T, Error> + Send,
    ) -> Result<T, Error> {
        match const { room::stack(N, P) } {
            None => question(self),
            Some(size) => room::with_stack(size, || question(self)),
        }
    }

    /// Where solvers start: the start values, assembled where coordinates are held.
    fn assembled_start(&self) -> Result<[f64; N], Error> {
        self.ready()?;
        let structure = const { Structure::of(&M::DESCRIPTION) };
        if structure.open() || !self.held.contains(&true) {
            return Ok(self.start);
        }
        self.assembly().map(|assembly| assembly.coordinates)
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The inputs, SI.
    pub fn input_values(&self) -> &[f64; U] {
        &self.inputs
    }

    /// The design variables, SI.
    pub fn design_values(&self) -> &[f64; P] {
        &self.design
    }

    /// Start values as set, SI, not assembled.
    pub fn start_values(&self) -> &[f64; N] {
        &self.start
    }

    /// The tolerances as set.
    ///
    /// # Errors
    /// [`Error::Setting`] when they make no sense; [`Error::UnknownHandle`].
    #[inline]
    pub fn tolerances(&self) -> Result<Tolerances<P>, Error> {
        self.ready()?;
        let half_widths = core::array::from_fn(|j| match self.half_widths[j] {
            Width::Absolute(half_width) => half_width,
            Width::Relative(fraction) => fraction * self.design[j].abs(),
        });
        Tolerances::new(
            half_widths,
            self.sigma_level,
            self.correlation.as_deref().copied(),
        )
    }
}
