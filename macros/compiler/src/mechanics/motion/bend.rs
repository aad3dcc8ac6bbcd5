//! Twist and curvature of a section from the way it has turned.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3};

/// The only axis about which a section turns.
pub(super) fn only_axis(g: &Graph, turn: Vector3) -> Option<usize> {
    let turns: Vec<usize> = (0..3).filter(|&k| !g.is(turn.0[k], 0.0)).collect();
    match turns[..] {
        [axis] => Some(axis),
        _ => None,
    }
}

/// `1 + |turn|^2 / 4`.
pub(super) fn denominator(g: &mut Graph, turn: Vector3) -> ExprId {
    let one = g.constant(1.0);
    let square = turn.dot(g, turn);
    let quarter = g.scale(0.25, square);
    g.add(one, quarter)
}

/// `1 / (1 + |turn|^2 / 4)`.
pub(super) fn factor(g: &mut Graph, turn: Vector3) -> ExprId {
    let one = g.constant(1.0);
    let denominator = denominator(g, turn);
    g.div(one, denominator)
}

/// The change along the length of [`bend`], from the slope of the slope.
pub(crate) fn bend_change(g: &mut Graph, turn: Vector3, slope: Vector3, curl: Vector3) -> Vector3 {
    if only_axis(g, turn).is_some() {
        return curl;
    }
    let factor = factor(g, turn);
    let denominator = denominator(g, turn);
    let (bent, change) = (bend(g, turn, slope), part(g, turn, denominator, curl));
    // f' = -f^2 turn . slope / 2
    let along = turn.dot(g, slope);
    let half = g.scale(0.5, factor);
    let shrinking = g.mul(half, along);
    let lost = bent.scale(g, shrinking);
    change.sub(g, lost)
}

/// `(slope - turn x slope / 2) / denominator`.
fn part(g: &mut Graph, turn: Vector3, denominator: ExprId, slope: Vector3) -> Vector3 {
    let half = Vector3(turn.cross(g, slope).0.map(|value| g.scale(0.5, value)));
    Vector3(slope.sub(g, half).0.map(|value| g.div(value, denominator)))
}

/// Twist rate and curvatures along the axes of a section, times the length: the slope of its angle, or if it has turned
/// by a Rodrigues vector, `f (slope - turn x slope / 2)`.
pub(crate) fn bend(g: &mut Graph, turn: Vector3, slope: Vector3) -> Vector3 {
    if only_axis(g, turn).is_some() {
        return slope;
    }
    let denominator = denominator(g, turn);
    let bent = part(g, turn, denominator, slope);
    let by = bend_slopes(g, [turn, slope, bent]);
    for (c, &value) in bent.0.iter().enumerate() {
        g.set_slopes(value, by.iter().map(|(by, slope)| (*by, slope.0[c])).collect());
    }
    bent
}

/// Derivatives of [`bend`] by the turn and by the slope. For `m = slope - turn x slope / 2`, `D = 1 / f`, `D bent = m`
/// gives `bent_a = f m_a - bent f turn_a / 2`.
fn bend_slopes(g: &mut Graph, [turn, slope, bent]: [Vector3; 3]) -> Vec<(ExprId, Vector3)> {
    let factor = factor(g, turn);
    let half_factor = g.scale(0.5, factor);
    let (half, across) = (turn.scale(g, half_factor), slope.scale(g, half_factor));
    let axes = Matrix3::identity(g).0;
    let mut by = Vec::new();
    for (axis, (&turn, &half)) in axes.iter().zip(turn.0.iter().zip(&half.0)) {
        let lost = bent.scale(g, half);
        by.push((turn, across.cross(g, *axis).sub(g, lost)));
    }
    for (axis, &slope) in axes.iter().zip(&slope.0) {
        let across = half.cross(g, *axis);
        by.push((slope, axis.scale(g, factor).sub(g, across)));
    }
    by
}

/// Power of moments on twist and curvatures per unit rate of each component of the turn and of the slope.
pub(crate) fn bend_powers(g: &mut Graph, turn: Vector3, slope: Vector3, moment: Vector3) -> [ExprId; 6] {
    let zero = g.zero();
    if only_axis(g, turn).is_some() {
        let [x, y, z] = moment.0;
        return [zero, zero, zero, x, y, z];
    }
    let factor = factor(g, turn);
    let bent = bend(g, turn, slope);
    let by = bend_slopes(g, [turn, slope, bent]);
    let mut powers = [zero; 6];
    for (power, (_, slope)) in powers.iter_mut().zip(&by) {
        *power = slope.dot(g, moment);
    }
    let half_factor = g.scale(0.5, factor);
    let half = turn.scale(g, half_factor);
    let half = [half.0, [zero; 3]].concat();
    let spent = moment.dot(g, bent);
    let spent = g.mul(half_factor, spent);
    let twisting = moment.scale(g, half_factor);
    let axes = Matrix3::identity(g).0;
    let mut curved = |a: usize, b: usize| {
        let lost = both(g, &powers, &half, a, b);
        let entry = g.neg(lost);
        match (a < 3, b < 3) {
            (true, true) if a == b => g.sub(entry, spent),
            (true, false) => {
                let across = axes[a].cross(g, axes[b - 3]).dot(g, twisting);
                g.sub(entry, across)
            }
            _ => entry,
        }
    };
    let all = [0, 1, 2, 3, 4, 5];
    // equal entries must be one node
    let curved = all.map(|a| all.map(|b| curved(b.min(a), b.max(a))));
    for (a, &power) in powers.iter().enumerate() {
        let by_moment = moment.0.into_iter().zip(by[a].1.0);
        let by_turn = by.iter().map(|(by, _)| *by).zip(curved[a]);
        g.set_slopes(power, by_moment.chain(by_turn).collect());
    }
    powers
}

/// `u_a v_b + u_b v_a`.
pub(super) fn both(g: &mut Graph, u: &[ExprId], v: &[ExprId], a: usize, b: usize) -> ExprId {
    let (left, right) = (g.mul(u[a], v[b]), g.mul(u[b], v[a]));
    g.add(left, right)
}
