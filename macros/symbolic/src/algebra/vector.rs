//! Vectors and matrices of expressions in three dimensions.

use super::graph::Graph;
use crate::base::census::taken;
use crate::base::ids::ExprId;
use crate::base::operators::Unary;

/// Three components in one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vector3(pub [ExprId; 3]);

impl Vector3 {
    /// The zero vector.
    pub fn zero(g: &mut Graph) -> Self {
        Self([g.zero(); 3])
    }

    /// Whether every component is the constant zero.
    pub fn is_zero(self, g: &Graph) -> bool {
        self.0.iter().all(|&x| g.is(x, 0.0))
    }

    /// The frame axis that it is a unit vector along. The test is exact: the sine of nearly a right angle rounds to
    /// one, but its cosine is not zero.
    fn unit(self, g: &Graph) -> Option<usize> {
        let along = |k: usize| g.is(self.0[k], 1.0) || g.is(self.0[k], -1.0);
        let across = |k: usize| g.is(self.0[(k + 1) % 3], 0.0) && g.is(self.0[(k + 2) % 3], 0.0);
        (0..3).find(|&k| along(k) && across(k))
    }

    /// Component-wise combination.
    fn zip(self, other: Self, mut f: impl FnMut(ExprId, ExprId) -> ExprId) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// `self + other`.
    pub fn add(self, g: &mut Graph, other: Self) -> Self {
        self.zip(other, |a, b| g.add(a, b))
    }

    /// `self - other`.
    pub fn sub(self, g: &mut Graph, other: Self) -> Self {
        self.zip(other, |a, b| g.sub(a, b))
    }

    /// `-self`.
    pub fn neg(self, g: &mut Graph) -> Self {
        Self(self.0.map(|x| g.neg(x)))
    }

    /// `factor * self`.
    pub fn scale(self, g: &mut Graph, factor: ExprId) -> Self {
        Self(self.0.map(|x| g.mul(factor, x)))
    }

    /// `self . other`.
    pub fn dot(self, g: &mut Graph, other: Self) -> ExprId {
        let terms: [ExprId; 3] = std::array::from_fn(|i| g.mul(self.0[i], other.0[i]));
        g.sum(terms)
    }

    /// `self x other`.
    pub fn cross(self, g: &mut Graph, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        let mut minor = |p, q, r, s| {
            let (left, right) = (g.mul(p, q), g.mul(r, s));
            g.sub(left, right)
        };
        Self([minor(b, z, c, y), minor(c, x, a, z), minor(a, y, b, x)])
    }

    /// Length.
    pub fn norm(self, g: &mut Graph) -> ExprId {
        let square = self.dot(g, self);
        g.unary(Unary::Sqrt, square)
    }

    /// Names the three components `name_x`, `name_y`, `name_z`.
    pub fn set_name(self, g: &mut Graph, name: &str) -> Self {
        for (component, axis) in self.0.into_iter().zip(["x", "y", "z"]) {
            g.set_name(component, || format!("{name}_{axis}"));
        }
        self
    }
}

/// A matrix by columns: for a rotation `R_AB`, the axes of B expressed in A.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix3(pub [Vector3; 3]);

impl Matrix3 {
    /// The identity.
    pub fn identity(g: &mut Graph) -> Self {
        let (zero, one) = (g.zero(), g.constant(1.0));
        Self(std::array::from_fn(|j| Vector3(std::array::from_fn(|i| if i == j { one } else { zero }))))
    }

    /// `self v`.
    pub fn apply(self, g: &mut Graph, v: Vector3) -> Vector3 {
        let terms: [Vector3; 3] = std::array::from_fn(|j| self.0[j].scale(g, v.0[j]));
        terms[0].add(g, terms[1]).add(g, terms[2])
    }

    /// `self other`.
    pub fn multiply(self, g: &mut Graph, other: Self) -> Self {
        Self(other.0.map(|column| self.apply(g, column)))
    }

    /// `self s self^T` for a rotation and a symmetric matrix; the result is symmetric.
    ///
    /// A rotation about an axis, possibly with right angles before and after, turns the perpendicular plane by rows
    /// `(p, q)` and `sign (-q, p)`: with `v = p (s11 - s22) + 2 q s12` the plane becomes
    /// `[s22 + p v, sign (s12 - q v)]`, `[sign (s12 - q v), s11 - p v]`.
    pub fn turn_symmetric(self, g: &mut Graph, s: [[ExprId; 3]; 3]) -> [[ExprId; 3]; 3] {
        let entry = |i: usize, j: usize| self.0[j].0[i];
        let mut turned = s;
        let mut set = |i: usize, j: usize, value: ExprId| {
            (turned[i][j], turned[j][i]) = (value, value);
        };
        let Some(plane) = self.plane(g) else {
            taken(|| "turn_symmetric: any rotation".into());
            for i in 0..3 {
                // row i of `self s`
                let row = Vector3(std::array::from_fn(|j| entry(i, j)));
                let row = Vector3(s.map(|column| row.dot(g, Vector3(column))));
                for j in i..3 {
                    let other = Vector3(std::array::from_fn(|k| entry(j, k)));
                    let value = row.dot(g, other);
                    set(i, j, value);
                }
            }
            return turned;
        };
        let Plane { rows: [r, first, second], columns: [c, a, b], mirrored } = plane;
        taken(|| format!("turn_symmetric: row {r}, column {c}, mirrored {mirrored}"));
        let axis = entry(r, c);
        let (p, q) = (entry(first, a), entry(first, b));
        let difference = g.sub(s[a][a], s[b][b]);
        let along = g.mul(p, difference);
        let twice = g.scale(2.0, s[a][b]);
        let across = g.mul(q, twice);
        let v = g.add(along, across);
        let (pv, qv) = (g.mul(p, v), g.mul(q, v));
        let (long, short) = (g.add(s[b][b], pv), g.sub(s[a][a], pv));
        let off = g.sub(s[a][b], qv);
        let off = if mirrored { g.neg(off) } else { off };
        set(first, first, long);
        set(second, second, short);
        set(first, second, off);
        set(r, r, s[c][c]);
        for row in [first, second] {
            let (x, y) = (g.mul(entry(row, a), s[a][c]), g.mul(entry(row, b), s[b][c]));
            let sum = g.add(x, y);
            let value = g.mul(axis, sum);
            set(r, row, value);
        }
        turned
    }

    /// The plane in which the rotation turns, if it is about a frame axis apart from right angles.
    fn plane(self, g: &mut Graph) -> Option<Plane> {
        let entry = |i: usize, j: usize| self.0[j].0[i];
        for c in 0..3 {
            let Some(r) = self.0[c].unit(g) else {
                continue;
            };
            let [a, b] = [(c + 1) % 3, (c + 2) % 3];
            let [first, second] = [(r + 1) % 3, (r + 2) % 3];
            if ![a, b].iter().all(|&other| g.is(entry(r, other), 0.0)) {
                continue;
            }
            let (p, q) = (entry(first, a), entry(first, b));
            let (minus_p, minus_q) = (g.neg(p), g.neg(q));
            let turned = (entry(second, a), entry(second, b));
            let mirrored = if turned == (minus_q, p) {
                false
            } else if turned == (q, minus_p) {
                true
            } else {
                return None;
            };
            return Some(Plane { rows: [r, first, second], columns: [c, a, b], mirrored });
        }
        None
    }

    /// The transpose, which is the inverse of a rotation.
    pub fn transpose(self) -> Self {
        Self(std::array::from_fn(|j| Vector3(std::array::from_fn(|i| self.0[i].0[j]))))
    }

    /// Rotation by `angle` about the unit vector `axis` (Rodrigues).
    pub fn rotation(g: &mut Graph, axis: Vector3, angle: ExprId) -> Self {
        let (sine, cosine) = (g.unary(Unary::Sin, angle), g.unary(Unary::Cos, angle));
        let one = g.constant(1.0);
        let versine = g.sub(one, cosine);
        let identity = Self::identity(g);
        let along = axis.unit(g);
        Self(std::array::from_fn(|j| {
            // Along a coordinate axis the general form would leave cos + (1 - cos) unsimplified.
            if along == Some(j) {
                return identity.0[j];
            }
            let turned = axis.cross(g, identity.0[j]).scale(g, sine);
            let kept = identity.0[j].scale(g, cosine);
            let factor = g.mul(versine, axis.0[j]);
            let along = axis.scale(g, factor);
            kept.add(g, turned).add(g, along)
        }))
    }
}

/// Rows and columns of a rotation about an axis: the axis, then the perpendicular plane.
struct Plane {
    rows: [usize; 3],
    columns: [usize; 3],
    /// Whether the plane's second row is `(q, -p)` instead of `(-q, p)`.
    mirrored: bool,
}
