//! Methods of a study for events along an input: loss of stiffness, a frequency crossing a line, onset of flutter.

use std::borrow::Cow;

use super::deviating::Table;
use super::settings::Settings;
use super::{Study, Value};
use crate::kernels::{CurvatureKernels, DirectionalKernels, Kernels};
use crate::second_order::{self, EventCurvature};
use crate::sweep::{self, CriticalState, Crossing, EventTolerance, Events, Following, Line, Range};
use crate::tolerance::Tolerances;
use crate::{Error, Input};

impl<M: DirectionalKernels> Study<M> {
    /// Finds every event of an input between `low` and `high`: where frequencies meet lines (engine orders as numbers, or
    /// [`Line`]s), where oscillations start or stop growing, and where stiffness vanishes ([`sweep::events`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let found = study.events(Pendulum::omega, 0.5, 6.0, &[1.0])?;
    /// assert!((found.critical[0].value - 14.715_f64.sqrt()).abs() < 1e-9);
    /// assert!((found.crossings[0].value - (14.715_f64 / 2.0).sqrt()).abs() < 1e-9);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::UnknownHandle`], [`Error::NotAssembled`].
    pub fn events(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        orders: &[impl Into<Line> + Copy],
    ) -> Result<Events, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        let lines: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        self.settings.events(&self.mechanism, range, &lines)
    }

    /// Finds the first critical value of an input between `low` and `high` ([`sweep::critical_state`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let critical = study.critical_state(Pendulum::omega, 0.0, 6.0)?;
    /// assert!((critical.value - 14.715_f64.sqrt()).abs() < 1e-9);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotInRange`], [`Error::Setting`], [`Error::UnknownHandle`]; where the branch cannot be followed so far,
    /// as [`Study::equilibrium`].
    pub fn critical_state(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<CriticalState, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings.critical_state(&self.mechanism, range)
    }

    /// Like [`Study::critical_state`], with the sensitivity and spread of the value ([`sweep::critical_tolerance`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.critical_tolerance(Pendulum::omega, 0.0, 6.0)?);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::critical_state`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn critical_tolerance(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<EventTolerance, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings.critical_tolerance(&self.mechanism, range)
    }
}

impl<M: CurvatureKernels> Study<M> {
    /// Like [`Study::critical_state`], with first and second derivatives of the value
    /// ([`critical_curvature`](crate::second_order::critical_curvature)).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let critical = study.critical_curvature(Pendulum::omega, 0.0, 6.0)?;
    /// // omega_c = sqrt(3 g / (2 l)), so its second derivative is 3 / 4 of it.
    /// let l = Pendulum::l.index();
    /// assert!((critical.second[l][l] - 0.75 * critical.value).abs() < 1e-9);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
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

impl<M: DirectionalKernels> Study<M> {
    /// Finds the values of an input between `low` and `high` where a frequency crosses a line: a number `k` for the
    /// line `k u`, or a [`Line`] ([`sweep::crossings`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// let resonances = study.crossings(Pendulum::omega, 0.5, 3.5, 1.0)?;
    /// assert!((resonances[0].value - (14.715_f64 / 2.0).sqrt()).abs() < 1e-9);
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::modes`] at the first point; [`Error::Setting`], [`Error::UnknownHandle`].
    pub fn crossings(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        line: impl Into<Line>,
    ) -> Result<Vec<Crossing>, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings.crossings(&self.mechanism, range, line.into())
    }

    /// Like [`Study::crossings`], with sensitivities and spreads of the values ([`sweep::crossing_tolerance`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// for resonance in study.crossing_tolerances(Pendulum::omega, 0.5, 3.5, 1.0)? {
    ///     println!("{resonance}");
    /// }
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::crossings`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn crossing_tolerances(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        line: impl Into<Line>,
    ) -> Result<Vec<EventTolerance>, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings
            .crossing_tolerances(&self.mechanism, range, line.into())
    }

    /// Finds the values of an input between `low` and `high` where an oscillation starts or stops growing
    /// ([`sweep::flutter_onsets`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// // A bar without damping never flutters.
    /// assert!(study.flutter_onsets(Pendulum::omega, 4.0, 6.0)?.is_empty());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::crossings`].
    pub fn flutter_onsets(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Vec<Crossing>, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings.flutter_onsets(&self.mechanism, range)
    }

    /// Like [`Study::flutter_onsets`], with sensitivities and spreads of the values ([`sweep::crossing_tolerance`]).
    ///
    /// ```
    #[doc = include_str!("example.txt")]
    /// assert!(study.flutter_onset_tolerances(Pendulum::omega, 4.0, 6.0)?.is_empty());
    /// # Ok::<(), eigentol::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Study::crossings`] and [`Study::tolerances`]; a value without a derivative carries its own error.
    pub fn flutter_onset_tolerances(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Vec<EventTolerance>, Error> {
        let range = self.settings.range(input.any(), low.into(), high.into())?;
        self.settings
            .flutter_onset_tolerances(&self.mechanism, range)
    }
}

/// The mechanism of a question along an input.
type Along<'a> = Table<'a, dyn DirectionalKernels + 'a>;

impl Settings {
    fn events(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
        lines: &[Line],
    ) -> Result<Events, Error> {
        let (u, b) = (&self.inputs, &self.design);
        let (start, following) = self.along(&self.plain(kernels), range)?;
        sweep::events(kernels, u, b, &start, following, range, lines)
    }

    fn critical_state(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
    ) -> Result<CriticalState, Error> {
        self.critical(&self.plain(kernels), range)
    }

    fn critical_tolerance(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
    ) -> Result<EventTolerance, Error> {
        let (table, tolerances) = (self.deviating(kernels)?, self.tolerances()?);
        let state = self.critical(&table, range)?;
        Ok(sweep::critical_tolerance(
            table.kernels(),
            &state,
            tolerances,
        ))
    }

    fn crossings(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
        line: Line,
    ) -> Result<Vec<Crossing>, Error> {
        self.crossed(&self.plain(kernels), range, line)
    }

    fn crossing_tolerances(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
        line: Line,
    ) -> Result<Vec<EventTolerance>, Error> {
        let (table, tolerances) = (self.deviating(kernels)?, self.tolerances()?);
        let crossings = self.crossed(&table, range, line)?;
        Ok(spreads(table.kernels(), &crossings, tolerances))
    }

    fn flutter_onsets(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
    ) -> Result<Vec<Crossing>, Error> {
        self.onsets(&self.plain(kernels), range)
    }

    fn flutter_onset_tolerances(
        &self,
        kernels: &dyn DirectionalKernels,
        range: Range,
    ) -> Result<Vec<EventTolerance>, Error> {
        let (table, tolerances) = (self.deviating(kernels)?, self.tolerances()?);
        let onsets = self.onsets(&table, range)?;
        Ok(spreads(table.kernels(), &onsets, tolerances))
    }

    fn along(&self, table: &Along<'_>, range: Range) -> Result<(Cow<'_, [f64]>, Following), Error> {
        self.way(table.plain, table, (range.input, range.low))
    }

    fn critical(&self, table: &Along<'_>, range: Range) -> Result<CriticalState, Error> {
        let (start, _) = self.along(table, range)?;
        sweep::critical_state(table.kernels(), &self.inputs, &table.design, &start, range)
    }

    fn crossed(&self, table: &Along<'_>, range: Range, line: Line) -> Result<Vec<Crossing>, Error> {
        let (u, b) = (&self.inputs, &table.design);
        let (start, following) = self.along(table, range)?;
        sweep::crossings(table.kernels(), u, b, &start, following, range, line)
    }

    fn onsets(&self, table: &Along<'_>, range: Range) -> Result<Vec<Crossing>, Error> {
        let (u, b) = (&self.inputs, &table.design);
        let (start, following) = self.along(table, range)?;
        sweep::flutter_onsets(table.kernels(), u, b, &start, following, range)
    }
}

/// The spread of each crossing value.
fn spreads(
    mechanism: &dyn Kernels,
    crossings: &[Crossing],
    tolerances: &Tolerances,
) -> Vec<EventTolerance> {
    let spread = |crossing| sweep::crossing_tolerance(mechanism, crossing, tolerances);
    crossings.iter().map(spread).collect()
}
