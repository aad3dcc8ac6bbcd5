//! Derivatives of the residual with respect to everything it is linearised in (eqs. 13-17).

use crate::algebra::{ExprId, Graph, cost, substitute};
use crate::census::taken;
use crate::mechanics::equations::Equations;
use crate::mechanics::inertia::{Variation, mass_matrix, variation_at_rest};
use crate::mechanics::loads::strained;
use crate::mechanics::motion::for_inertia;
use crate::mechanics::setup::{Context, ForceSelection, Mirrored, at_rest, columns, mirrored};

use super::columns::added;

/// Number of operations up to which the two ways to the inertial part are compared.
const COMPARED: usize = 50_000;

/// Differentiating a beam leaves more to be shared later (`algebra/regroup.rs`), about three percent: walks over beams must
/// be better by this part of their operations.
const SHARED: usize = 20;

/// All first derivatives of the residual at rest: `matrix[j][i]` is the derivative of residual `i` by coordinate `j`.
pub(crate) struct Jacobians {
    /// `Mhat = dg/dqddot` (eq. 15). It holds at any velocity.
    pub(crate) mass: Vec<Vec<ExprId>>,
    /// `Chat = dg/dqdot` (eq. 16, of the complete residual).
    pub(crate) damping: Vec<Vec<ExprId>>,
    /// `Khat = dg/dq` (eq. 17).
    pub(crate) stiffness: Vec<Vec<ExprId>>,
}

impl Jacobians {
    /// Inertia and weight are differentiated by the absolute angles, forces and constraints by the unknowns.
    pub(crate) fn new(g: &mut Graph, context: &Context, e: &Equations) -> Self {
        let s = context.symbols;
        let [mass, damping, stiffness] = of_inertia(g, context, e);

        let applied = &e.parts.applied;
        let applied_at_rest = at_rest(g, s, applied);
        let by_position = columns(g, &applied_at_rest, &s.q);
        let moving = columns(g, applied, &s.velocity);
        let by_velocity: Vec<_> = moving.iter().map(|column| at_rest(g, s, column)).collect();
        // less moves with the coordinates further out
        let inward: Vec<usize> = outward(context).into_iter().map(|order| usize::MAX - order).collect();
        let [by_velocity, by_position] = [by_velocity, by_position].map(|matrix| folded(g, context, &matrix, &inward));
        let mut in_unknowns = |columns: Vec<Vec<ExprId>>| -> Vec<Vec<ExprId>> {
            let n = columns.len();
            let flat = context.in_unknowns(g, &columns.concat());
            flat.chunks(n.max(1)).map(<[_]>::to_vec).collect()
        };
        let [mass, damping, stiffness] = [mass, damping, stiffness].map(&mut in_unknowns);
        Self { mass, damping: added(g, &damping, &by_velocity), stiffness: added(g, &stiffness, &by_position) }
    }
}

/// Mass, damping and stiffness due to inertia, weight and the strain of beams, with respect to the unknowns instead of the
/// absolute angles. The last two are obtained by differentiation beside the mass matrix. Or all three are taken from the
/// [`Variation`] of the equations if that takes fewer operations, counted for stiffness with the residual and for all
/// together. The larger a mechanism is, the more surely the walks win: beyond [`COMPARED`] operations, differentiating only
/// to compare would be most of the work of reading the declaration.
fn of_inertia(g: &mut Graph, context: &Context, e: &Equations) -> [Vec<Vec<ExprId>>; 3] {
    let (s, runs, inertial) = (context.symbols, context.runs, &e.parts.inertial);
    let outward = outward(context);
    let still = |g: &mut Graph, roots: &[ExprId]| {
        let zeros = vec![g.zero(); runs.position.ids.len()];
        let rates = runs.velocity.with(&zeros);
        let all: Vec<_> = rates.chain(runs.acceleration.with(&zeros)).collect();
        let roots = substitute(g, roots, &all);
        at_rest(g, s, &roots)
    };
    let all_still = |g: &mut Graph, columns: &[Vec<ExprId>]| -> Vec<Vec<ExprId>> {
        let roots = still(g, &columns.concat());
        let columns = roots.chunks(columns.len().max(1));
        columns.map(<[_]>::to_vec).collect()
    };
    let rest = still(g, inertial);
    let operations = |g: &Graph, matrices: &[Vec<Vec<ExprId>>; 3]| {
        let with_residual = [&rest[..], &matrices[2].concat()].concat();
        let all = matrices.each_ref().map(|matrix| matrix.concat()).concat();
        cost(g, &with_residual).operations + cost(g, &all).operations
    };
    let varied = match &e.variation {
        Some(known) => {
            let [damping, stiffness] = [&known.by_velocity, &known.by_position].map(|matrix| all_still(g, matrix));
            Some([known.mass.clone(), damping, stiffness])
        }
        None => {
            let strained = strained(g, context);
            let varied = variation_at_rest(g, context, &strained);
            varied.map(|Variation { mass, by_position, by_velocity }| [mass, by_velocity, by_position])
        }
    };
    let composed = varied.map(|[mass, damping, stiffness]| {
        let [damping, stiffness] = [damping, stiffness].map(|matrix| folded(g, context, &matrix, &outward));
        let composed = [mass, damping, stiffness];
        (operations(g, &composed), composed)
    });
    let composed = match composed {
        Some((operations, composed)) if operations > COMPARED => return composed,
        other => other,
    };
    let differentiated = differentiated(g, context, e, (&rest, &outward), all_still);
    let shared = |operations: usize| match context.sections.rows.is_empty() {
        true => 0,
        false => operations / SHARED,
    };
    match composed {
        Some((fewer, composed)) if fewer + shared(fewer) < operations(g, &differentiated) => {
            taken(|| "linearise: stiffness and damping by variation".into());
            composed
        }
        _ => differentiated,
    }
}

/// The three matrices by differentiation; those of a mechanism without beams beside the mass matrix of composite bodies.
fn differentiated(
    g: &mut Graph,
    context: &Context,
    e: &Equations,
    (rest, outward): (&[ExprId], &[usize]),
    all_still: impl Fn(&mut Graph, &[Vec<ExprId>]) -> Vec<Vec<ExprId>>,
) -> [Vec<Vec<ExprId>>; 3] {
    let (runs, inertial) = (context.runs, &e.parts.inertial);
    let running = vec![g.zero(); context.symbols.running.ids.len()];
    let mass = match context.sections.rows.is_empty() {
        true => {
            let kinematics = for_inertia(g, context, &running, ForceSelection::INERTIA);
            mass_matrix(g, context, &kinematics)
        }
        false => columns(g, inertial, &runs.acceleration),
    };
    // the acceleration of a coasting coordinate is the rate of an unknown
    let symmetric = context.topology.coasting.is_empty();
    let mass = runs.matrix(g, &mass, symmetric, outward);
    let relation = match symmetric {
        true => Mirrored::Equal,
        false => Mirrored::Unrelated,
    };
    let mass = context.sections.matrix(g, &mass, relation);
    let stiffness = columns(g, rest, &runs.position);
    let damping = columns(g, inertial, &runs.velocity);
    let damping = all_still(g, &damping);
    let [damping, stiffness] = [damping, stiffness].map(|matrix| summed(g, context, &matrix, outward));
    [mass, damping, stiffness]
}

/// A matrix with what stands on the side of its diagonal that takes more operations from the other side, if they are equal
/// or opposite: equations of outer coordinates are shorter when differentiated by inner ones than the other way round.
fn folded(g: &mut Graph, context: &Context, columns: &[Vec<ExprId>], outward: &[usize]) -> Vec<Vec<ExprId>> {
    let relation = mirrored(g, context, columns);
    taken(|| format!("linearise: {relation:?} across the diagonal"));
    let mut entry = |i: usize, j: usize| {
        let (here, there) = (columns[j][i], columns[i][j]);
        let takes_more = outward[i] <= outward[j] && !g.is(here, 0.0) || g.is(there, 0.0);
        match relation {
            Mirrored::Equal if takes_more => there,
            Mirrored::Opposite if takes_more && i != j => g.neg(there),
            _ => here,
        }
    };
    let n = columns.len();
    (0..n).map(|j| (0..n).map(|i| entry(i, j)).collect()).collect()
}

/// Transforms a matrix with respect to the absolute angles to one with respect to the unknowns.
fn summed(g: &mut Graph, context: &Context, columns: &[Vec<ExprId>], outward: &[usize]) -> Vec<Vec<ExprId>> {
    let mirrored = mirrored(g, context, columns);
    let summed = context.runs.matrix(g, columns, mirrored == Mirrored::Equal, outward);
    context.sections.matrix(g, &summed, mirrored)
}

/// [`Context::outward_order`], and sections last.
fn outward(context: &Context) -> Vec<usize> {
    let mut order = context.outward_order();
    order.resize(context.runs.position.ids.len(), usize::MAX);
    order
}
