//! Scalars whose gradients contain all design derivatives of a mode.

use crate::algebra::{Array, Direction, ExprId, Graph, SymbolId, derivatives_along, gradient, substitute};
use crate::mechanics::equations::Equations;
use crate::mechanics::setup::{Symbols, at_rest};

/// `phi^T (Khat - lambda Mhat) phi` without forming either matrix: the derivative of `phi^T g` along
/// (`qddot`, `q`) = (`-lambda phi`, `phi`), with the leading `phi` held fixed.
pub(crate) fn mode_functional(g: &mut Graph, s: &Symbols, e: &Equations) -> ExprId {
    let zeros = vec![g.zero(); s.velocity.ids.len()];
    let still: Vec<_> = s.velocity.with(&zeros).collect();
    let power = substitute(g, &e.powers[..1], &still);
    let minus_lambda = g.neg(s.lambda.values[0]);
    let acceleration: Vec<ExprId> = s.phi.values.iter().map(|&phi| g.mul(minus_lambda, phi)).collect();
    let rates = s.acceleration.with(&acceleration).chain(s.q.with(&s.phi.values)).collect();
    let functional = derivatives_along(g, &power, &Direction::new("_mode", rates));
    let functional = at_rest(g, s, &functional);
    substitute(g, &functional, &e.alike)[0]
}

/// `left^T (Mhat acceleration + Chat velocity + Khat position)` without forming any matrix: the derivative of
/// `left^T g` along (`qddot`, `qdot`, `q`), taken at rest. `Chat` contains products of a velocity and the drives, so
/// the velocities are set to zero only after differentiating.
pub(crate) fn pencil_functional(g: &mut Graph, s: &Symbols, e: &Equations) -> ExprId {
    let functional = at_rest_along_motion(g, s, e.powers[1], "_pencil");
    substitute(g, &[functional], &e.alike)[0]
}

/// The derivative of a scalar along the acceleration, velocity and position of the pencil, taken at rest.
pub(crate) fn at_rest_along_motion(g: &mut Graph, s: &Symbols, root: ExprId, suffix: &'static str) -> ExprId {
    let rates = s
        .acceleration
        .with(&s.pencil.acceleration.values)
        .chain(s.velocity.with(&s.pencil.velocity.values))
        .chain(s.q.with(&s.pencil.position.values))
        .collect();
    let functional = derivatives_along(g, &[root], &Direction::new(suffix, rates));
    at_rest(g, s, &functional)[0]
}

/// Gradient of a scalar by coordinates, inputs and design variables.
pub(crate) fn state_gradient(g: &mut Graph, s: &Symbols, root: ExprId) -> Vec<Array> {
    let symbols: Vec<SymbolId> = [&s.q, &s.u, &s.b].iter().flat_map(|list| list.ids.clone()).collect();
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
