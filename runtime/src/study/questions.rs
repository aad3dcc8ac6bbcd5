//! What a study can be asked: each question runs the chain of functions that answers it.

use super::Study;
use crate::equilibrium::{
    self, Branches, Continuation, CriticalState, Crossing, Equilibrium, Range, Search, SweepPoint,
};
use crate::sensitivity::{self, EquilibriumShift, OutputSensitivities, Sensitivities};
use crate::tolerance::{self, EventTolerance, FirstOrder, MonteCarlo, OutputTolerances, Sampling};
use crate::{Error, Input, Mechanism, Modes, modes};

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Study<M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
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
    pub fn output_tolerances(&self) -> Result<OutputTolerances<P, O>, Error> {
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
            stream: self.stream,
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

    /// Branches of equilibria while an input goes from `low` to `high`, SI ([`equilibrium::branches`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn branches(&self, input: Input, low: f64, high: f64) -> Result<Branches<N, U, P>, Error> {
        self.branches_with(&Continuation::new(input, low, high), None)
    }

    /// As [`Study::branches`], with other settings and with starts from many places.
    ///
    /// # Errors
    /// Those of the function.
    pub fn branches_with(
        &self,
        settings: &Continuation,
        search: Option<&Search<N>>,
    ) -> Result<Branches<N, U, P>, Error> {
        self.ready()?;
        equilibrium::branches(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            settings,
            search,
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

    /// As [`Study::critical_state`], with its sensitivity and spread ([`tolerance::critical_tolerance`]).
    ///
    /// # Errors
    /// Those of [`Study::critical_state`] and [`Study::tolerances`]; a value without a derivative says so itself.
    pub fn critical_tolerance(
        &self,
        input: Input,
        low: f64,
        high: f64,
    ) -> Result<EventTolerance<P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.critical_state(input, low, high)?;
        Ok(tolerance::critical_tolerance(
            &self.mechanism,
            &state,
            &tolerances,
        ))
    }

    /// As [`Study::crossings`], with their sensitivities and spreads ([`tolerance::crossing_tolerance`]).
    ///
    /// # Errors
    /// Those of [`Study::crossings`] and [`Study::tolerances`]; a value without a derivative says so itself.
    pub fn crossing_tolerances(
        &self,
        input: Input,
        low: f64,
        high: f64,
        ratio: f64,
    ) -> Result<Vec<EventTolerance<P>>, Error> {
        let tolerances = self.tolerances()?;
        let found = self.crossings(input, low, high, ratio)?;
        let spread =
            |crossing| tolerance::crossing_tolerance(&self.mechanism, crossing, &tolerances);
        Ok(found.iter().map(spread).collect())
    }
}
