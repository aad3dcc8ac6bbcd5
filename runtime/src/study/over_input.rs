//! Methods of a study along one input: sweeps, diagrams and branches.

use core::ops::ControlFlow;
use std::borrow::Cow;

use super::deviating::Table;
use super::settings::Settings;
use super::{Study, Value};
use crate::branches::{self, Branch, Branches, Continuation};
use crate::campbell::{self, Axes, Campbell, CampbellPoint};
use crate::equilibrium::{Policy, Search};
use crate::event_map::EventMap;
use crate::kernels::{BatchKernels, DirectionalKernels, Kernels};
use crate::sensitivity::Sensitivities;
use crate::sweep::{self, Following, Line, Range, Sweep, SweepPoint};
use crate::tolerance;
use crate::tolerance::{FirstOrder, Tolerances};
use crate::{DesignVariable, Error, Input, Watch};

impl<M: BatchKernels> Study<M> {
    /// Computes equilibria and modes at each value of one input, and the critical values between them
    /// ([`sweep::sweep`]).
    #[doc = include_str!("example.txt")]
    /// let sweep = study.sweep(Pendulum::omega, &[2.0, 3.0, 4.0, 5.0])?;
    /// assert!((sweep.critical[0].value - 14.715_f64.sqrt()).abs() < 1e-9);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::UnknownHandle`], [`Error::NotAssembled`]; a point that fails carries its own error.
    pub fn sweep(&self, input: Input<M>, values: &[impl Into<Value> + Copy]) -> Result<Sweep, Error> {
        let mut points = Vec::new();
        let mut whole = self.sweep_each(input, values, |point| {
            points.push(point.clone());
            ControlFlow::Continue(())
        })?;
        whole.points = points;
        Ok(whole)
    }

    /// Like [`Study::sweep`], but passes each point to `each` as soon as it is found and keeps none; `each` can break
    /// off the sweep ([`sweep::sweep_each`]).
    #[doc = include_str!("example.txt")]
    /// use std::ops::ControlFlow;
    ///
    /// let values: Vec<f64> = (0..1000).map(|k| 4.0 + 1e-3 * f64::from(k)).collect();
    /// study.sweep_each(Pendulum::omega, &values, |point| {
    ///     println!("{}: {:?}", point.value, point.modes.as_ref().map(|modes| modes.frequencies()));
    ///     ControlFlow::Continue(())
    /// })?;
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sweep`].
    pub fn sweep_each(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
        mut each: impl FnMut(&SweepPoint) -> ControlFlow<()>,
    ) -> Result<Sweep, Error> {
        let values = self.settings.values_si(input.any(), values)?;
        Swept::plain(&self.settings, &self.mechanism).sweep_each((input.any(), &values), &mut each)
    }

    /// Calls `each` with the equilibrium, the modes and their total derivatives at each value of one input, in order
    /// ([`sweep::sensitivity_sweep`]).
    #[doc = include_str!("example.txt")]
    /// study.sensitivity_sweep(Pendulum::omega, &[4.0, 4.5, 5.0], |point, slopes| {
    ///     if let Ok(slopes) = slopes {
    ///         println!("{}: {:?}", point.value, slopes.modes[0].frequency());
    ///     }
    /// })?;
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sweep`].
    pub fn sensitivity_sweep(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
        mut each: impl FnMut(&SweepPoint, &Result<Sensitivities, Error>),
    ) -> Result<(), Error> {
        let values = self.settings.values_si(input.any(), values)?;
        Swept::plain(&self.settings, &self.mechanism).sensitivity_sweep((input.any(), &values), &mut each)
    }

    /// First-order spread of the frequencies at each value of one input, in order; modes keep their position and label
    /// ([`Study::sensitivity_sweep`], [`tolerance::first_order`]).
    #[doc = include_str!("example.txt")]
    /// for spread in study.first_order_sweep(Pendulum::omega, &[4.0, 4.5, 5.0])? {
    ///     println!("{}", spread?);
    /// }
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sweep`] and [`Study::tolerances`].
    pub fn first_order_sweep(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
    ) -> Result<Vec<Result<FirstOrder, Error>>, Error> {
        let values = self.settings.values_si(input.any(), values)?;
        Swept::deviating(&self.settings, &self.mechanism)?.first_order_sweep((input.any(), &values))
    }
}

impl<M: DirectionalKernels> Study<M> {
    /// Campbell diagram along one input, with its crossings of lines: engine orders as numbers, or [`Line`]s
    /// ([`campbell::campbell`]).
    #[doc = include_str!("example.txt")]
    /// println!("{}", study.campbell(Pendulum::omega, &[4.0, 5.0, 6.0], &[1.0, 2.0])?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::sweep`] and [`Study::tolerances`].
    pub fn campbell(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
        orders: &[impl Into<Line> + Copy],
    ) -> Result<Campbell, Error> {
        let mut points = Vec::new();
        let mut whole = self.campbell_each(input, values, orders, |point| {
            points.push(point);
            ControlFlow::Continue(())
        })?;
        whole.points = points;
        Ok(whole)
    }

    /// The events between the ends of a range of an input, with their spreads, at each of these values of a design variable:
    /// a critical speed map over the stiffness of a bearing, the limit of stability over what cross-couples.
    #[doc = include_str!("example.txt")]
    /// let map = study.event_map(Pendulum::omega, 1.0, 6.0, &[1.0], Pendulum::l, &[0.5, 1.0, 2.0])?;
    /// // The bar swings outwards where omega^2 = 3 g / (2 l).
    /// let critical = map.points.iter().map(|(l, events)| (l, events.as_ref().unwrap().last().unwrap().value));
    /// assert!(critical.into_iter().all(|(l, omega)| (omega * omega * l - 14.715).abs() < 1e-6));
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::campbell`] for the settings; what fails at one value is part of the result.
    pub fn event_map(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
        orders: &[impl Into<Line> + Copy],
        over: DesignVariable<M>,
        values: &[f64],
    ) -> Result<EventMap, Error> {
        let range = self.range(input, low, high)?;
        let lines: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        let ends = [range.low, range.high];
        let axes = Axes::new(input.any(), &ends, &lines);
        let at = |value: &f64| {
            let mut settings = self.settings.clone();
            settings.set_value(over.any().into(), (*value).into());
            let along = Along::deviating(&settings, &self.mechanism);
            (*value, along.and_then(|along| along.campbell_each(&axes, &mut |_| ControlFlow::Continue(()))))
        };
        let of = (self.input_values(), self.mechanism.description());
        Ok(EventMap::of((input.any(), over.any()), of, values.iter().map(at)))
    }

    /// Like [`Study::campbell`], but passes each point to `each` as soon as it is found and keeps none; `each` can
    /// break off the sweep ([`campbell::campbell_each`]).
    #[doc = include_str!("example.txt")]
    /// use std::ops::ControlFlow;
    ///
    /// let mut seen = 0;
    /// let between = study.campbell_each(Pendulum::omega, &[4.0, 5.0, 6.0], &[1.0], |point| {
    ///     seen += usize::from(point.modes.is_ok());
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert!(seen == 3 && between.points.is_empty());
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::campbell`].
    pub fn campbell_each(
        &self,
        input: Input<M>,
        values: &[impl Into<Value> + Copy],
        orders: &[impl Into<Line> + Copy],
        mut each: impl FnMut(CampbellPoint) -> ControlFlow<()>,
    ) -> Result<Campbell, Error> {
        let orders: Vec<Line> = orders.iter().map(|&order| order.into()).collect();
        let values = self.settings.values_si(input.any(), values)?;
        let axes = Axes::new(input.any(), &values, &orders);
        Along::deviating(&self.settings, &self.mechanism)?.campbell_each(&axes, &mut each)
    }

    /// Follows branches of equilibria while an input goes from `low` to `high` ([`branches::branches`]).
    #[doc = include_str!("example.txt")]
    /// let branches = study.branches(Pendulum::omega, 0.0, 6.0)?;
    /// for point in branches.special() {
    ///     println!("{point}");
    /// }
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::equilibrium`] if there is none at either end; [`Error::Setting`], [`Error::UnknownHandle`].
    pub fn branches(&self, input: Input<M>, low: impl Into<Value>, high: impl Into<Value>) -> Result<Branches, Error> {
        self.branches_with(&self.continuation(input, low, high)?, None)
    }

    /// Like [`Study::branches`], with custom settings and a search from many starting points.
    #[doc = include_str!("example.txt")]
    /// use eigentol::equilibrium::Search;
    ///
    /// let settings = study.continuation(Pendulum::omega, 0.0, 6.0)?.max_step(0.1);
    /// let search = Search::new([-3.0], [3.0]);
    /// println!("{}", study.branches_with(&settings, Some(&search))?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::branches`].
    pub fn branches_with(&self, continuation: &Continuation, search: Option<&Search>) -> Result<Branches, Error> {
        self.branches_each(continuation, search, |_| {})
    }

    /// Like [`Study::branches_with`], passing each branch to `each` as soon as it is complete
    /// ([`branches::branches_each`]).
    #[doc = include_str!("example.txt")]
    /// let settings = study.continuation(Pendulum::omega, 0.0, 6.0)?;
    /// study.branches_each(&settings, None, |branch| println!("{} points", branch.points.len()))?;
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// As [`Study::branches`].
    pub fn branches_each(
        &self,
        continuation: &Continuation,
        search: Option<&Search>,
        mut each: impl FnMut(&Branch),
    ) -> Result<Branches, Error> {
        Along::plain(&self.settings, &self.mechanism).branches_each(continuation, search, &mut each)
    }

    /// The settings with which [`Study::branches`] follows branches from `low` to `high`, to be modified and passed to
    /// [`Study::branches_with`].
    #[doc = include_str!("example.txt")]
    /// let fine = study.continuation(Pendulum::omega, 0.0, 6.0)?.max_step(0.01);
    /// println!("{}", study.branches_with(&fine, None)?);
    #[doc = include_str!("end.txt")]
    /// # Errors
    /// [`Error::UnknownHandle`].
    pub fn continuation(
        &self,
        input: Input<M>,
        low: impl Into<Value>,
        high: impl Into<Value>,
    ) -> Result<Continuation, Error> {
        let Range { input, low, high, .. } = self.range(input, low, high)?;
        Ok(Continuation::new(input, low, high))
    }
}

impl<M: Kernels> Study<M> {
    pub(super) fn range(&self, input: Input<M>, low: impl Into<Value>, high: impl Into<Value>) -> Result<Range, Error> {
        let input = input.any();
        let [low, high] = [low.into(), high.into()].map(|end| self.settings.si(input.into(), end));
        Ok(Range::new(input, low?, high?).steps(self.settings.steps))
    }
}

/// The mechanism of a sweep.
type Swept<'a> = Table<'a, dyn BatchKernels + 'a>;
/// The mechanism of any other question along an input.
impl<K: Kernels + ?Sized> Table<'_, K> {
    /// The start of a way along an input from a value, and what to follow: the equilibrium to be kept, if there is one.
    pub(super) fn way(&self, plain: &dyn Kernels, from: (Input, f64)) -> Result<(Cow<'_, [f64]>, Following), Error> {
        let settings = self.settings;
        let start = settings.assembled_start(plain)?;
        let mut following = Following::from(settings.policy).family(settings.family).vectors(settings.vectors);
        let Some(state) = settings.kept(plain, from) else {
            return Ok((start, following));
        };
        following = following.policy(Policy::about(&state));
        following.held = self.state(&state).free.held.clone();
        Ok((Cow::Owned(state.coordinates.into()), following))
    }
}

pub(super) type Along<'a> = Table<'a, dyn DirectionalKernels + 'a>;

impl Swept<'_> {
    fn sweep_each(
        &self,
        along: (Input, &[f64]),
        each: &mut dyn FnMut(&SweepPoint) -> ControlFlow<()>,
    ) -> Result<Sweep, Error> {
        let point = (&self.settings.inputs[..], &self.design[..]);
        let from = (along.0, first_of(along.1));
        let (start, following) = self.way(self.plain, from)?;
        let watch = self.settings.watch();
        let each = |sweep_point: &SweepPoint| go_on(each(sweep_point), watch);
        sweep::sweep_each(self.kernels(), point, &start, following, along, each)
    }

    fn sensitivity_sweep(
        &self,
        along: (Input, &[f64]),
        each: &mut dyn FnMut(&SweepPoint, &Result<Sensitivities, Error>),
    ) -> Result<(), Error> {
        let point = (&self.settings.inputs[..], &self.design[..]);
        let from = (along.0, first_of(along.1));
        let (start, following) = self.way(self.plain, from)?;
        let watch = self.settings.watch();
        let each = |point: &SweepPoint, slopes: &Result<Sensitivities, Error>| {
            each(point, slopes);
            go_on(ControlFlow::Continue(()), watch)
        };
        sweep::sensitivity_sweep(self.kernels(), point, &start, following, along, each)
    }

    fn first_order_sweep(&self, along: (Input, &[f64])) -> Result<Vec<Result<FirstOrder, Error>>, Error> {
        let tolerances = self.settings.tolerances()?;
        let mut spreads = Vec::with_capacity(along.1.len());
        self.sensitivity_sweep(along, &mut |point, slopes| {
            spreads.push(spread(point, slopes, tolerances));
        })?;
        Ok(spreads)
    }
}

impl Along<'_> {
    fn campbell_each(
        &self,
        axes: &Axes<'_>,
        each: &mut dyn FnMut(CampbellPoint) -> ControlFlow<()>,
    ) -> Result<Campbell, Error> {
        let (kernels, settings) = (self.kernels(), self.settings);
        let point = (&settings.inputs[..], &self.design[..]);
        let from = (axes.input, first_of(axes.values));
        let (start, following) = self.way(self.plain, from)?;
        let (tolerances, watch) = (settings.tolerances()?, settings.watch());
        let each = |campbell_point| go_on(each(campbell_point), watch);
        campbell::campbell_each(kernels, point, &start, following, axes, tolerances, each)
    }

    fn branches_each(
        &self,
        continuation: &Continuation,
        search: Option<&Search>,
        each: &mut dyn FnMut(&Branch),
    ) -> Result<Branches, Error> {
        let settings = self.settings;
        let point = (&settings.inputs[..], &self.design[..]);
        let from = (continuation.input, continuation.low);
        let (start, _) = self.way(self.plain, from)?;
        let held = settings.held_in(search, &start);
        let how = (continuation, held.as_ref());
        branches::branches_each(self.kernels(), point, &start, how, settings.watch(), each)
    }
}

/// The first of some values.
pub(super) fn first_of(values: &[f64]) -> f64 {
    values.first().copied().unwrap_or(f64::NAN)
}

/// Reports progress after one more value, and checks whether to stop.
fn go_on(wanted: ControlFlow<()>, watch: Watch<'_>) -> ControlFlow<()> {
    watch.advance(1);
    if watch.stopped() { ControlFlow::Break(()) } else { wanted }
}

/// First-order spread at one input value, or the error there.
fn spread(
    point: &SweepPoint,
    slopes: &Result<Sensitivities, Error>,
    tolerances: &Tolerances,
) -> Result<FirstOrder, Error> {
    match (&point.modes, slopes) {
        (Ok(modes), Ok(slopes)) => tolerance::first_order(modes, slopes, tolerances),
        (Err(error), _) | (_, Err(error)) => Err(error.clone()),
    }
}

impl Settings {
    /// Converts values of an input to SI.
    pub(super) fn values_si(&self, input: Input, values: &[impl Into<Value> + Copy]) -> Result<Vec<f64>, Error> {
        values.iter().map(|&value: &_| self.si(input.into(), Into::into(value))).collect()
    }
}
