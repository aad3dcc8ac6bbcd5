//! The equations, linearised at states where the constraints hold.

use std::ops::Range;

use crate::algebra::{Disturbed, Evaluator, ExprId, Graph, SymbolId, evaluate};
use crate::mechanics::equations::Equations;
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::{Context, RandomState};

use super::fields::{Field, Fields};

/// The equations and what their linearisation takes.
pub(super) struct System<'a> {
    pub(super) g: &'a Graph,
    pub(super) context: &'a Context<'a>,
    pub(super) fields: &'a Fields,
    rest: &'a [ExprId],
    /// By column.
    stiffness: &'a [Vec<ExprId>],
    roots: Vec<ExprId>,
}

/// The equations linearised at one state, in the machine's own units.
pub(super) struct Linearised {
    /// `stiffness[j][i]`: derivative of equation `i` by unknown `j`.
    pub(super) stiffness: Vec<Vec<Disturbed>>,
    pub(super) residual: Vec<Disturbed>,
    pub(super) fields: Vec<Field>,
    /// Number of operations behind the values.
    pub(super) operations: usize,
}

/// Values of the first unknowns, found by iteration, and what that leaves uncertain.
#[derive(Default)]
struct IteratedValues {
    values: Vec<f64>,
    rounding: Vec<f64>,
}

/// The reactions of constraints on velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Friction {
    None,
    Any,
}

impl<'a> System<'a> {
    pub(super) fn new(
        g: &'a Graph,
        context: &'a Context,
        equations: &'a Equations,
        jacobians: &'a Jacobians,
        fields: &'a Fields,
    ) -> Self {
        let mut roots = jacobians.stiffness.concat();
        roots.extend(&equations.rest);
        roots.extend(fields.roots());
        Self { g, context, fields, rest: &equations.rest, stiffness: &jacobians.stiffness, roots }
    }

    /// Number of unknowns.
    pub(super) fn size(&self) -> usize {
        self.rest.len()
    }

    /// The first constraint on velocities among the unknowns; they come last.
    pub(super) fn first_of_velocities(&self) -> usize {
        self.context.moving().1 + self.context.rows.iter().filter(|row| !row.of_velocities).count()
    }

    /// Linearises at a random state; `None` if the equations are not finite there.
    pub(super) fn at(&self, state: RandomState, friction: Friction) -> Option<Linearised> {
        let evaluator = Evaluator::new(self.g, &self.roots);
        let consistent = self.place(state);
        let unknowns = &self.context.symbols.q.ids[self.first_of_velocities()..];
        let values = evaluator.at(state.motion, |symbol| {
            if friction == Friction::None && unknowns.contains(&symbol) {
                Disturbed::exact(0.0)
            } else {
                self.found(&consistent, state, symbol)
            }
        });
        self.linearised(&values, evaluator.operations())
    }

    /// Values of parts of the equations at a random state, and the number of operations behind them.
    pub(super) fn values(&self, roots: &[ExprId], state: RandomState) -> (Vec<Disturbed>, usize) {
        let consistent = self.place(state);
        let evaluator = Evaluator::new(self.g, roots);
        let values = evaluator.at(state.motion, |symbol| self.found(&consistent, state, symbol));
        (self.in_units(&values), evaluator.operations())
    }

    /// What the equations do over the units of their unknowns, relative to the unit of energy.
    fn in_units(&self, equations: &[Disturbed]) -> Vec<Disturbed> {
        let units = &self.fields.units;
        equations.iter().zip(&units.unknowns).map(|(x, unit)| x.scaled(unit / units.energy)).collect()
    }

    /// Linearises where all coordinates are zero; `None` unless this is an equilibrium with some speeds and reactions.
    pub(super) fn at_zero(&self, design: u64) -> Option<Linearised> {
        let state = RandomState { design, motion: 1 };
        let free = self.fields.free;
        if self.size() == free {
            let iterated_values = IteratedValues { values: vec![0.0; free], rounding: vec![0.0; free] };
            return self.at_place(&iterated_values, state);
        }
        let columns = self.stiffness[free..].iter().flatten();
        let roots: Vec<ExprId> = self.rest.iter().chain(columns).copied().collect();
        let mut starts = vec![self.start(state, free..self.context.moving().1)];
        if starts[0].iter().any(|value| *value != 0.0) {
            starts.push(vec![0.0; self.size()]);
        }
        let linearised = |start| self.at_place(&self.minimum_norm_newton(state, &roots, start, free)?, state);
        starts.into_iter().find_map(linearised)
    }

    /// Zero except for some coordinates and speeds. Speeds of a family of steady motions are not zero then: at rest,
    /// more may be free than in motion.
    fn start(&self, state: RandomState, moving: Range<usize>) -> Vec<f64> {
        let mut start = vec![0.0; self.size()];
        for k in moving {
            let unknown = self.context.symbols.q.ids[k];
            start[k] = SPREAD * state.value(self.context, unknown);
        }
        start
    }

    /// Linearises at equilibria: near all coordinates zero, then near random places, at last near rest at zero.
    pub(super) fn equilibria(&self, design: u64) -> impl Iterator<Item = Linearised> {
        let columns = self.stiffness.iter().flatten();
        let roots: Vec<ExprId> = self.rest.iter().chain(columns).copied().collect();
        (0..=LAST).filter_map(move |motion| {
            let state = RandomState { design, motion };
            let (free, moving) = (self.fields.free, self.context.moving().1);
            let start = match motion {
                0 => self.start(state, free..moving),
                LAST => vec![0.0; self.size()],
                _ => self.start(state, 0..moving),
            };
            let iterated_values = self.minimum_norm_newton(state, &roots, start, 0)?;
            self.at_place(&iterated_values, state)
        })
    }

    /// Linearises where all equations hold.
    fn at_place(&self, iterated_values: &IteratedValues, state: RandomState) -> Option<Linearised> {
        let residual = Evaluator::new(self.g, self.rest);
        let gaps = residual.at(state.motion, |symbol| self.found(iterated_values, state, symbol));
        let holds = |gap: &Disturbed| gap.is_finite() && gap.is_rounding(residual.operations());
        if !gaps.iter().all(holds) {
            return None;
        }
        let evaluator = Evaluator::new(self.g, &self.roots);
        let values = evaluator.at(state.motion, |symbol| self.found(iterated_values, state, symbol));
        self.linearised(&values, evaluator.operations())
    }

    /// The value of a symbol where unknowns have been found by iteration.
    fn found(&self, iterated_values: &IteratedValues, state: RandomState, symbol: SymbolId) -> Disturbed {
        let unknowns = &self.context.symbols.q.ids;
        match unknowns.iter().position(|unknown| *unknown == symbol) {
            Some(k) if k < iterated_values.values.len() => {
                Disturbed::rounded(iterated_values.values[k], iterated_values.rounding[k], u64::from(symbol.0))
            }
            _ => Disturbed::exact(self.value(state, symbol)),
        }
    }

    /// The random value of a symbol, that of an unknown in its unit.
    fn value(&self, state: RandomState, symbol: SymbolId) -> f64 {
        let unknowns = &self.context.symbols.q.ids;
        let place = unknowns.iter().position(|unknown| *unknown == symbol);
        let unit = place.map_or(1.0, |k| self.fields.units.unknowns[k]);
        unit * state.value(self.context, symbol)
    }

    fn linearised(&self, values: &[Disturbed], operations: usize) -> Option<Linearised> {
        if !values.iter().all(Disturbed::is_finite) {
            return None;
        }
        let n = self.size();
        let (stiffness, values) = values.split_at(n * n);
        let (residual, values) = values.split_at(n);
        let units = &self.fields.units;
        let column = |(j, column): (usize, &[Disturbed])| {
            self.in_units(column).into_iter().map(|x| x.scaled(units.unknowns[j])).collect()
        };
        Some(Linearised {
            stiffness: stiffness.chunks(n.max(1)).enumerate().map(column).collect(),
            residual: self.in_units(residual),
            fields: self.fields.at(values, operations),
            operations,
        })
    }

    /// Coordinates and speeds near a random state that satisfy the constraints; nothing without constraints, or if none
    /// are found.
    fn place(&self, state: RandomState) -> IteratedValues {
        let moving = self.context.moving().1;
        let rows = moving..self.size();
        if rows.is_empty() {
            return IteratedValues::default();
        }
        let mut roots: Vec<ExprId> = self.rest[rows.clone()].to_vec();
        roots.extend(self.stiffness[..moving].iter().flat_map(|column| &column[rows.clone()]));
        let unknowns = &self.context.symbols.q.ids[..moving];
        let start = unknowns.iter().map(|symbol| state.value(self.context, *symbol)).collect();
        self.minimum_norm_newton(state, &roots, start, 0).unwrap_or_default()
    }

    /// Solves equations for some unknowns, `values[first..]`, by Newton's method with the shortest steps. `roots` holds
    /// the equations, then their derivatives by one of these unknowns after the other. Starts and steps are in the
    /// machine's own units.
    fn minimum_norm_newton(
        &self,
        state: RandomState,
        roots: &[ExprId],
        mut values: Vec<f64>,
        first: usize,
    ) -> Option<IteratedValues> {
        let unknowns = &self.context.symbols.q.ids[..values.len()];
        let units = &self.fields.units.unknowns;
        let count = roots.len() / (1 + values.len() - first);
        let size = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let (mut least, mut stalled, mut arrived) = (f64::INFINITY, 0, false);
        let mut largest = LARGEST_STEP;
        while stalled < PATIENCE {
            let entries =
                evaluate(self.g, roots, |symbol| match unknowns.iter().position(|unknown| *unknown == symbol) {
                    Some(k) => values[k] * units[k],
                    None => self.value(state, symbol),
                });
            let (gaps, slopes) = entries.split_at(count);
            let slopes = slopes.iter().enumerate();
            let slopes = slopes.map(|(k, slope)| slope * units[first + k / count]);
            let (step, gap) = shortest_step(gaps, &slopes.collect::<Vec<_>>())?;
            if arrived {
                // The step from a solution is what rounding makes of it.
                let largest = size(&values);
                let rounding = |k: usize| {
                    let step = if k < first { 0.0 } else { size(&step) };
                    let value = if values[k] == 0.0 { 0.0 } else { largest };
                    4.0 * units[k] * step.max(f64::EPSILON * value)
                };
                let rounding = (0..values.len()).map(rounding).collect();
                let values = values.iter().zip(units).map(|(value, unit)| value * unit);
                return Some(IteratedValues { values: values.collect(), rounding });
            }
            let coordinates = self.fields.free.saturating_sub(first).min(step.len());
            let share = (largest / size(&step[..coordinates])).min(1.0);
            for (value, step) in values[first..].iter_mut().zip(&step) {
                *value += share * step;
            }
            arrived = size(&step) <= 1e-12 * size(&values);
            if arrived && gap > 1e-9 * size(&values) {
                return None;
            }
            largest = if gap < least { 2.0 * largest } else { LARGEST_STEP };
            stalled = if gap < 0.9 * least { 0 } else { stalled + 1 };
            least = least.min(gap);
        }
        None
    }
}

/// The last place from which equilibria are sought.
const LAST: u64 = 6;
/// How far from zero they are, in units of the coordinates.
const SPREAD: f64 = 0.5;
/// Steps that may pass without progress.
const PATIENCE: usize = 8;
/// Largest step of a coordinate, in its unit, at first and after a step that did not help; it doubles with others.
const LARGEST_STEP: f64 = 0.5;

/// The `x` with `slopes^T x = -gaps`, where `slopes` holds the derivatives of all gaps by one unknown after the other:
/// the shortest, or that with the least rest. Also the largest gap, by the steps that would close it alone.
fn shortest_step(gaps: &[f64], slopes: &[f64]) -> Option<(Vec<f64>, f64)> {
    let (m, n) = (gaps.len(), slopes.len() / gaps.len().max(1));
    let sizes: Vec<f64> =
        (0..m).map(|i| (0..n).map(|k| slopes[k * m + i] * slopes[k * m + i]).sum::<f64>().sqrt()).collect();
    let scaled = |i: usize, value: f64| {
        if sizes[i] > 0.0 { value / sizes[i] } else { 0.0 }
    };
    let entry = |i: usize, k: usize| scaled(i, slopes[k * m + i]);
    let gaps: Vec<f64> = (0..m).map(|i| scaled(i, gaps[i])).collect();
    let step = if m <= n {
        let y = damped_solution(m, n, entry, &gaps)?;
        (0..n).map(|k| -(0..m).map(|i| entry(i, k) * y[i]).sum::<f64>()).collect()
    } else {
        let right: Vec<f64> = (0..n).map(|k| -(0..m).map(|i| entry(i, k) * gaps[i]).sum::<f64>()).collect();
        damped_solution(n, m, |k, i| entry(i, k), &right)?
    };
    let gap = gaps.iter().fold(0.0_f64, |most, gap| most.max(gap.abs()));
    Some((step, gap))
}

/// `(A A^T + epsilon)^-1 right` for a matrix of `m` rows and `n` columns, by Cholesky factors. The small number lets
/// dependent rows share.
fn damped_solution(m: usize, n: usize, entry: impl Fn(usize, usize) -> f64, right: &[f64]) -> Option<Vec<f64>> {
    let rows: Vec<f64> = (0..m * n).map(|k| entry(k / n, k % n)).collect();
    let row = |i: usize| &rows[i * n..(i + 1) * n];
    let mut factors = vec![0.0; m * m];
    for i in 0..m {
        for j in 0..=i {
            factors[i * m + j] = row(i).iter().zip(row(j)).map(|(a, b)| a * b).sum();
        }
        factors[i * m + i] += DAMPING;
    }
    for k in 0..m {
        let pivot = factors[k * m + k].sqrt();
        if !pivot.is_normal() {
            return None;
        }
        for i in k..m {
            factors[i * m + k] /= pivot;
        }
        for i in k + 1..m {
            for j in k + 1..=i {
                factors[i * m + j] -= factors[i * m + k] * factors[j * m + k];
            }
        }
    }
    let mut x = right.to_vec();
    for i in 0..m {
        for k in 0..i {
            x[i] -= factors[i * m + k] * x[k];
        }
        x[i] /= factors[i * m + i];
    }
    for i in (0..m).rev() {
        for k in i + 1..m {
            x[i] -= factors[k * m + i] * x[k];
        }
        x[i] /= factors[i * m + i];
    }
    Some(x)
}

/// Relative to squares of entries of order one.
const DAMPING: f64 = 1e-12;
