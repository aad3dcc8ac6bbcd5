//! What a study can be asked along an input: sweeps, diagrams, branches, and where something happens.

use super::Study;
use crate::campbell::{self, Axes, Campbell};
use crate::equilibrium::{
    self, Branches, Continuation, CriticalState, Crossing, Line, Range, Search, Sweep, SweepPoint,
};
use crate::sensitivity::{self, Sensitivities};
use crate::tolerance::{self, EventTolerance, FirstOrder};
use crate::{Error, Input, Mechanism};

impl<M, const N: usize, const U: usize, const P: usize, const O: usize> Study<M, N, U, P, O>
where
    M: Mechanism<N, U, P, O>,
{
    /// Equilibria and modes at each value of one input, and the critical values on the way ([`equilibrium::sweep`]).
    ///
    /// # Errors
    /// [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn sweep(&self, input: Input, values: &[f64]) -> Result<Sweep<N, U, P>, Error> {
        self.ask(|study| {
            equilibrium::sweep(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                study.following(),
                input,
                values,
            )
        })
    }

    /// Shows equilibrium, modes and their total derivatives at each value of one input to `each`, in order
    /// ([`sensitivity::sensitivity_sweep`]).
    ///
    /// # Errors
    /// [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn sensitivity_sweep(
        &self,
        input: Input,
        values: &[f64],
        each: impl FnMut(&SweepPoint<N, U, P>, &Result<Sensitivities<N, U, P>, Error>) + Send,
    ) -> Result<(), Error> {
        self.ask(|study| {
            sensitivity::sensitivity_sweep(
                &study.mechanism,
                (&study.inputs, &study.design),
                &study.assembled_start()?,
                study.following(),
                (input, values),
                each,
            )
        })
    }

    /// First-order spread of the frequencies at each value of one input, in order; modes keep their place and their label
    /// ([`Study::sensitivity_sweep`], [`tolerance::first_order`]).
    ///
    /// # Errors
    /// Those of the tolerances, [`Error::UnknownHandle`]; a value that fails has its own error.
    pub fn first_order_sweep(
        &self,
        input: Input,
        values: &[f64],
    ) -> Result<Vec<Result<FirstOrder<N, P>, Error>>, Error> {
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let mut found = Vec::with_capacity(values.len());
            study.sensitivity_sweep(input, values, |point, slopes| {
                found.push(match (&point.modes, slopes) {
                    (Ok(modes), Ok(slopes)) => {
                        Ok(tolerance::first_order(modes, slopes, &tolerances))
                    }
                    (Err(error), _) | (_, Err(error)) => Err(error.clone()),
                });
            })?;
            Ok(found)
        })
    }

    /// Campbell diagram along one input, with the crossings of lines: engine orders as numbers, or
    /// [`Line`]s ([`campbell::campbell`]).
    ///
    /// # Errors
    /// Those of the tolerances, [`Error::UnknownHandle`]; a point that fails carries its own error.
    pub fn campbell(
        &self,
        input: Input,
        values: &[f64],
        orders: &[impl Into<Line> + Copy],
    ) -> Result<Campbell<N, U, P>, Error> {
        let orders: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        self.ask(|study| {
            campbell::campbell(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                study.following(),
                &Axes {
                    input,
                    values,
                    orders: &orders,
                },
                &study.tolerances()?,
            )
        })
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
        self.ask(|study| {
            equilibrium::branches(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                settings,
                search,
            )
        })
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
        self.ask(|study| {
            equilibrium::critical_state(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                study.range(input, low, high),
            )
        })
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
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let state = study.critical_state(input, low, high)?;
            Ok(tolerance::critical_tolerance(
                &study.mechanism,
                &state,
                &tolerances,
            ))
        })
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
        let line = line.into();
        self.ask(|study| {
            equilibrium::crossings(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                study.following(),
                study.range(input, low, high),
                line,
            )
        })
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
        let line = line.into();
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let found = study.crossings(input, low, high, line)?;
            let spread =
                |crossing| tolerance::crossing_tolerance(&study.mechanism, crossing, &tolerances);
            Ok(found.iter().map(spread).collect())
        })
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
        self.ask(|study| {
            equilibrium::flutter_onsets(
                &study.mechanism,
                &study.inputs,
                &study.design,
                &study.assembled_start()?,
                study.following(),
                study.range(input, low, high),
            )
        })
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
        self.ask(|study| {
            let tolerances = study.tolerances()?;
            let found = study.flutter_onsets(input, low, high)?;
            let spread =
                |crossing| tolerance::crossing_tolerance(&study.mechanism, crossing, &tolerances);
            Ok(found.iter().map(spread).collect())
        })
    }

    fn range(&self, input: Input, low: f64, high: f64) -> Range {
        Range {
            input,
            low,
            high,
            steps: self.steps,
        }
    }
}
