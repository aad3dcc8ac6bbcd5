//! Linearisation by differentiating the residual (eqs. 13-17).

use crate::algebra::{Array, Direction, Graph, cost, derivatives_along, substitute};
use crate::base::census::taken;
use crate::base::ids::{ExprId, SymbolId};

use super::composite::mass_matrix;
use super::derive::Equations;
use super::functions::{Damping, Properties};
use super::problem::Problem;
use super::properties::vanish;
use super::sources::Sources;
use super::symbols::{SymbolList, Symbols};
use super::variation::Variation;

/// Derivative of `roots` by one symbol.
pub(super) fn by_symbol(g: &mut Graph, roots: &[ExprId], symbol: SymbolId) -> Vec<ExprId> {
    let direction = Direction::unit(g, symbol);
    derivatives_along(g, roots, &direction)
}

/// Derivatives of `roots` by each symbol of a list: `columns[j][i]`.
pub(super) fn columns(g: &mut Graph, roots: &[ExprId], by: &SymbolList) -> Vec<Vec<ExprId>> {
    by.ids
        .iter()
        .map(|&symbol| by_symbol(g, roots, symbol))
        .collect()
}

/// `roots` with velocities and accelerations set to zero.
pub(super) fn at_rest(g: &mut Graph, s: &Symbols, roots: &[ExprId]) -> Vec<ExprId> {
    let zeros = vec![g.zero(); s.q.ids.len()];
    let still: Vec<_> = s
        .velocity
        .with(&zeros)
        .chain(s.acceleration.with(&zeros))
        .collect();
    substitute(g, roots, &still)
}

/// All first derivatives of the residual at rest: `matrix[j][i]` is the derivative of residual `i` by coordinate `j`.
pub(super) struct Jacobians {
    /// `Mhat = dg/dqddot` (eq. 15). It holds at any velocity.
    pub(super) mass: Vec<Vec<ExprId>>,
    /// `Chat = dg/dqdot` (eq. 16, of the complete residual).
    pub(super) damping: Vec<Vec<ExprId>>,
    /// `Khat = dg/dq` (eq. 17).
    pub(super) stiffness: Vec<Vec<ExprId>>,
}

impl Jacobians {
    /// Inertia and weight are differentiated by the angles in all, forces and constraints by the unknowns.
    pub(super) fn new(g: &mut Graph, problem: &Problem, e: &Equations) -> Self {
        let (s, runs) = (problem.symbols, problem.runs);
        let outward = problem.outward_order();
        let running = vec![g.zero(); s.running.ids.len()];
        let kinematics = problem.inertial_kinematics(g, &running, Sources::INERTIA);
        let mass = mass_matrix(g, problem, &kinematics);
        // the acceleration of a coasting coordinate is the rate of an unknown
        let symmetric = problem.topology.coasting.is_empty();
        let mass = runs.matrix(g, &mass, symmetric, &outward);

        let [stiffness, damping] = of_inertia(g, problem, e, &mass);

        let applied = &e.parts.applied;
        let applied_at_rest = at_rest(g, s, applied);
        let by_position = columns(g, &applied_at_rest, &s.q);
        let moving = columns(g, applied, &s.velocity);
        let by_velocity: Vec<_> = moving.iter().map(|column| at_rest(g, s, column)).collect();
        let mut in_unknowns = |columns: Vec<Vec<ExprId>>| -> Vec<Vec<ExprId>> {
            let n = columns.len();
            let flat = problem.in_unknowns(g, &columns.concat());
            flat.chunks(n.max(1)).map(<[_]>::to_vec).collect()
        };
        let [mass, damping, stiffness] = [mass, damping, stiffness].map(&mut in_unknowns);
        Self {
            mass,
            damping: added(g, &damping, &by_velocity),
            stiffness: added(g, &stiffness, &by_position),
        }
    }
}

/// Stiffness and damping of inertia and weight, over the unknowns in place of the angles in all: differentiated, or as
/// [`Variation`] has them where these, with the residual and with the mass matrix, are fewer operations.
fn of_inertia(
    g: &mut Graph,
    problem: &Problem,
    e: &Equations,
    mass: &[Vec<ExprId>],
) -> [Vec<Vec<ExprId>>; 2] {
    let (s, runs, inertial) = (problem.symbols, problem.runs, &e.parts.inertial);
    let outward = problem.outward_order();
    let still = |g: &mut Graph, roots: &[ExprId]| {
        let zeros = vec![g.zero(); s.q.ids.len()];
        let rates = runs.velocity.with(&zeros);
        let all: Vec<_> = rates.chain(runs.acceleration.with(&zeros)).collect();
        let roots = substitute(g, roots, &all);
        at_rest(g, s, &roots)
    };
    let all_still = |g: &mut Graph, columns: &[Vec<ExprId>]| -> Vec<Vec<ExprId>> {
        columns.iter().map(|column| still(g, column)).collect()
    };
    let rest = still(g, inertial);
    let stiffness = columns(g, &rest, &runs.position);
    let damping = columns(g, inertial, &runs.velocity);
    let damping = all_still(g, &damping);
    let differentiated = [stiffness, damping].map(|matrix| summed(g, problem, &matrix, &outward));
    let Some(known) = &e.variation else {
        return differentiated;
    };
    let [stiffness, damping] =
        [&known.by_position, &known.by_velocity].map(|matrix| all_still(g, matrix));
    // what a coordinate asks of those before it is the shorter half
    let stiffness = match is_symmetric(g, problem, &stiffness) {
        true => {
            taken(|| "linearise: symmetric stiffness, transposed".into());
            transposed(&stiffness)
        }
        false => stiffness,
    };
    let composed = [stiffness, damping].map(|matrix| summed(g, problem, &matrix, &outward));
    let operations = |[stiffness, damping]: &[Vec<Vec<ExprId>>; 2]| {
        let with_residual = [&rest[..], &stiffness.concat()].concat();
        let with_mass = [mass.concat(), damping.concat(), stiffness.concat()].concat();
        cost(g, &with_residual).operations + cost(g, &with_mass).operations
    };
    if operations(&composed) < operations(&differentiated) {
        taken(|| "linearise: stiffness and damping by variation".into());
        composed
    } else {
        differentiated
    }
}

/// A matrix over the unknowns from one over the angles in all.
fn summed(
    g: &mut Graph,
    problem: &Problem,
    columns: &[Vec<ExprId>],
    outward: &[usize],
) -> Vec<Vec<ExprId>> {
    let symmetric = is_symmetric(g, problem, columns);
    problem.runs.matrix(g, columns, symmetric, outward)
}

fn is_symmetric(g: &mut Graph, problem: &Problem, columns: &[Vec<ExprId>]) -> bool {
    let mut asymmetry = Vec::new();
    for (j, column) in columns.iter().enumerate() {
        for (i, mirrored) in columns[..j].iter().enumerate() {
            asymmetry.push(g.sub(column[i], mirrored[j]));
        }
    }
    vanish(g, problem, &asymmetry).into_iter().all(|zero| zero)
}

fn transposed(columns: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    let row = |i: usize| columns.iter().map(|column| column[i]).collect();
    (0..columns.len()).map(row).collect()
}

fn added(g: &mut Graph, a: &[Vec<ExprId>], b: &[Vec<ExprId>]) -> Vec<Vec<ExprId>> {
    a.iter()
        .zip(b)
        .map(|(a, b)| a.iter().zip(b).map(|(&a, &b)| g.add(a, b)).collect())
        .collect()
}

/// The three linearised matrices, row by row, with what is known of them put to use.
pub(super) struct Linear {
    mass: Vec<ExprId>,
    damping: Vec<ExprId>,
    stiffness: Vec<ExprId>,
}

impl Linear {
    pub(super) fn new(
        g: &mut Graph,
        jacobians: &Jacobians,
        properties: Properties,
        problem: &Problem,
    ) -> Self {
        let order = problem.outward_order();
        let n = order.len();
        let zero = g.zero();
        // Of two equal entries, the one that differentiates by the coordinate nearer to the leaves is cheaper: less
        // of the mechanism moves with it.
        let outer_last = |i: usize, j: usize| if order[i] <= order[j] { (i, j) } else { (j, i) };
        let symmetric = |matrix: &[Vec<ExprId>]| -> Vec<ExprId> {
            entries(n)
                .map(|(i, j)| {
                    let (row, column) = outer_last(i, j);
                    matrix[column][row]
                })
                .collect()
        };
        let general = |matrix: &[Vec<ExprId>]| -> Vec<ExprId> {
            entries(n).map(|(i, j)| matrix[j][i]).collect()
        };
        let damping = match properties.damping {
            Damping::Zero => vec![zero; n * n],
            Damping::General => general(&jacobians.damping),
            Damping::Gyroscopic => entries(n)
                .map(|(i, j)| {
                    let (row, column) = outer_last(i, j);
                    let entry = jacobians.damping[column][row];
                    match (i == j, (row, column) == (i, j)) {
                        (true, _) => zero,
                        (false, true) => entry,
                        (false, false) => g.neg(entry),
                    }
                })
                .collect(),
        };
        let stiffness = match properties.symmetric_stiffness {
            true => symmetric(&jacobians.stiffness),
            false => general(&jacobians.stiffness),
        };
        // The acceleration of a coasting coordinate is the rate of an unknown.
        let mass = match problem.topology.coasting.is_empty() {
            true => symmetric(&jacobians.mass),
            false => general(&jacobians.mass),
        };
        let this = Self {
            mass,
            damping,
            stiffness,
        };
        this.set_names(g, n);
        this
    }

    /// Names the entries for readers.
    fn set_names(&self, g: &mut Graph, n: usize) {
        for (name, values) in LINEAR
            .into_iter()
            .zip([&self.mass, &self.damping, &self.stiffness])
        {
            for ((i, j), &entry) in entries(n).zip(values) {
                g.set_name(entry, || format!("{name}_{i}_{j}"));
            }
        }
    }

    /// All entries, matrix after matrix.
    pub(super) fn roots(&self) -> Vec<ExprId> {
        [&self.mass[..], &self.damping, &self.stiffness].concat()
    }

    /// All entries of the matrices linearised along any motion: the mass matrix does not know of it, and the other two have
    /// no symmetry.
    pub(super) fn along_motion(&self, g: &mut Graph, s: &Symbols, e: &Equations) -> Vec<ExprId> {
        let n = e.motion.len();
        let all = |g: &mut Graph, motion: &[ExprId], inertial: Option<&Variation>| {
            let mut roots = self.mass.clone();
            let inertial = inertial.map(|known| [&known.by_velocity, &known.by_position]);
            for (k, list) in [&s.velocity, &s.q].into_iter().enumerate() {
                let mut columns = columns(g, motion, list);
                if let Some(known) = inertial {
                    columns = added(g, known[k], &columns);
                }
                roots.extend(entries(n).map(|(i, j)| columns[j][i]));
            }
            roots
        };
        let differentiated = all(g, &e.motion, None);
        let Some(known) = &e.variation else {
            return differentiated;
        };
        let composed = all(g, &e.parts.applied, Some(known));
        cheaper(g, differentiated, composed)
    }

    /// The three matrices.
    pub(super) fn arrays(&self, n: usize) -> Vec<Array> {
        linear_arrays(&self.roots(), n)
    }

    /// Derivatives of the three by each symbol of a list.
    pub(super) fn partials(&self, g: &mut Graph, n: usize, by: &SymbolList) -> Vec<Array> {
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

/// Of two ways to write the same, the one with fewer operations.
fn cheaper(g: &Graph, one: Vec<ExprId>, other: Vec<ExprId>) -> Vec<ExprId> {
    let operations = |roots: &[ExprId]| cost(g, roots).operations;
    if operations(&other) < operations(&one) {
        taken(|| "linearise: along a motion by variation".into());
        other
    } else {
        one
    }
}

const LINEAR: [&str; 3] = ["mass", "damping", "stiffness"];

/// The three matrices from all their entries.
pub(super) fn linear_arrays(roots: &[ExprId], n: usize) -> Vec<Array> {
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

/// Rows and columns of an `n` by `n` matrix, row by row.
fn entries(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n * n).map(move |k| (k / n, k % n))
}
