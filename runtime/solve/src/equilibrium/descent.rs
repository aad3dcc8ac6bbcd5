//! Stable equilibria of a mechanism with symmetric `Khat`: the residual is then the gradient of an amended potential,
//! whose minima are the stable equilibria.
//!
//! The search uses Newton's method where the potential is convex. Elsewhere it descends along every mode with the
//! curvature made positive, and leaves saddles along the unstable mode. With constraints on positions the same holds
//! along the directions they leave free.
//!
//! # The stable branch
//!
//! For a symmetric `Khat` the residual is the gradient of an amended potential. The solver descends it with shifted
//! curvature and leaves saddles along the unstable mode, so it cannot end on an unstable equilibrium unnoticed. If it
//! finds no stable one it returns the nearest, whose stability says what it is. A saddle that gyroscopic forces hold (a
//! sleeping top) is kept when the search starts near it. Without a potential there is no descent, and the nearest
//! equilibrium is the answer. Following the diverging motion in time to where it comes to rest (pseudo-transient
//! continuation) was tried: it finds the terminal speed of an accelerating cart, but it lets an upright bicycle fall over,
//! and upright is the state people want to study.

use super::acceptance::{Candidate, UnjudgedResult, last_step};
use super::convergence::{Progress, ResidualMonitor, SMALL_MOTION, TOLERANCE, horizon, largest_of, relative_residual};
use super::operating_point::{Failure, OperatingPoint};
use super::search_space::{Base, SearchSpace, Trial};
use crate::algebra::{Cholesky, Matrix, Values, Vector, add_scaled, add_to, dot, for_size, form, largest, times};
use crate::eigenproblem::{EigenproblemError, symmetric};
use crate::error::NotFound;
use crate::kernels::Linear;
use crate::rounding::{Sign, sign};

const MAX_ITERATIONS: usize = 300;
pub(super) const MAX_DEPARTURES: usize = 8;
/// Largest change of a coordinate in the first step, rad or m; grows while the linear model predicts well.
const FIRST_RADIUS: f64 = 1.0;
/// Factor of each increase.
pub(super) const GROWTH: f64 = 4.0;
/// Displacement (rad or m) with which an unstable equilibrium or a singular configuration is left.
pub(super) const DEPARTURE: f64 = 1e-3;
/// Distance, as a share of a coordinate, and share of the stiffness left there, that tell a pole from an equilibrium.
const BESIDE: f64 = 1e-5;
const VANISHES: f64 = 1e-3;

/// The current state of a search.
pub(super) struct SearchState {
    pub(super) q: Vector,
    /// Largest change of a coordinate in the next step, rad or m.
    pub(super) radius: f64,
    /// Iterations spent so far.
    pub(super) iterations: usize,
}

impl SearchState {
    /// The state at the start of a search.
    #[inline]
    pub(super) fn first(q: &[f64]) -> Self {
        Self { q: q.into(), radius: FIRST_RADIUS, iterations: 0 }
    }
}

/// Descends from `from`, a state on the way from `start`, to a minimum of the amended potential; both states meet the
/// constraints.
///
/// Once the search leaves a region where the potential is not convex, it calls `straight`, which finds the minimum
/// faster if the remaining way is easy.
pub(super) fn minimise_potential<S>(
    point: &OperatingPoint<'_>,
    start: &[f64],
    from: &SearchState,
    straight: impl Fn(SearchState) -> Option<UnjudgedResult>,
) -> Result<UnjudgedResult, Failure>
where
    S: SearchSpace,
{
    let motions = point.motions();
    let mut base: Base<S> = S::base(point, &from.q)?;
    let mut trial = Trial::blank(point.size());
    let mut curved: Option<Curved> = None;
    let mut factors = Cholesky::default();
    let mut radius = from.radius;
    let mut departures = 0;
    let mut left_unstable_region = false;
    let mut was_curved = false;
    let mut watch = ResidualMonitor::new(&base.q);
    let escaped = horizon(&start[..motions]);
    for iterations in from.iterations..MAX_ITERATIONS {
        let at = (&base.residual[..], &base.stiffness);
        let slopes = base.space.slopes(&base.residual);
        let stiffness = base.space.reduced(&base.stiffness);
        let convex = factors.factor(&stiffness).is_ok();
        if was_curved && convex {
            let progress = SearchState { q: base.q.clone(), radius, iterations };
            if let Some(direct) = straight(progress) {
                return Ok(UnjudgedResult { left_unstable_region, ..direct });
            }
        }
        was_curved = !convex;
        let mut step = if convex {
            factors.solve(&slopes).map(|value| -value)
        } else {
            let curved = curved.get_or_insert_with(|| Curved::blank(point.size()));
            curved.solve(point, (&base, iterations), &stiffness)?;
            left_unstable_region |= curved.unstable;
            curved.step(&slopes)
        };
        let outcome = |end: Candidate, iterations| UnjudgedResult {
            left_unstable_region,
            ..UnjudgedResult::new(end, iterations)
        };
        let here = |base: Base<S>| Candidate { coordinates: base.q, residual: base.residual, measured: None };
        step = base.space.lift(step);
        let progress = watch.judge(point, &base.q, at, Some(&step));
        if progress == Progress::Finished {
            let curved = curved.as_ref().filter(|curved| curved.unstable);
            let Some(curved) = curved.filter(|_| !convex) else {
                return Ok(outcome(here(base), iterations));
            };
            departures += 1;
            if departures > MAX_DEPARTURES {
                let reason =
                    if grows_without_bound(point, &base.q) { NotFound::Unbounded } else { NotFound::OnlyUnstable };
                return Err(failure(point, reason, &base.q, iterations));
            }
            let shape = base.space.lift(Vector::from(&curved.pairs.shapes[0]));
            let side = departure(point, &shape, &curved.linear.mass, &base.q, start);
            if !base.space.trial(point, &base.q, (&side, 1.0), &mut trial) {
                return Err(outside(&base.q));
            }
            S::arrive(point, &mut trial, &mut base)?;
            watch = ResidualMonitor::new(&base.q);
            continue;
        }
        if progress == Progress::LastStep
            && convex
            && let Some(end) =
                last_step(point, &base.q, at, &step, |rest| base.space.lift(factors.solve(&base.space.slopes(rest))))
        {
            return Ok(outcome(end, iterations + 1));
        }
        let size = point.size_of(&step);
        let limited = size > radius;
        if limited {
            step = step.map(|value| value * radius / size);
        }
        let Some(next) = search(point, &base, &step, &mut trial) else {
            let relative = relative_residual(point, &base.q, at.0, at.1);
            if relative <= TOLERANCE && convex {
                return Ok(outcome(here(base), iterations));
            }
            let reason = NotFound::NoDescent;
            return Err(failure(point, reason, &base.q, iterations));
        };
        if next.length < 1.0 {
            radius = radius.min(2.0 * next.length * point.size_of(&step));
        } else if limited && next.predicted {
            radius *= GROWTH;
        }
        S::arrive(point, &mut trial, &mut base)?;
        if largest_of(&base.q[..motions]) > escaped {
            let reason = NotFound::Escape;
            return Err(failure(point, reason, &base.q, iterations));
        }
    }
    let reason = NotFound::IterationLimit;
    Err(failure(point, reason, &base.q, MAX_ITERATIONS))
}

/// Whether a force grows without bound where a search ended: the stiffness nearly vanishes a small share of a coordinate
/// away, on either side. Such a state passes for an equilibrium, because any force moves it by rounding only. At a
/// critical state the stiffness vanishes too, but there it is least.
#[cold]
pub(super) fn grows_without_bound(point: &OperatingPoint<'_>, q: &[f64]) -> bool {
    let Some((residual, stiffness)) = point.evaluate(q) else {
        return true;
    };
    let size = |stiffness: &Matrix| largest(stiffness.as_flattened());
    let beside = [-BESIDE, BESIDE].map(|share| {
        let mut aside = Vector::from(q);
        for i in 0..point.motions() {
            let large = point.description.large(i);
            let step = share * q[i].abs().clamp(SMALL_MOTION * large, large);
            aside[i] += step.copysign(step * residual[i]);
        }
        point.evaluate(&aside).map(|(_, stiffness)| size(&stiffness))
    });
    beside.into_iter().flatten().reduce(f64::max).is_some_and(|beside| beside < VANISHES * size(&stiffness))
}

/// The modes at a state where the potential is not convex.
struct Curved {
    pairs: symmetric::Pairs,
    linear: Linear,
    /// The potential decreases along the first mode.
    unstable: bool,
}

impl Curved {
    /// Modes to be overwritten.
    fn blank(n: usize) -> Self {
        Self { pairs: symmetric::Pairs::default(), linear: Linear::zeros(n), unstable: false }
    }

    #[cold]
    fn solve<S>(
        &mut self,
        point: &OperatingPoint<'_>,
        (base, iterations): (&Base<S>, usize),
        stiffness: &Matrix,
    ) -> Result<(), Failure>
    where
        S: SearchSpace,
    {
        point.linear_into(&base.q, &mut self.linear)?;
        let mass = base.space.reduced(&self.linear.mass);
        symmetric::solve_into(stiffness, &mass, &mut self.pairs).map_err(|error| match error {
            EigenproblemError::SingularMass(row) => point.singular_mass(&base.q, row),
            EigenproblemError::Inaccurate { .. } => failure(point, NotFound::NoDescent, &base.q, iterations),
        })?;
        self.unstable = sign(self.pairs.lambda[0], self.pairs.errors[0]) == Sign::Negative;
        Ok(())
    }

    /// A descent step along every mode scaled by the magnitude of its curvature, so that the step leaves unstable modes
    /// instead of approaching the saddle.
    fn step(&self, residual: &[f64]) -> Vector {
        let mut step = Vector::zeros(residual.len());
        for_size(
            residual.len(),
            #[inline(always)]
            |n| {
                let (residual, step) = (&residual[..n], &mut step[..n]);
                let lambda = &self.pairs.lambda[..n];
                let shapes = &self.pairs.shapes.as_flattened()[..n * n];
                let floor = (1e-8 * largest(lambda)).max(f64::MIN_POSITIVE);
                for r in 0..n {
                    let shape = &shapes[r * n..][..n];
                    let slope = dot(shape, residual);
                    if slope != 0.0 {
                        let curvature = lambda[r].abs().max(floor);
                        let amount = (slope / curvature).clamp(-1e100, 1e100);
                        add_to(step, -amount, shape);
                    }
                }
            },
        );
        step
    }
}

fn outside(q: &[f64]) -> Failure {
    Failure::OutsideDomain { what: "the residual", coordinates: q.into() }
}

/// A small step along the unstable mode, towards the user's start value if that indicates a side.
fn departure(point: &OperatingPoint<'_>, shape: &[f64], mass: &Matrix, q: &[f64], start: &[f64]) -> Vector {
    let offset = add_scaled(start, -1.0, q);
    let side = dot(&offset, &times(mass, shape));
    let size = form(&offset, mass, &offset).max(0.0).sqrt();
    // Below a thousandth of the distance the projection does not indicate a side.
    let sign = if side.abs() > 1e-3 * size && point.size_of(&offset) > 1e-9 { side.signum() } else { 1.0 };
    let scale = sign * DEPARTURE / point.size_of(shape);
    shape.map(|value| value * scale)
}

struct Next {
    /// Accepted fraction of the step.
    length: f64,
    /// The linear model predicted the slope at the end correctly.
    predicted: bool,
}

/// The potential along a step, at its beginning: derivatives with respect to the share of the step.
pub(super) struct LineModel {
    pub(super) slope: f64,
    pub(super) curvature: f64,
}

impl LineModel {
    /// Whether the potential is lower at a share `length` of the step, where it has these derivatives.
    ///
    /// Either its minimum along the step is near, or it fell according to the integral of the derivatives (corrected
    /// trapezoidal rule), since the potential itself is not available.
    #[inline]
    pub(super) fn falls(&self, length: f64, slope: f64, curvature: f64) -> bool {
        let near = slope.abs() <= 0.5 * self.slope.abs() && curvature >= 0.0;
        let change = 0.5 * length * (self.slope + slope) + length * length / 12.0 * (self.curvature - curvature);
        near || change <= 1e-4 * length * self.slope
    }

    /// Whether the derivatives at the beginning predicted the slope there.
    #[inline]
    pub(super) fn predicts(&self, length: f64, slope: f64) -> bool {
        let expected = self.slope + length * self.curvature;
        (slope - expected).abs() <= 0.25 * self.slope.abs()
    }
}

/// Line search based on the change of the potential; writes the end of the accepted share to `trial`.
fn search<S>(point: &OperatingPoint<'_>, base: &Base<S>, step: &[f64], trial: &mut Trial) -> Option<Next>
where
    S: SearchSpace,
{
    let way = LineModel { slope: dot(step, &base.residual), curvature: form(step, &base.stiffness, step) };
    if way.slope.is_nan() || way.slope >= 0.0 {
        return None;
    }
    let mut length = 1.0;
    for _ in 0..60 {
        if !base.space.trial(point, &base.q, (step, length), trial) {
            length *= 0.25;
            continue;
        }
        let slope = dot(step, &trial.residual);
        let curvature = form(&trial.direction, &trial.stiffness, &trial.direction);
        if way.falls(length, slope, curvature) {
            return Some(Next { length, predicted: way.predicts(length, slope) });
        }
        length *= if slope > 0.0 { (way.slope / (way.slope - slope)).clamp(0.1, 0.7) } else { 0.5 };
    }
    None
}

#[cold]
fn failure(point: &OperatingPoint<'_>, reason: NotFound, q: &[f64], iterations: usize) -> Failure {
    let relative = point
        .evaluate(q)
        .map_or(f64::INFINITY, |(residual, stiffness)| relative_residual(point, q, &residual, &stiffness));
    Failure::NotFound { reason, coordinates: q.into(), iterations, relative }
}
