//! The matrices of the linearised equations, using their known properties.

use std::cmp::Ordering;

use crate::algebra::{Array, ExprId, Graph, cost};
use crate::census::taken;
use crate::mechanics::equations::Equations;
use crate::mechanics::functions::{Damping, Properties};
use crate::mechanics::inertia::Variation;
use crate::mechanics::setup::{Context, SymbolList, Symbols, added, columns};

use super::jacobians::Jacobians;

/// The three linearised matrices, row by row, using their known properties.
pub(crate) struct Linear {
    mass: Vec<ExprId>,
    damping: Vec<ExprId>,
    stiffness: Vec<ExprId>,
}

impl Linear {
    pub(crate) fn new(g: &mut Graph, jacobians: &Jacobians, properties: Properties, context: &Context) -> Self {
        let order = context.outward_order();
        let n = order.len();
        let zero = g.zero();
        // Of two equal entries, the derivative by the coordinate nearer to the leaves is cheaper: less of the mechanism
        // moves with it. Of the coordinates of one joint or beam, any may come first.
        let outer_last = |i: usize, j: usize| match order[i].cmp(&order[j]).then(j.cmp(&i)) {
            Ordering::Greater => (j, i),
            _ => (i, j),
        };
        let symmetric = |matrix: &[Vec<ExprId>]| -> Vec<ExprId> {
            entries(n)
                .map(|(i, j)| {
                    let (row, column) = outer_last(i, j);
                    matrix[column][row]
                })
                .collect()
        };
        let general = |matrix: &[Vec<ExprId>]| -> Vec<ExprId> { entries(n).map(|(i, j)| matrix[j][i]).collect() };
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
        let stiffness = if properties.symmetric_stiffness {
            symmetric(&jacobians.stiffness)
        } else {
            general(&jacobians.stiffness)
        };
        // The acceleration of a coasting coordinate is the rate of an unknown.
        let mass =
            if context.topology.coasting.is_empty() { symmetric(&jacobians.mass) } else { general(&jacobians.mass) };
        let this = Self { mass, damping, stiffness };
        this.set_names(g, n);
        this
    }

    /// Names the entries, for readable code.
    fn set_names(&self, g: &mut Graph, n: usize) {
        for (name, values) in LINEAR.into_iter().zip([&self.mass, &self.damping, &self.stiffness]) {
            for ((i, j), &entry) in entries(n).zip(values) {
                g.set_name(entry, || format!("{name}_{i}_{j}"));
            }
        }
    }

    /// All entries, one matrix after the other.
    pub(crate) fn roots(&self) -> Vec<ExprId> {
        [&self.mass[..], &self.damping, &self.stiffness].concat()
    }

    /// All entries of the matrices linearised along any motion, unless they take more than `limit` operations. The mass
    /// matrix does not depend on the motion, and the other two are not symmetric.
    pub(crate) fn along_motion(&self, g: &mut Graph, s: &Symbols, e: &Equations, limit: usize) -> Option<Vec<ExprId>> {
        let n = e.motion.len();
        let operations = |g: &Graph, roots: &[ExprId]| cost(g, roots).operations;
        if 3 * n * n > limit {
            return None;
        }
        let variation = e.variation.as_ref().filter(|_| e.by_coordinates);
        if let Some(known) = variation {
            let inertial = [&known.by_velocity, &known.by_position].map(|matrix| matrix.concat());
            if operations(g, &inertial.concat()) > limit {
                return None;
            }
        }
        let all = |g: &mut Graph, motion: &[ExprId], inertial: Option<&Variation>| {
            let mut roots = match inertial {
                None => self.mass.clone(),
                Some(known) => {
                    let applied = columns(g, motion, &s.acceleration);
                    let mass = added(g, &known.mass, &applied);
                    entries(n).map(|(i, j)| mass[j][i]).collect()
                }
            };
            let inertial = inertial.map(|known| [&known.by_velocity, &known.by_position]);
            for (k, list) in [&s.velocity, &s.q].into_iter().enumerate() {
                if operations(g, &roots) > limit {
                    return None;
                }
                let mut columns = columns(g, motion, list);
                if let Some(known) = inertial {
                    columns = added(g, known[k], &columns);
                }
                roots.extend(entries(n).map(|(i, j)| columns[j][i]));
            }
            Some((operations(g, &roots), roots))
        };
        let differentiated = all(g, &e.motion, None);
        let composed = variation.and_then(|known| all(g, &e.parts.applied, Some(known)));
        let (fewest, motion) = match (differentiated, composed) {
            (Some((operations, _)), Some((fewer, composed))) if fewer < operations => {
                taken(|| "linearise: along a motion by variation".into());
                (fewer, composed)
            }
            (Some(only), _) | (None, Some(only)) => only,
            (None, None) => return None,
        };
        (fewest <= limit).then_some(motion)
    }

    /// The three matrices.
    pub(crate) fn arrays(&self, n: usize) -> Vec<Array> {
        linear_arrays(&self.roots(), n)
    }

    /// Derivatives of the three matrices by each symbol of a list.
    pub(crate) fn partials(&self, g: &mut Graph, n: usize, by: &SymbolList) -> Vec<Array> {
        let each = columns(g, &self.roots(), by);
        let count = by.ids.len();
        let mut arrays = Vec::new();
        for (k, name) in LINEAR.into_iter().enumerate() {
            let values = each.iter().flat_map(|roots| &roots[k * n * n..(k + 1) * n * n]).copied().collect();
            arrays.push(Array { name, shape: vec![count, n, n], values });
        }
        arrays
    }
}

const LINEAR: [&str; 3] = ["mass", "damping", "stiffness"];

/// The three matrices as arrays, from the list of all entries.
pub(crate) fn linear_arrays(roots: &[ExprId], n: usize) -> Vec<Array> {
    LINEAR
        .into_iter()
        .enumerate()
        .map(|(k, name)| Array { name, shape: vec![n, n], values: roots[k * n * n..(k + 1) * n * n].to_vec() })
        .collect()
}

/// Row and column of each entry of an `n` by `n` matrix, row by row.
fn entries(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n * n).map(move |k| (k / n, k % n))
}
