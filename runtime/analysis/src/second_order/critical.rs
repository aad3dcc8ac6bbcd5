//! Exact second derivatives of a critical value with respect to the design.

use super::derivatives::symmetric;
use super::event::EventCurvature;
use crate::Error;
use crate::algebra::{Matrix, Vector, add_scaled, add_to, dot, largest, times};
use crate::branches::{Bordered, SpecialKind};
use crate::equilibrium::SMALL_MOTION;
use crate::error::NoDerivative;
use crate::kernels::{CurvatureKernels, DirectionalKernels, Gradient, Kernels};
use crate::sensitivity::{Direction, Slopes, subtract};
use crate::sweep::{CriticalState, Crossed, bordered, critical_sensitivity};

/// First and second derivatives of a critical value with respect to all design variables.
///
/// They follow the state where `Khat` is singular; `v` and `w` are its critical vectors.
///
/// - At a limit point, `w^T dg/du_c du_c + w^T dg/db = 0` is differentiated along the curve of limit points: `dq`
///   includes the component along `v` that keeps `Khat` singular, and `dw` follows `Khat`.
/// - At a pitchfork, `w^T Khat v` vanishes; its first and second derivatives with respect to input and design are taken
///   along the crossed branch, which survives changes of the design.
///
/// # Errors
/// As [`critical_sensitivity`](crate::sweep::critical_sensitivity); [`Error::NoSensitivity`] at a transcritical branch
/// point, which needs third derivatives of the residual, and at a cusp.
pub fn critical_curvature(mechanism: &dyn CurvatureKernels, critical: &CriticalState) -> Result<EventCurvature, Error> {
    let at = &critical.equilibrium;
    let first = critical_sensitivity(mechanism, critical)?;
    if !at.free.held.is_empty() {
        return Err(none(NoDerivative::Family));
    }
    let context = CriticalContext { mechanism, critical, first: &first };
    let rows = match critical.kind {
        SpecialKind::Fold => context.limit_point()?,
        SpecialKind::Pitchfork { .. } => context.pitchfork()?,
        SpecialKind::Transcritical => return Err(none(NoDerivative::Transcritical)),
        SpecialKind::Degenerate => return Err(Error::ClusteredMode { mode: 0 }),
    };
    let rows: Vec<_> = rows.into_iter().map(|by_design| Slopes { by_input: Vector::default(), by_design }).collect();
    let (second, asymmetry) = symmetric(&rows, 0, f64::abs);
    EventCurvature {
        input: critical.input,
        value: critical.value,
        first,
        second: second.by_design,
        asymmetry,
        description: at.description.clone(),
    }
    .finite(at)
}

fn none(reason: NoDerivative) -> Error {
    Error::NoSensitivity { reason }
}

struct CriticalContext<'a> {
    mechanism: &'a dyn CurvatureKernels,
    critical: &'a CriticalState,
    /// `du_c/db`.
    first: &'a [f64],
}

impl CriticalContext<'_> {
    /// The rows of the second derivatives at a limit point.
    fn limit_point(&self) -> Result<Vec<Vector>, Error> {
        let CriticalState { v, w, .. } = self.critical;
        let factors = bordered(self.critical)?;
        let forces = self.forces();
        let input = self.critical.input.index();
        let push = self.residual_gradient(w).inputs[input];
        let by_v = self.bend(w, &self.direction(v.clone(), 0.0, None));
        let curved = dot(&by_v.coordinates, v);
        if self.flat(curved) {
            return Err(none(NoDerivative::Cusp));
        }
        let rows = self.first.iter().enumerate().map(|(k, &rate)| {
            let mut force = forces.of_design(k).map(|value| -value);
            add_to(&mut force, -rate, &forces.of_input);
            let (shift, _) = factors.solve(&force, [0.0]);
            let direction = self.direction(shift, rate, Some(k));
            let along = -dot(&self.bend(w, &direction).coordinates, v) / curved;
            let mut change = self.bend(w, &moved(direction, along, v));
            let (dw, _) = factors.solve_transposed(&change.coordinates, [0.0]);
            subtract(&mut change, &self.residual_gradient(&dw));
            let by_input = change.inputs[input];
            change.design.iter().zip(self.first).map(|(x, rate)| -(x + by_input * rate) / push).collect()
        });
        Ok(rows.collect())
    }

    /// Whether `curved`, the value of `w^T g'' v v` at a limit point, is negligible compared with its values a small
    /// motion along `v` away. If so, another limit point may coincide with this one within the accuracy of its
    /// location.
    fn flat(&self, curved: f64) -> bool {
        /// A point where a slope vanishes is known to half the digits only; as a fraction of a small motion.
        const UNCERTAIN: f64 = 1e-5;
        let CriticalState { v, w, .. } = self.critical;
        let along = self.direction(v.clone(), 0.0, None);
        let aside = [-SMALL_MOTION, SMALL_MOTION].map(|motion| {
            let q = add_scaled(&self.critical.equilibrium.coordinates, motion / largest(v), v);
            dot(&self.bend_at(&q, w, &along).coordinates, v).abs()
        });
        curved.abs() <= UNCERTAIN * aside[0].max(aside[1])
    }

    /// The rows of the second derivatives at a pitchfork.
    fn pitchfork(&self) -> Result<Vec<Vector>, Error> {
        let CriticalState { v, .. } = self.critical;
        let forces = self.forces();
        let crossed = Crossed::new(self.mechanism, self.critical, &forces.of_input)?;
        let [by_v, by_along] = &crossed.second;
        let [[_, mixed], [_, straight]] = crossed.hessian;
        // The components along `v` that stay on the branch: the residual vanishes to second order.
        let along = -straight / (2.0 * mixed);
        let mut directions = Vec::with_capacity(self.first.len() + 1);
        for k in 0..self.first.len() {
            let force = forces.of_design(k).map(|value| -value);
            let (shift, _) = crossed.factors.solve(&force, [0.0]);
            let direction = self.direction(shift, 0.0, Some(k));
            let part = -(product(by_along, &direction) + along * product(by_v, &direction)) / mixed;
            directions.push(moved(direction, part, v));
        }
        let input = self.direction(crossed.along.clone(), 1.0, None);
        let input = moved(input, along, v);
        let slope = product(by_v, &input);
        let (z, _) = crossed.factors.solve_transposed(&by_v.coordinates, [0.0]);
        let change = |direction: &Direction| self.stiffness_change(&crossed.factors, &z, direction);
        let by_input = change(&input);
        let curved = product(&by_input, &input);
        let mixed: Vector = directions.iter().map(|direction| product(&by_input, direction)).collect();
        let rates = self.first;
        let rows = directions.iter().enumerate().map(|(k, direction)| {
            let by_design = change(direction);
            let rate = product(&by_design, &input) + curved * rates[k];
            directions
                .iter()
                .enumerate()
                .map(|(j, other)| -(product(&by_design, other) + mixed[j] * rates[k] + rate * rates[j]) / slope)
                .collect()
        });
        Ok(rows.collect())
    }

    /// Derivative along a direction of the total gradient of `w^T Khat v`; `z` is `Khat^-T` times its derivative with
    /// respect to the coordinates.
    fn stiffness_change(&self, factors: &Bordered, z: &[f64], along: &Direction) -> Gradient {
        let CriticalState { equilibrium: at, v, w, .. } = self.critical;
        let (q, u, b) = (&at.coordinates, &at.inputs, &at.design);
        let stiffness = along.linear(self.mechanism, at).stiffness;
        let (dv, _) = factors.solve(&times(&stiffness, v).map(|value| -value), [0.0]);
        let left = times(&stiffness.transpose(), w).map(|value| -value);
        let (dw, _) = factors.solve_transposed(&left, [0.0]);
        let zero = Vector::zeros(q.len());
        let vectors: [&[f64]; 4] = [w, &zero, &zero, v];
        let changes: [&[f64]; 4] = [&dw, &zero, &zero, &dv];
        let mut change = self.mechanism.pencil_gradient_along(q, u, b, vectors, along.parts(), changes);
        subtract(&mut change, &self.bend(z, along));
        change
    }

    /// The direction with `dq`, `du_c` and a unit change of design variable `design`.
    fn direction(&self, coordinates: Vector, rate: f64, design: Option<usize>) -> Direction {
        let at = &self.critical.equilibrium;
        let input = self.critical.input.index();
        let only = |size: usize, index: Option<usize>, value: f64| {
            Vector::from_fn(size, |i| if Some(i) == index { value } else { 0.0 })
        };
        Direction {
            coordinates,
            inputs: only(at.inputs.len(), Some(input), rate),
            design: only(at.design.len(), design, 1.0),
        }
    }

    /// `w^T g''(direction, .)`.
    fn bend(&self, w: &[f64], direction: &Direction) -> Gradient {
        self.bend_at(&self.critical.equilibrium.coordinates, w, direction)
    }

    /// `w^T g''(direction, .)` at coordinates other than those of the critical state.
    fn bend_at(&self, q: &[f64], w: &[f64], direction: &Direction) -> Gradient {
        let at = &self.critical.equilibrium;
        let (u, b) = (&at.inputs, &at.design);
        let [dq, du, db] = direction.parts();
        let direction = [dq, du, db, &Vector::zeros(q.len())];
        let kernels: &dyn DirectionalKernels = self.mechanism;
        kernels.residual_gradient_along(q, u, b, w, direction)
    }

    /// `w^T g'`.
    fn residual_gradient(&self, w: &[f64]) -> Gradient {
        let at = &self.critical.equilibrium;
        let kernels: &dyn Kernels = self.mechanism;
        kernels.residual_gradient(&at.coordinates, &at.inputs, &at.design, w)
    }

    fn forces(&self) -> Forces {
        let at = &self.critical.equilibrium;
        let kernels: &dyn Kernels = self.mechanism;
        let (by_input, by_design) = kernels.residual_partials(&at.coordinates, &at.inputs, &at.design);
        Forces { of_input: by_input.column(self.critical.input.index()), by_design }
    }
}

/// Partial derivatives of the residual with respect to the input and the design.
struct Forces {
    of_input: Vector,
    by_design: Matrix,
}

impl Forces {
    fn of_design(&self, k: usize) -> Vector {
        self.by_design.column(k)
    }
}

/// The direction plus a component along `v`.
fn moved(mut direction: Direction, part: f64, v: &[f64]) -> Direction {
    add_to(&mut direction.coordinates, part, v);
    direction
}

fn product(gradient: &Gradient, direction: &Direction) -> f64 {
    dot(&gradient.coordinates, &direction.coordinates)
        + dot(&gradient.inputs, &direction.inputs)
        + dot(&gradient.design, &direction.design)
}
