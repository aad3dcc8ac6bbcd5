//! Methods of a study for events along an input: loss of stiffness, a frequency crossing a line, onset of flutter.

use super::over_input::Along;
use super::{Study, Value};
use crate::kernels::{CurvatureKernels, DirectionalKernels};
use crate::second_order::{self, EventCurvature};
use crate::sweep::{self, CriticalState, Crossing, EventTolerance, Events, Line, Range};
use crate::{Error, Input};

impl<M: DirectionalKernels> Study<M> {
    /// Finds every event of an input between `low` and `high`: where frequencies meet lines (engine orders as numbers, or
    /// [`Line`]s), where oscillations start or stop growing, and where stiffness vanishes ([`sweep::events`]).
    #[doc = include_str!("example.txt")]
    /// let found = study.events(Pendulum::omega, 0.5, 6.0, &[1.0])?;
    /// assert!((found.critical[0].value - 14.715_f64.sqrt()).abs() < 1e-9);
    /// assert!((found.crossings[0].value - (14.715_f64 / 2.0).sqrt()).abs() < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::Setting`], [`Error::UnknownHandle`], [`Error::NotAssembled`].
    pub fn events(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        orders: &[impl Into<Line> + Copy],
    ) -> Result<Events, Error> {
        let lines: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        Along::plain(&self.settings, &self.mechanism).events(self.range(input, low, high)?, &lines)
    }

    /// Finds the first critical value of an input between `low` and `high` ([`sweep::critical_state`]).
    #[doc = include_str!("example.txt")]
    /// let critical = study.critical_state(Pendulum::omega, 0.0, 6.0)?;
    /// assert!((critical.value - 14.715_f64.sqrt()).abs() < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::NotInRange`], [`Error::Setting`], [`Error::UnknownHandle`]; where the branch cannot be followed so far,
    /// as [`Study::equilibrium`].
    pub fn critical_state(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<CriticalState, Error> {
        Along::plain(&self.settings, &self.mechanism).critical_state(self.range(input, low, high)?)
    }

    /// Like [`Study::critical_state`], with the sensitivity and spread of the value ([`sweep::critical_tolerance`]).
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.critical_tolerance(Pendulum::omega, 0.0, 6.0)?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::critical_state`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn critical_tolerance(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<EventTolerance, Error> {
        let range = self.range(input, low, high)?;
        Along::deviating(&self.settings, &self.mechanism)?.critical_tolerance(range)
    }

    /// Finds the values of an input between `low` and `high` where a frequency crosses a line: a number `k` for the
    /// line `k u`, or a [`Line`] ([`sweep::crossings`]).
    #[doc = include_str!("example.txt")]
    /// let resonances = study.crossings(Pendulum::omega, 0.5, 3.5, 1.0)?;
    /// assert!((resonances[0].value - (14.715_f64 / 2.0).sqrt()).abs() < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::modes`] at the first point; [`Error::Setting`], [`Error::UnknownHandle`].
    pub fn crossings(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        line: impl Into<Line>,
    ) -> Result<Vec<Crossing>, Error> {
        let range = self.range(input, low, high)?;
        Along::plain(&self.settings, &self.mechanism).crossings(range, Some(line.into()))
    }

    /// Like [`Study::crossings`], with sensitivities and spreads of the values ([`sweep::crossing_tolerance`]).
    #[doc = include_str!("example.txt")]
    /// for resonance in study.crossing_tolerances(Pendulum::omega, 0.5, 3.5, 1.0)? {
    ///     println!("{resonance}");
    /// }
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::crossings`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn crossing_tolerances(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        line: impl Into<Line>,
    ) -> Result<Vec<EventTolerance>, Error> {
        let range = self.range(input, low, high)?;
        Along::deviating(&self.settings, &self.mechanism)?.crossing_tolerances(range, Some(line.into()))
    }

    /// Finds the values of an input between `low` and `high` where an oscillation starts or stops growing
    /// ([`sweep::flutter_onsets`]).
    #[doc = include_str!("example.txt")]
    /// // A bar without damping never flutters.
    /// assert!(study.flutter_onsets(Pendulum::omega, 4.0, 6.0)?.is_empty());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::crossings`].
    pub fn flutter_onsets(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Vec<Crossing>, Error> {
        let range = self.range(input, low, high)?;
        Along::plain(&self.settings, &self.mechanism).crossings(range, None)
    }

    /// Like [`Study::flutter_onsets`], with sensitivities and spreads of the values ([`sweep::crossing_tolerance`]).
    #[doc = include_str!("example.txt")]
    /// assert!(study.flutter_onset_tolerances(Pendulum::omega, 4.0, 6.0)?.is_empty());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::crossings`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn flutter_onset_tolerances(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Vec<EventTolerance>, Error> {
        let range = self.range(input, low, high)?;
        Along::deviating(&self.settings, &self.mechanism)?.crossing_tolerances(range, None)
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// Like [`Study::critical_state`], with first and second derivatives of the value
    /// ([`critical_curvature`](crate::second_order::critical_curvature)).
    #[doc = include_str!("example.txt")]
    /// let critical = study.critical_curvature(Pendulum::omega, 0.0, 6.0)?;
    /// // omega_c = sqrt(3 g / (2 l)), so its second derivative is 3 / 4 of it.
    /// let l = Pendulum::l.index();
    /// assert!((critical.second[l][l] - 0.75 * critical.value).abs() < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::critical_state`]; [`Error::NoSensitivity`], [`Error::ClusteredMode`] where the value has no derivatives.
    pub fn critical_curvature(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<EventCurvature, Error> {
        let state = self.critical_state(input, low, high)?;
        second_order::critical_curvature(&self.mechanism, &state)
    }
}

impl Along<'_> {
    fn events(&self, range: Range, lines: &[Line]) -> Result<Events, Error> {
        let (u, b) = (&self.settings.inputs, &self.design);
        let (start, following) = self.way(self.plain, (range.input, range.low))?;
        sweep::events(self.kernels(), u, b, &start, following, range, lines)
    }

    fn critical_state(&self, range: Range) -> Result<CriticalState, Error> {
        let (u, b) = (&self.settings.inputs, &self.design);
        let (start, _) = self.way(self.plain, (range.input, range.low))?;
        sweep::critical_state(self.kernels(), u, b, &start, range)
    }

    fn critical_tolerance(&self, range: Range) -> Result<EventTolerance, Error> {
        let tolerances = self.settings.tolerances()?;
        let state = self.critical_state(range)?;
        Ok(sweep::critical_tolerance(self.kernels(), &state, tolerances))
    }

    /// Crossings of a line, without one onsets of flutter.
    fn crossings(&self, range: Range, line: Option<Line>) -> Result<Vec<Crossing>, Error> {
        let (u, b) = (&self.settings.inputs, &self.design);
        let (start, following) = self.way(self.plain, (range.input, range.low))?;
        match line {
            Some(line) => sweep::crossings(self.kernels(), u, b, &start, following, range, line),
            None => sweep::flutter_onsets(self.kernels(), u, b, &start, following, range),
        }
    }

    /// The spread of each of their values.
    fn crossing_tolerances(&self, range: Range, line: Option<Line>) -> Result<Vec<EventTolerance>, Error> {
        let tolerances = self.settings.tolerances()?;
        let spread = |crossing| sweep::crossing_tolerance(self.kernels(), crossing, tolerances);
        Ok(self.crossings(range, line)?.iter().map(spread).collect())
    }
}
