//! Derivatives of inertia, weight and the strain of beams, in the cheaper of two ways.

use crate::algebra::{ExprId, Graph, cost, substitute};
use crate::census::taken;
use crate::mechanics::equations::Equations;
use crate::mechanics::inertia::{Variation, mass_matrix, variation_at_rest};
use crate::mechanics::loads::strained;
use crate::mechanics::motion::for_inertia;
use crate::mechanics::setup::{Context, ForceSelection, Mirrored, at_rest, columns, mirrored};

use super::columns::{Columns, folded};

/// Number of operations up to which the two ways are compared.
const COMPARED: usize = 50_000;

/// Differentiating a beam leaves more to be shared later (`algebra/regroup.rs`), about three percent: walks over beams must
/// be better by this part of their operations.
const SHARED: usize = 20;

/// Mass, damping and stiffness.
type Matrices = [Columns; 3];

/// What inertia, weight and the strain of beams ask of the unknowns, to be linearised.
pub(super) struct Inertial<'a> {
    context: &'a Context<'a>,
    equations: &'a Equations,
    /// For each unknown, the position of its joint in the order from the ground to the leaves; sections come last.
    outward: Vec<usize>,
    /// The equations at rest.
    rest: Vec<ExprId>,
}

impl<'a> Inertial<'a> {
    pub(super) fn new(g: &mut Graph, context: &'a Context<'a>, equations: &'a Equations) -> Self {
        let mut outward = context.outward_order();
        outward.resize(context.runs.position.ids.len(), usize::MAX);
        let rest = still(g, context, &equations.parts.inertial);
        Self { context, equations, outward, rest }
    }

    /// The three matrices with respect to the unknowns instead of the absolute angles: by differentiation, or from the
    /// [`Variation`] of the equations if that takes fewer operations, counted for stiffness with the residual and for all
    /// together. The larger a mechanism is, the more surely the walks win: beyond [`COMPARED`] operations, differentiating
    /// only to compare would be most of the work of reading the declaration.
    pub(super) fn matrices(&self, g: &mut Graph) -> Matrices {
        let walked = self.by_walks(g);
        let operations = walked.as_ref().map(|walked| self.operations(g, walked));
        match walked {
            Some(walked) if operations > Some(COMPARED) => walked,
            walked => {
                let differentiated = self.by_differentiation(g);
                let few = operations.is_some_and(|operations| {
                    let shared = if self.context.sections.rows.is_empty() { 0 } else { operations / SHARED };
                    operations + shared < self.operations(g, &differentiated)
                });
                match walked {
                    Some(walked) if few => {
                        taken(|| "linearise: stiffness and damping by variation".into());
                        walked
                    }
                    _ => differentiated,
                }
            }
        }
    }

    fn operations(&self, g: &Graph, matrices: &Matrices) -> usize {
        let with_residual = [&self.rest[..], &matrices[2].concat()].concat();
        let all = matrices.each_ref().map(|matrix| matrix.concat()).concat();
        cost(g, &with_residual).operations + cost(g, &all).operations
    }

    /// From walks over the bodies; `None` where they do not apply.
    pub(super) fn by_walks(&self, g: &mut Graph) -> Option<Matrices> {
        let Self { context, equations, outward, .. } = self;
        let [mass, damping, stiffness] = match &equations.variation {
            Some(known) => {
                let [damping, stiffness] =
                    [&known.by_velocity, &known.by_position].map(|matrix| all_still(g, context, matrix));
                [known.mass.clone(), damping, stiffness]
            }
            None => {
                let strained = strained(g, context);
                let Variation { mass, by_position, by_velocity } = variation_at_rest(g, context, &strained)?;
                [mass, by_velocity, by_position]
            }
        };
        let [damping, stiffness] = [damping, stiffness].map(|matrix| folded(g, context, &matrix, outward));
        Some([mass, damping, stiffness])
    }

    /// By differentiation; the mass matrix of a mechanism without beams from composite bodies.
    pub(super) fn by_differentiation(&self, g: &mut Graph) -> Matrices {
        let Self { context, equations, outward, rest } = self;
        let (runs, inertial) = (context.runs, &equations.parts.inertial);
        let running = vec![g.zero(); context.symbols.running.ids.len()];
        let mass = if context.sections.rows.is_empty() {
            let kinematics = for_inertia(g, context, &running, ForceSelection::INERTIA);
            mass_matrix(g, context, &kinematics)
        } else {
            columns(g, inertial, &runs.acceleration)
        };
        // the acceleration of a coasting coordinate is the rate of an unknown
        let symmetric = context.topology.coasting.is_empty();
        let mass = runs.matrix(g, &mass, symmetric, outward);
        let relation = if symmetric { Mirrored::Equal } else { Mirrored::Unrelated };
        let mass = context.sections.matrix(g, &mass, relation);
        let stiffness = columns(g, rest, &runs.position);
        let damping = columns(g, inertial, &runs.velocity);
        let damping = all_still(g, context, &damping);
        let [damping, stiffness] = [damping, stiffness].map(|matrix| self.summed(g, &matrix));
        [mass, damping, stiffness]
    }

    /// Transforms a matrix with respect to the absolute angles to one with respect to the unknowns.
    fn summed(&self, g: &mut Graph, columns: &Columns) -> Columns {
        let relation = mirrored(g, self.context, columns);
        let summed = self.context.runs.matrix(g, columns, relation == Mirrored::Equal, &self.outward);
        self.context.sections.matrix(g, &summed, relation)
    }
}

/// Expressions of the absolute angles and the sections at rest.
fn still(g: &mut Graph, context: &Context, roots: &[ExprId]) -> Vec<ExprId> {
    let runs = context.runs;
    let zeros = vec![g.zero(); runs.position.ids.len()];
    let all: Vec<_> = runs.velocity.with(&zeros).chain(runs.acceleration.with(&zeros)).collect();
    let roots = substitute(g, roots, &all);
    at_rest(g, context.symbols, &roots)
}

fn all_still(g: &mut Graph, context: &Context, columns: &Columns) -> Columns {
    still(g, context, &columns.concat()).chunks(columns.len().max(1)).map(<[_]>::to_vec).collect()
}
