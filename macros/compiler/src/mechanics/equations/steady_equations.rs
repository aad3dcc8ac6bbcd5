//! The equations of steady motion and of small motions about it.

use crate::algebra::{ExprId, Graph};
use crate::mechanics::inertia::{Variation, variation};
use crate::mechanics::motion::Kinematics;
use crate::mechanics::setup::{Context, ForceSelection, at_rest};

use super::outputs::outputs;
use super::residual::Residual;

/// The equations with the running coordinates set to zero, which is permitted once a steady state has been established.
pub(crate) struct Equations {
    /// `g(qddot, qdot, q; u, b)`, and its parts.
    pub(crate) motion: Vec<ExprId>,
    pub(crate) parts: Residual,
    /// Derivatives of the inertial part by walks over the bodies, if these are applicable.
    pub(crate) variation: Option<Variation>,
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
    /// The motion of every frame with the running coordinates at zero.
    pub(crate) kinematics: Kinematics,
    /// Outputs at rest.
    pub(crate) outputs: Vec<ExprId>,
}

impl Equations {
    pub(crate) fn new(g: &mut Graph, context: &Context, kinematics: Kinematics) -> Self {
        let zero = g.zero();
        let symbols = context.symbols;
        let running = vec![zero; symbols.running.ids.len()];
        let parts = Residual::new(g, context, &running, &kinematics, ForceSelection::ALL);
        let motion = parts.total(g, context);
        let variation = if context.multiblade.is_empty() { variation(g, context, &running) } else { None };
        let inertia = Residual::new(g, context, &running, &kinematics, ForceSelection::INERTIA).total(g, context);
        let applied = Residual::new(g, context, &running, &kinematics, ForceSelection::APPLIED).total(g, context);
        let outputs_in_motion = outputs(g, context, &running, &kinematics);
        let rates = [&symbols.phi, &symbols.pencil.left, &symbols.w];
        let powers = rates.map(|rate| parts.power(g, context, &motion, &rate.values));
        let rest = at_rest(g, symbols, &motion);
        let rest_inertia = at_rest(g, symbols, &inertia);
        let rest_applied = at_rest(g, symbols, &applied).into_iter().map(|force| g.neg(force)).collect();
        let outputs = at_rest(g, symbols, &outputs_in_motion);
        Self {
            kinematics,
            motion,
            parts,
            variation,
            powers,
            rest,
            rest_inertia,
            rest_applied,
            outputs_in_motion,
            outputs,
        }
    }
}
