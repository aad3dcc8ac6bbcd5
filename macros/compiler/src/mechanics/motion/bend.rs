//! Twist and curvature of a section from the way it has turned.

use crate::algebra::{ExprId, Graph, Vector3};

/// The only axis about which a section turns.
pub(super) fn only_axis(g: &Graph, turn: Vector3) -> Option<usize> {
    let turns: Vec<usize> = (0..3).filter(|&k| !g.is(turn.0[k], 0.0)).collect();
    match turns[..] {
        [axis] => Some(axis),
        _ => None,
    }
}

/// `1 / (1 + |turn|^2 / 4)`.
pub(super) fn factor(g: &mut Graph, turn: Vector3) -> ExprId {
    let one = g.constant(1.0);
    let square = turn.dot(g, turn);
    let quarter = g.scale(0.25, square);
    let denominator = g.add(one, quarter);
    g.div(one, denominator)
}

/// The change along the length of [`bend`], from the slope of the slope.
pub(crate) fn bend_change(g: &mut Graph, turn: Vector3, slope: Vector3, curl: Vector3) -> Vector3 {
    if only_axis(g, turn).is_some() {
        return curl;
    }
    let factor = factor(g, turn);
    let part = |g: &mut Graph, slope: Vector3| {
        let across = turn.cross(g, slope);
        let half = Vector3(across.0.map(|value| g.scale(0.5, value)));
        slope.sub(g, half).scale(g, factor)
    };
    let (bent, change) = (part(g, slope), part(g, curl));
    // f' = -f^2 turn . slope / 2
    let along = turn.dot(g, slope);
    let half = g.scale(0.5, factor);
    let shrinking = g.mul(half, along);
    let lost = bent.scale(g, shrinking);
    change.sub(g, lost)
}

/// Twist rate and curvatures along the axes of a section, times the length: the slope of its angle, or if it has turned
/// by a Rodrigues vector, `f (slope - turn x slope / 2)`.
pub(crate) fn bend(g: &mut Graph, turn: Vector3, slope: Vector3) -> Vector3 {
    if only_axis(g, turn).is_some() {
        return slope;
    }
    let factor = factor(g, turn);
    let across = turn.cross(g, slope);
    let half = Vector3(across.0.map(|value| g.scale(0.5, value)));
    slope.sub(g, half).scale(g, factor)
}
