//! What a study can be asked: each question runs the chain of functions that answers it.

use super::Study;
use crate::campbell::{self, Campbell};
use crate::equilibrium::{
    self, Branches, Continuation, CriticalState, Crossing, Equilibrium, Line, Range, Search, Sweep,
};
use crate::modes::{Family, PerMode, Whirl};
use crate::sensitivity::{
    self, EquilibriumShift, ModeCurvature, OutputSensitivities, Quantity, Sensitivities,
    ShapeSensitivity,
};
use crate::tolerance::{
    self, Band, ClusterTolerance, EventTolerance, FirstOrder, ModeMargin, MonteCarlo,
    OutputTolerances, Sampling, SecondOrder, Summary,
};
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
        self.modes_at(&self.equilibrium()?)
    }

    fn modes_at(&self, state: &Equilibrium<N, U, P>) -> Result<Modes<N>, Error> {
        let family = self.family.unwrap_or(Family::of(state.description));
        modes::modes_of(&state.linear, family, state.description)
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
        sensitivity::sensitivities(&self.mechanism, &state, &self.modes_at(&state)?)
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
        let found = self.modes_at(&state)?;
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
        let found = self.modes_at(&state)?;
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

    /// Derivatives of the shapes of one mode, counted from 0 ([`sensitivity::shape_sensitivity`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn shape_sensitivity(&self, mode: usize) -> Result<ShapeSensitivity<N, U, P>, Error> {
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        sensitivity::shape_sensitivity(&self.mechanism, &state, &found, mode)
    }

    /// First and second derivatives of one mode, counted from 0 ([`sensitivity::mode_curvature`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and the function.
    pub fn mode_curvature(&self, mode: usize) -> Result<ModeCurvature<U, P>, Error> {
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        sensitivity::mode_curvature(&self.mechanism, &state, &found, mode)
    }

    /// Spread of every mode to second order ([`tolerance::second_order`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes and tolerances; a mode without second derivatives says so itself.
    pub fn second_order(&self) -> Result<SecondOrder<P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        Ok(tolerance::second_order(
            &self.mechanism,
            &state,
            &found,
            &tolerances,
        ))
    }

    /// The modes that tolerances bring together, and their spread ([`tolerance::clusters`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn clusters(&self) -> Result<Vec<ClusterTolerance<U, P>>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        tolerance::clusters(&self.mechanism, &state, &found, &tolerances)
    }

    /// First order, second order, clusters, and for each mode whether its standard deviation is to be believed
    /// ([`tolerance::summary`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn summary(&self) -> Result<Summary<N, U, P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        tolerance::summary(&self.mechanism, &state, &found, &tolerances)
    }

    /// Probability that the frequency of one mode, counted from 0, lies in a forbidden band
    /// ([`tolerance::mode_margin`]).
    ///
    /// # Errors
    /// Those of equilibrium, modes, tolerances and the function.
    pub fn margin(&self, mode: usize, band: Band) -> Result<ModeMargin<U, P>, Error> {
        self.margin_of(mode, Quantity::Frequency, band)
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
    ) -> Result<ModeMargin<U, P>, Error> {
        let tolerances = self.tolerances()?;
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        tolerance::mode_margin(
            &self.mechanism,
            &state,
            &found,
            (mode, quantity),
            &tolerances,
            band,
        )
    }

    /// How each mode whirls ([`modes::whirls`]).
    ///
    /// # Errors
    /// Those of equilibrium and modes.
    pub fn whirls(&self) -> Result<PerMode<Option<Whirl>, N>, Error> {
        let state = self.equilibrium()?;
        let found = self.modes_at(&state)?;
        Ok(modes::whirls(&self.mechanism, &state, &found))
    }

    /// Campbell diagram along one input, with the crossings of engine orders ([`campbell::campbell`]).
    ///
    /// # Errors
    /// Those of the tolerances, [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn campbell(
        &self,
        input: Input,
        values: &[f64],
        orders: &[f64],
    ) -> Result<Campbell<N, U, P>, Error> {
        let orders: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        campbell::campbell(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.following(),
            input,
            values,
            &orders,
            &self.tolerances()?,
        )
    }

    /// Values of an input between `low` and `high`, SI, where an oscillation begins or ceases to grow
    /// ([`equilibrium::flutter_onsets`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn flutter_onsets(
        &self,
        input: Input,
        low: f64,
        high: f64,
    ) -> Result<Vec<Crossing<N, U, P>>, Error> {
        self.ready()?;
        equilibrium::flutter_onsets(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.following(),
            Range {
                input,
                low,
                high,
                steps: self.steps,
            },
        )
    }

    /// As [`Study::flutter_onsets`], with their sensitivities and spreads ([`tolerance::crossing_tolerance`]).
    ///
    /// # Errors
    /// Those of [`Study::flutter_onsets`] and [`Study::tolerances`]; a value without a derivative says so itself.
    pub fn flutter_onset_tolerances(
        &self,
        input: Input,
        low: f64,
        high: f64,
    ) -> Result<Vec<EventTolerance<P>>, Error> {
        let tolerances = self.tolerances()?;
        let found = self.flutter_onsets(input, low, high)?;
        let spread =
            |crossing| tolerance::crossing_tolerance(&self.mechanism, crossing, &tolerances);
        Ok(found.iter().map(spread).collect())
    }

    /// Equilibria and modes at each value of one input, and the critical values on the way ([`equilibrium::sweep`]).
    ///
    /// # Errors
    /// [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn sweep(&self, input: Input, values: &[f64]) -> Result<Sweep<N, U, P>, Error> {
        self.ready()?;
        equilibrium::sweep(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.following(),
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

    /// Values of an input between `low` and `high`, SI, where a frequency meets a line: a number `k` for the line
    /// `k u`, or a [`Line`]
    /// ([`equilibrium::crossings`]).
    ///
    /// # Errors
    /// Those of the function.
    pub fn crossings(
        &self,
        input: Input,
        low: f64,
        high: f64,
        line: impl Into<Line>,
    ) -> Result<Vec<Crossing<N, U, P>>, Error> {
        self.ready()?;
        equilibrium::crossings(
            &self.mechanism,
            &self.inputs,
            &self.design,
            &self.start,
            self.following(),
            Range {
                input,
                low,
                high,
                steps: self.steps,
            },
            line,
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
        line: impl Into<Line>,
    ) -> Result<Vec<EventTolerance<P>>, Error> {
        let tolerances = self.tolerances()?;
        let found = self.crossings(input, low, high, line)?;
        let spread =
            |crossing| tolerance::crossing_tolerance(&self.mechanism, crossing, &tolerances);
        Ok(found.iter().map(spread).collect())
    }
}
