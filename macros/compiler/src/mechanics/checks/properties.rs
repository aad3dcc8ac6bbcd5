//! Properties of the linearised matrices that hold at every state.

use crate::algebra::{ExprId, Graph};
use crate::mechanics::functions::{Damping, Properties};
use crate::mechanics::linear::Jacobians;
use crate::mechanics::setup::{Context, vanish};

/// The properties of `Khat` and `Chat`.
pub(crate) fn properties(g: &mut Graph, context: &Context, jacobians: &Jacobians) -> Properties {
    let Jacobians { stiffness, damping, .. } = jacobians;
    let n = stiffness.len();
    let mut asymmetry = Vec::new();
    let mut symmetric_damping = Vec::new();
    for j in 0..n {
        for i in 0..=j {
            asymmetry.push(g.sub(stiffness[j][i], stiffness[i][j]));
            symmetric_damping.push(g.add(damping[j][i], damping[i][j]));
        }
    }
    let all = |g: &Graph, roots: &[ExprId]| vanish(g, context, roots).into_iter().all(|zero| zero);
    let damping = if all(g, &damping.concat()) {
        Damping::Zero
    } else if all(g, &symmetric_damping) {
        Damping::Gyroscopic
    } else {
        Damping::General
    };
    Properties { symmetric_stiffness: all(g, &asymmetry), damping }
}
