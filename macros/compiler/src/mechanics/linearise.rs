//! Linearisation, partial derivatives and adjoint gradients: every kernel by differentiating the residual.

use crate::algebra::{
    Array, Direction, Function, Graph, Parameter, derivatives_along, gradient, substitute,
};
use crate::base::ids::{ExprId, SymbolId};

use super::derive::Equations;
use super::functions::{Damping, Limits, Properties};
use super::properties::by_symbol;
use super::symbols::{SymbolList, Symbols};

/// Derivatives of `roots` by each symbol of a list: `columns[j][i]`.
pub(super) fn columns(g: &mut Graph, roots: &[ExprId], by: &SymbolList) -> Vec<Vec<ExprId>> {
    by.ids
        .iter()
        .map(|&symbol| by_symbol(g, roots, symbol))
        .collect()
}

/// `Mhat = dg/dqddot` (eq. 15), by columns. It holds at any velocity, so it is taken at none.
pub(super) fn mass_columns(g: &mut Graph, s: &Symbols, e: &Equations) -> Vec<Vec<ExprId>> {
    columns(g, &e.without_velocity, &s.acceleration)
}

/// `Chat = dg/dqdot` at rest (eq. 16, of the complete residual), by columns.
pub(super) fn damping_columns(g: &mut Graph, s: &Symbols, e: &Equations) -> Vec<Vec<ExprId>> {
    let moving = columns(g, &e.motion, &s.velocity);
    moving
        .into_iter()
        .map(|column| at_rest(g, s, &column))
        .collect()
}

/// `roots` with velocities and accelerations set to zero.
fn at_rest(g: &mut Graph, s: &Symbols, roots: &[ExprId]) -> Vec<ExprId> {
    let zeros = vec![g.zero(); s.q.ids.len()];
    let still: Vec<_> = s
        .velocity
        .with(&zeros)
        .chain(s.acceleration.with(&zeros))
        .collect();
    substitute(g, roots, &still)
}

/// The three linearised matrices, row by row.
struct Linear {
    mass: Vec<ExprId>,
    damping: Vec<ExprId>,
    stiffness: Vec<ExprId>,
}

impl Linear {
    fn new(g: &mut Graph, s: &Symbols, e: &Equations, properties: Properties) -> Self {
        let n = e.rest.len();
        let mass = mass_columns(g, s, e);
        let stiffness = columns(g, &e.rest, &s.q);
        let damping = damping_columns(g, s, e);
        let zero = g.zero();
        let square = |entry: &mut dyn FnMut(usize, usize) -> ExprId| -> Vec<ExprId> {
            (0..n * n).map(|k| entry(k / n, k % n)).collect()
        };
        // Of two equal entries, the one that differentiates by the coordinate nearer to the leaves is cheaper: less
        // of the mechanism moves with it.
        let upper = |i: usize, j: usize| (i.max(j), i.min(j));
        let mass = square(&mut |i, j| {
            let (column, row) = upper(i, j);
            mass[column][row]
        });
        let stiffness = square(&mut |i, j| {
            let (column, row) = if properties.symmetric_stiffness {
                upper(i, j)
            } else {
                (j, i)
            };
            stiffness[column][row]
        });
        let damping = match properties.damping {
            Damping::Zero => vec![zero; n * n],
            Damping::General => square(&mut |i, j| damping[j][i]),
            Damping::Gyroscopic => square(&mut |i, j| {
                let (column, row) = upper(i, j);
                match i.cmp(&j) {
                    std::cmp::Ordering::Equal => zero,
                    std::cmp::Ordering::Less => damping[column][row],
                    std::cmp::Ordering::Greater => g.neg(damping[column][row]),
                }
            }),
        };
        Self {
            mass,
            damping,
            stiffness,
        }
    }

    fn roots(&self) -> Vec<ExprId> {
        [&self.mass[..], &self.damping, &self.stiffness].concat()
    }

    fn arrays(&self, n: usize) -> Vec<Array> {
        linear_arrays(&self.roots(), n)
    }

    /// Derivatives of the three by each symbol of a list.
    fn partials(&self, g: &mut Graph, n: usize, by: &SymbolList) -> Vec<Array> {
        let each = columns(g, &self.roots(), by);
        let count = by.ids.len();
        let mut arrays = Vec::new();
        for (k, name) in LINEAR.into_iter().enumerate() {
            let values = each
                .iter()
                .flat_map(|roots| &roots[k * n * n..(k + 1) * n * n])
                .copied()
                .collect();
            arrays.push(Array {
                name,
                shape: vec![count, n, n],
                values,
            });
        }
        arrays
    }
}

const LINEAR: [&str; 3] = ["mass", "damping", "stiffness"];

fn linear_arrays(roots: &[ExprId], n: usize) -> Vec<Array> {
    LINEAR
        .into_iter()
        .enumerate()
        .map(|(k, name)| Array {
            name,
            shape: vec![n, n],
            values: roots[k * n * n..(k + 1) * n * n].to_vec(),
        })
        .collect()
}

/// All kernels, in the order of the runtime's contract.
pub(super) fn kernels(
    g: &mut Graph,
    s: &Symbols,
    e: &Equations,
    properties: Properties,
    limits: Limits,
) -> Vec<Function> {
    let n = e.rest.len();
    let vector = |name, values: &[ExprId]| Array {
        name,
        shape: vec![values.len()],
        values: values.to_vec(),
    };
    let state = [
        parameter("q", &s.q),
        parameter("u", &s.u),
        parameter("b", &s.b),
    ];
    let function = |name, before: Vec<Parameter>, after: Vec<Parameter>, results| Function {
        name,
        parameters: before
            .into_iter()
            .chain(state.clone())
            .chain(after)
            .collect(),
        results,
    };

    let linear = Linear::new(g, s, e, properties);
    name_entries(g, &linear, n);
    let zeros = vec![g.zero(); n];
    let still: Vec<_> = s.acceleration.with(&zeros).collect();
    let bias = substitute(g, &e.motion, &still);
    let force: Vec<ExprId> = bias.iter().map(|&h| g.neg(h)).collect();

    let by_input = columns(g, &e.rest, &s.u);
    let by_design = columns(g, &e.rest, &s.b);
    let arguments = [&s.q, &s.u, &s.b];
    let entries = 3 * n * n * arguments.iter().map(|list| list.ids.len()).sum::<usize>();
    let partials: Option<Vec<Array>> = (entries <= limits.explicit_partials).then(|| {
        arguments
            .iter()
            .flat_map(|list| linear.partials(g, n, list))
            .collect()
    });
    let along = direction("_along", [(&s.q, &s.dq), (&s.u, &s.du), (&s.b, &s.db)]);
    let linear_along = derivatives_along(g, &linear.roots(), &along);

    let mode_functional = mode_functional(g, s, e);
    let mode_gradient = state_gradient(g, s, mode_functional);
    let mode_along = direction(
        "_along",
        [
            (&s.q, &s.dq),
            (&s.u, &s.du),
            (&s.b, &s.db),
            (&s.phi, &s.dphi),
            (&s.lambda, &s.dlambda),
        ],
    );
    let mode_gradient_along = gradient_along(g, &mode_gradient, &mode_along);

    let weighted = weighted_sum(g, &s.w.values, &e.rest);
    let residual_gradient = state_gradient(g, s, weighted);
    let residual_along = direction(
        "_along",
        [(&s.q, &s.dq), (&s.u, &s.du), (&s.b, &s.db), (&s.w, &s.dw)],
    );
    let residual_gradient_along = gradient_along(g, &residual_gradient, &residual_along);

    let outputs_by: Vec<Vec<Vec<ExprId>>> = [&s.q, &s.u, &s.b]
        .map(|list| columns(g, &e.outputs, list))
        .into();
    let directions = || {
        vec![
            parameter("dq", &s.dq),
            parameter("du", &s.du),
            parameter("db", &s.db),
        ]
    };
    let mode = || vec![parameter("phi", &s.phi), scalar("lambda", &s.lambda)];

    let mut functions = vec![
        function(
            "residual",
            vec![],
            vec![],
            vec![vector("residual", &e.rest)],
        ),
        function(
            "residual_parts",
            vec![],
            vec![],
            vec![
                vector("inertia", &e.rest_inertia),
                vector("applied", &e.rest_applied),
            ],
        ),
        function(
            "motion_residual",
            vec![
                parameter("acceleration", &s.acceleration),
                parameter("velocity", &s.velocity),
            ],
            vec![],
            vec![vector("residual", &e.motion)],
        ),
        function(
            "motion",
            vec![parameter("velocity", &s.velocity)],
            vec![],
            vec![linear.arrays(n).swap_remove(0), vector("force", &force)],
        ),
        function(
            "residual_and_stiffness",
            vec![],
            vec![],
            vec![vector("residual", &e.rest), linear.arrays(n).swap_remove(2)],
        ),
        function("linear", vec![], vec![], linear.arrays(n)),
        function(
            "residual_partials",
            vec![],
            vec![],
            vec![
                rows("by_input", n, &by_input),
                rows("by_design", n, &by_design),
            ],
        ),
        function(
            "linear_along",
            vec![],
            directions(),
            linear_arrays(&linear_along, n),
        ),
        function("mode_gradient", vec![], mode(), mode_gradient.clone()),
        function(
            "residual_gradient",
            vec![],
            vec![parameter("w", &s.w)],
            residual_gradient,
        ),
        function(
            "mode_gradient_along",
            vec![],
            [
                mode(),
                directions(),
                vec![parameter("dphi", &s.dphi), scalar("dlambda", &s.dlambda)],
            ]
            .concat(),
            mode_gradient_along,
        ),
        function(
            "residual_gradient_along",
            vec![],
            [
                vec![parameter("w", &s.w)],
                directions(),
                vec![parameter("dw", &s.dw)],
            ]
            .concat(),
            residual_gradient_along,
        ),
        function(
            "outputs",
            vec![],
            vec![],
            vec![vector("outputs", &e.outputs)],
        ),
        function(
            "output_partials",
            vec![],
            vec![],
            ["by_coordinate", "by_input", "by_design"]
                .into_iter()
                .zip(&outputs_by)
                .map(|(name, columns)| rows(name, e.outputs.len(), columns))
                .collect(),
        ),
    ];
    functions.extend(partials.map(|arrays| function("linear_partials", vec![], vec![], arrays)));
    functions
}

/// `phi^T (Khat - lambda Mhat) phi` without either matrix: the derivative of `phi^T g` along
/// (`qddot`, `q`) = (`-lambda phi`, `phi`), with the `phi` in front held fixed (THEORY section 5).
fn mode_functional(g: &mut Graph, s: &Symbols, e: &Equations) -> ExprId {
    let power = weighted_sum(g, &s.phi.values, &e.without_velocity);
    let minus_lambda = g.neg(s.lambda.values[0]);
    let acceleration: Vec<ExprId> = s
        .phi
        .values
        .iter()
        .map(|&phi| g.mul(minus_lambda, phi))
        .collect();
    let rates = s
        .acceleration
        .with(&acceleration)
        .chain(s.q.with(&s.phi.values))
        .collect();
    let functional = derivatives_along(g, &[power], &Direction::new("_mode", rates));
    at_rest(g, s, &functional)[0]
}

fn weighted_sum(g: &mut Graph, weights: &[ExprId], values: &[ExprId]) -> ExprId {
    let terms: Vec<ExprId> = weights
        .iter()
        .zip(values)
        .map(|(&weight, &value)| g.mul(weight, value))
        .collect();
    g.sum(terms)
}

/// Gradient of a scalar by coordinates, inputs and design variables.
fn state_gradient(g: &mut Graph, s: &Symbols, root: ExprId) -> Vec<Array> {
    let symbols: Vec<SymbolId> = [&s.q, &s.u, &s.b]
        .iter()
        .flat_map(|list| list.ids.clone())
        .collect();
    let mut all = gradient(g, root, &symbols).into_iter();
    [("coordinates", &s.q), ("inputs", &s.u), ("design", &s.b)]
        .into_iter()
        .map(|(name, list)| Array {
            name,
            shape: vec![list.ids.len()],
            values: all.by_ref().take(list.ids.len()).collect(),
        })
        .collect()
}

fn gradient_along(g: &mut Graph, gradient: &[Array], along: &Direction) -> Vec<Array> {
    gradient
        .iter()
        .map(|array| Array {
            values: derivatives_along(g, &array.values, along),
            ..array.clone()
        })
        .collect()
}

fn direction<const K: usize>(suffix: &str, moves: [(&SymbolList, &SymbolList); K]) -> Direction {
    let rates = moves
        .iter()
        .flat_map(|(list, rates)| list.with(&rates.values))
        .collect();
    Direction::new(suffix, rates)
}

pub(super) fn parameter(name: &'static str, list: &SymbolList) -> Parameter {
    Parameter {
        name,
        symbols: list.ids.clone(),
        scalar: false,
    }
}

fn scalar(name: &'static str, list: &SymbolList) -> Parameter {
    Parameter {
        name,
        symbols: list.ids.clone(),
        scalar: true,
    }
}

/// Columns as an array with one row per function.
fn rows(name: &'static str, count: usize, columns: &[Vec<ExprId>]) -> Array {
    let values = (0..count)
        .flat_map(|i| columns.iter().map(move |column| column[i]))
        .collect();
    Array {
        name,
        shape: vec![count, columns.len()],
        values,
    }
}

/// Names the matrix entries for readers.
fn name_entries(g: &mut Graph, linear: &Linear, n: usize) {
    for (name, values) in LINEAR
        .into_iter()
        .zip([&linear.mass, &linear.damping, &linear.stiffness])
    {
        for (k, &entry) in values.iter().enumerate() {
            g.set_name(entry, || format!("{name}_{}_{}", k / n, k % n));
        }
    }
}
