//! The front door: a mechanism, the values to study it at, and what to ask of it.

use crate::equilibrium::{
    self, CriticalState, Crossing, Equilibrium, Policy, Range, Search, SweepPoint,
};
use crate::sensitivity::{self, EquilibriumShift, OutputSensitivities, Sensitivities};
use crate::tolerance::{self, FirstOrder, MonteCarlo, OutputTolerance, Sampling, Tolerances};
use crate::{Coordinate, DesignVariable, Error, Input, Mechanism, Modes, modes};

/// A mechanism at one operating point, with tolerances and settings.
///
/// Starts from the declared nominal values and tolerances, inputs and start values zero, a stable equilibrium wanted.
/// Values are SI. Every question solves what it needs; use the functions of the modules to reuse results.
#[derive(Clone, Debug, PartialEq)]
pub struct Study<M, const N: usize, const U: usize, const P: usize, const O: usize> {
    mechanism: M,
    inputs: [f64; U],
    design: [f64; P],
    start: [f64; N],
    policy: Policy,
    half_widths: [f64; P],
    sigma_level: f64,
    correlation: Option<[[f64; P]; P]>,
    samples: usize,
    seed: u64,
    threads: usize,
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
            policy: Policy::Stable,
            half_widths: core::array::from_fn(|j| design.get(j).map_or(0.0, |info| info.tolerance)),
            sigma_level: 3.0,
            correlation: None,
            samples: 3000,
            seed: 0,
            threads: 0,
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

    /// Sets where the search for an equilibrium starts, rad or m.
    #[must_use]
    pub fn start(mut self, coordinate: Coordinate, value: f64) -> Self {
        match self.start.get_mut(coordinate.0) {
            Some(place) => *place = value,
            None => self.refuse("coordinate", coordinate.0, N),
        }
        self
    }

    /// Sets the half-width of a tolerance, SI.
    #[must_use]
    pub fn tolerance(mut self, variable: DesignVariable, half_width: f64) -> Self {
        match self.half_widths.get_mut(variable.0) {
            Some(place) => *place = half_width,
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
        self.correlation = Some(matrix);
        self
    }

    /// Chooses which equilibrium is wanted.
    #[must_use]
    pub fn policy(mut self, policy: Policy) -> Self {
        self.policy = policy;
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

    /// Sets the number of threads of a Monte Carlo run; 0 takes what the machine has.
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

    fn refuse(&mut self, kind: &'static str, index: usize, count: usize) {
        let mechanism = M::DESCRIPTION.name;
        self.fault.get_or_insert(Error::UnknownHandle {
            kind,
            index,
            mechanism,
            count,
        });
    }

    fn ready(&self) -> Result<(), Error> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The tolerances as set.
    ///
    /// # Errors
    /// [`Error::Setting`] when they make no sense; [`Error::UnknownHandle`].
    pub fn tolerances(&self) -> Result<Tolerances<P>, Error> {
        self.ready()?;
        Tolerances::new(self.half_widths, self.sigma_level, self.correlation)
    }

    /// The dynamic equilibrium ([`equilibrium::equilibrium`]).
    ///
    /// # Errors
    /// Those of the function, and [`Error::UnknownHandle`] when a builder method was given a foreign handle.
    pub fn equilibrium(&self) -> Result<Equilibrium<N, U, P>, Error> {
        self.ready()?;
        equilibrium::equilibrium(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.policy,
        )
    }

    /// Distinct equilibria from many starts ([`equilibrium::find_equilibria`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn equilibria(&self, search: &Search<N>) -> Result<Vec<Equilibrium<N, U, P>>, Error> {
        self.ready()?;
        equilibrium::find_equilibria(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            search,
        )
    }

    /// The natural modes ([`modes::modes`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn modes(&self) -> Result<Modes<N>, Error> {
        modes::modes(&self.equilibrium()?)
    }

    /// How the equilibrium moves ([`sensitivity::equilibrium_shift`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn equilibrium_shift(&self) -> Result<EquilibriumShift<N, U, P>, Error> {
        sensitivity::equilibrium_shift(&self.mechanism, &self.equilibrium()?)
    }

    /// Total derivatives of the modes ([`sensitivity::sensitivities`]).
    ///
    /// # Errors
    /// Those of the equilibrium, the modes and the function.
    pub fn sensitivities(&self) -> Result<Sensitivities<N, U, P>, Error> {
        let state = self.equilibrium()?;
        sensitivity::sensitivities(&self.mechanism, &state, &modes::modes(&state)?)
    }

    /// Values and total derivatives of the outputs ([`sensitivity::output_sensitivities`]).
    ///
    /// # Errors
    /// Those of the equilibrium and of the function.
    pub fn outputs(&self) -> Result<OutputSensitivities<U, P, O>, Error> {
        sensitivity::output_sensitivities(&self.mechanism, &self.equilibrium()?)
    }

    /// First-order spread of the frequencies ([`tolerance::first_order`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, sensitivities and tolerances.
    pub fn first_order(&self) -> Result<FirstOrder<N, P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = modes::modes(&state)?;
        let slopes = sensitivity::sensitivities(&self.mechanism, &state, &found)?;
        Ok(tolerance::first_order(&found, &slopes, &tolerances))
    }

    /// First-order spread of the outputs ([`tolerance::output_tolerances`]).
    ///
    /// # Errors
    /// Those of equilibrium, output sensitivities and tolerances.
    pub fn output_tolerances(&self) -> Result<[OutputTolerance<P>; O], Error> {
        Ok(tolerance::output_tolerances(
            &self.outputs()?,
            &self.tolerances()?,
        ))
    }

    /// Monte Carlo with re-solved equilibria ([`tolerance::monte_carlo`]).
    ///
    /// # Errors
    /// Those of the nominal equilibrium and modes, of the tolerances, and [`Error::Threads`].
    pub fn monte_carlo(&self) -> Result<MonteCarlo<N, P>, Error> {
        self.sample(None)
    }

    /// As [`Study::monte_carlo`]; `progress` is called with a number of samples whenever that many more are done.
    ///
    /// # Errors
    /// As [`Study::monte_carlo`].
    pub fn monte_carlo_with_progress(
        &self,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<MonteCarlo<N, P>, Error> {
        self.sample(Some(progress))
    }

    fn sample(&self, progress: Option<&(dyn Fn(usize) + Sync)>) -> Result<MonteCarlo<N, P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = modes::modes(&state)?;
        let sampling = Sampling {
            samples: self.samples,
            seed: self.seed,
            threads: self.threads,
            keep_samples: self.keep_samples,
            progress,
        };
        tolerance::monte_carlo(&self.mechanism, &state, &found, &tolerances, &sampling)
    }

    /// Equilibria and modes at each value of one input ([`equilibrium::sweep`]).
    ///
    /// # Errors
    /// [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn sweep(&self, input: Input, values: &[f64]) -> Result<Vec<SweepPoint<N, U, P>>, Error> {
        self.ready()?;
        equilibrium::sweep(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.policy,
            input,
            values,
        )
    }

    /// First critical value of an input between `low` and `high`, SI ([`equilibrium::critical_state`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn critical_state(
        &self,
        input: Input,
        low: f64,
        high: f64,
    ) -> Result<CriticalState<N, U, P>, Error> {
        self.ready()?;
        equilibrium::critical_state(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            Range {
                input,
                low,
                high,
                steps: self.steps,
            },
        )
    }

    /// Values of an input between `low` and `high`, SI, where a frequency is `ratio` times the input
    /// ([`equilibrium::crossings`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn crossings(
        &self,
        input: Input,
        low: f64,
        high: f64,
        ratio: f64,
    ) -> Result<Vec<Crossing<N, U, P>>, Error> {
        self.ready()?;
        equilibrium::crossings(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.policy,
            Range {
                input,
                low,
                high,
                steps: self.steps,
            },
            ratio,
        )
    }
}
