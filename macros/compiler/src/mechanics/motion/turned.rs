//! A vector that turns with a section, its rates and the forces on the turn, with closed forms of their derivatives.
//!
//! With the Rodrigues vector `psi`, `D = 1 + |psi|^2 / 4` and `f = 1 / D`, a vector `t` along the axes of the section is
//! `d = n / D` along those of the root, `n = (2 - D) t + psi x t + psi (psi . t) / 2`. Differentiating `D d = n` gives
//! `D d_a = n_a - d psi_a / 2` by one component and `D d_ab = n_ab - (d_a psi_b + d_b psi_a + d delta_ab) / 2` by two;
//! `n_ab` is constant.

use crate::algebra::{ExprId, Graph, Matrix3, Vector3};

use super::bend::{both, denominator};

/// A vector that turns with a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// The Rodrigues vector, with `f` and `f psi / 2`.
    turn: Vector3,
    factor: ExprId,
    half: Vector3,
    /// Along the axes of the section.
    in_section: Vector3,
    /// Along the axes of the root.
    pub(super) vector: Vector3,
    /// Derivatives by the components of the turn.
    slopes: Matrix3,
    rotation: Matrix3,
}

impl Turned {
    pub(super) fn new(g: &mut Graph, (turn, factor, rotation): (Vector3, ExprId, Matrix3), original: Vector3) -> Self {
        let half_factor = g.scale(0.5, factor);
        let half = turn.scale(g, half_factor);
        let denominator = denominator(g, turn);
        let two = g.constant(2.0);
        let straight = g.sub(two, denominator);
        let along = turn.dot(g, original);
        let along = g.scale(0.5, along);
        let (kept, across) = (original.scale(g, straight), turn.cross(g, original));
        let numerator = turn.scale(g, along).add(g, across).add(g, kept);
        let vector = Vector3(numerator.0.map(|value| g.div(value, denominator)));
        let along = half.dot(g, original);
        let sum = original.add(g, vector);
        let identity = Matrix3::identity(g);
        let slopes = Matrix3([0, 1, 2].map(|a| {
            let axis = identity.0[a];
            let grown = half.scale(g, original.0[a]);
            let kept = axis.scale(g, along).add(g, grown);
            let lost = sum.scale(g, half.0[a]);
            let crossed = axis.cross(g, original).scale(g, factor);
            kept.add(g, crossed).sub(g, lost)
        }));
        for (c, &value) in vector.0.iter().enumerate() {
            let by_turn = turn.0.into_iter().zip(slopes.0);
            g.set_slopes(
                value,
                by_turn.chain(original.0.into_iter().zip(rotation.0)).map(|(by, slope)| (by, slope.0[c])).collect(),
            );
        }
        Self { turn, factor, half, in_section: original, vector, slopes, rotation }
    }

    /// The rate of the vector while the turn changes at a rate.
    pub(super) fn rate(&self, g: &mut Graph, rate: Vector3) -> Vector3 {
        self.slopes.apply(g, rate)
    }

    /// The part of its second rate that is quadratic in the rate of the turn.
    pub(super) fn quadratic(&self, g: &mut Graph, rate: Vector3) -> Vector3 {
        let (projection, along) = (rate.dot(g, self.in_section), rate.dot(g, self.turn));
        let square = rate.dot(g, rate);
        let half = g.scale(0.5, square);
        let spread = self.in_section.add(g, self.vector).scale(g, half);
        let slowed = self.rate(g, rate).scale(g, along);
        rate.scale(g, projection).sub(g, spread).sub(g, slowed).scale(g, self.factor)
    }

    /// Power of a force on the vector per unit rate of each component of the turn, and the force along the axes of the
    /// section.
    pub(super) fn powers(&self, g: &mut Graph, force: Vector3) -> ([ExprId; 3], Vector3) {
        let back = (self.turn.neg(g), self.factor, self.rotation.transpose());
        let back = Self::new(g, back, force);
        let powers = self.slopes.0.map(|slope| slope.dot(g, force));
        let (projection, all) = (self.in_section.dot(g, force), self.vector.dot(g, force));
        let half = g.scale(0.5, self.factor);
        let sum = g.add(projection, all);
        let sum = g.mul(half, sum);
        let scaled = force.scale(g, half);
        let mut curved = |a: usize, b: usize| {
            let lost = both(g, &powers, &self.half.0, a, b);
            let kept = both(g, &scaled.0, &self.in_section.0, a, b);
            let curved = g.sub(kept, lost);
            if a == b { g.sub(curved, sum) } else { curved }
        };
        // equal entries must be one node
        let curved = [0, 1, 2].map(|a| [0, 1, 2].map(|b| curved(b.min(a), b.max(a))));
        for (a, &power) in powers.iter().enumerate() {
            let by_section = back.slopes.0[a].neg(g);
            let by_force = force.0.into_iter().zip(self.slopes.0[a].0);
            let by_turn = self.turn.0.into_iter().zip(curved[a]);
            let by_section = self.in_section.0.into_iter().zip(by_section.0);
            g.set_slopes(power, by_force.chain(by_turn).chain(by_section).collect());
        }
        (powers, back.vector)
    }
}
