//! The equations of steady motion and of small motions about it.

use crate::algebra::{ExprId, Graph, SymbolId};
use crate::mechanics::inertia::{Variation, variation};
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, ForceSelection, at_rest, weighted_sum};

use super::outputs::outputs;
use super::residual::Residual;

/// The equations with the running coordinates set to zero, which is permitted once a steady state has been established.
pub(crate) struct Equations {
    /// `g(qddot, qdot, q; u, b)`, and its parts.
    pub(crate) motion: Vec<ExprId>,
    pub(crate) parts: Residual,
    /// Derivatives of the inertial part by walks over the bodies, if these are applicable.
    pub(crate) variation: Option<Variation>,
    /// What makes blades do the same, as they do in steady motion in multiblade coordinates.
    pub(crate) alike: Vec<(SymbolId, ExprId)>,
    /// Whether the unknowns are the coordinates, along which these derivatives are.
    pub(crate) by_coordinates: bool,
    /// `phi^T g`, `left^T g` and `w^T g` with the symbols of the adjoint kernels.
    pub(crate) powers: [ExprId; 3],
    /// `g(0, 0, q; u, b)`.
    pub(crate) rest: Vec<ExprId>,
    /// The part of `rest` due to inertia.
    pub(crate) rest_inertia: Vec<ExprId>,
    /// The part of `rest` due to applied forces, with the sign of a force: `rest = rest_inertia - rest_applied`.
    pub(crate) rest_applied: Vec<ExprId>,
    /// Outputs along any motion.
    pub(crate) outputs_in_motion: Vec<ExprId>,
    /// Outputs at rest.
    pub(crate) outputs: Vec<ExprId>,
}

impl Equations {
    /// From the motion of every frame with the running coordinates at `running`: zero, or if `unknowns` have harmonics,
    /// their symbols.
    pub(crate) fn new(
        g: &mut Graph,
        context: &Context,
        (running, kinematics): (&[ExprId], &Kinematics),
        unknowns: &Context,
    ) -> Self {
        let (symbols, harmonics) = (unknowns.symbols, unknowns.harmonics);
        let parts = Residual::new(g, context, running, kinematics, ForceSelection::ALL);
        let motion = parts.total(g, context);
        let variation = if harmonics.is_empty() { variation(g, context, running) } else { None };
        let [inertia, applied] = [ForceSelection::INERTIA, ForceSelection::APPLIED].map(|selection| {
            let total = Residual::new(g, context, running, kinematics, selection).total(g, context);
            harmonics.forces(g, &total)
        });
        let outputs_in_motion = outputs(g, context, running, kinematics);
        let outputs_in_motion = harmonics.mean(g, &outputs_in_motion);
        let rates = [&symbols.phi, &symbols.pencil.left, &symbols.w];
        let motion = harmonics.forces(g, &motion);
        let powers = rates.map(|rate| match harmonics.is_empty() {
            true => parts.power(g, context, &motion, &rate.values),
            false => weighted_sum(g, &rate.values, &motion),
        });
        let rest = at_rest(g, symbols, &motion);
        let rest_inertia = at_rest(g, symbols, &inertia);
        let rest_applied = at_rest(g, symbols, &applied).into_iter().map(|force| g.neg(force)).collect();
        let outputs = at_rest(g, symbols, &outputs_in_motion);
        Self {
            motion,
            parts,
            variation,
            alike: unknowns.multiblade.alike(g),
            by_coordinates: context.multiblade.is_empty(),
            powers,
            rest,
            rest_inertia,
            rest_applied,
            outputs_in_motion,
            outputs,
        }
    }
}
