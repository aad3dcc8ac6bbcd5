//! Superelements in axes that turn at a constant speed: what their mass adds there.
//!
//! With the velocity `u' + W (r + u)` of each node, `W` the matrix of the speed's cross product, Lagrange's equations have
//! `2 W u'` and `-W^T W (r + u)` beside the acceleration, each weighted with the mass between two nodes.

use std::rc::Rc;

use proc_macro2::Ident;

use super::super::resolver::Resolver;
use super::declared::{Declared, MOTIONS, Share, Square};
use crate::base::span::Extent;
use crate::model::expression::{Expr, Vector};
use crate::model::mechanism::{Frame, Joint, Motion, StepMotion};
use crate::model::simplify::{dot, multiply, negate, power_integer, subtract};

/// Mass in other directions than it moves, as a part of the greatest: files have some seven digits.
const ROUNDED: f64 = 1e-6;

/// The turning of what a superelement stands on.
pub(super) struct Spin {
    /// A unit vector, and a place on it.
    axis: Vector,
    place: Vector,
    /// rad/s.
    speed: Expr,
}

impl Spin {
    /// The centrifugal acceleration of a place.
    pub(super) fn outwards(&self, place: &Vector) -> Vector {
        let arm: Vector = [0, 1, 2].map(|k| subtract(place[k].clone(), self.place[k].clone()));
        let along = dot(&self.axis, &arm);
        let square = power_integer(self.speed.clone(), 2);
        let across = |k: usize| subtract(arm[k].clone(), multiply(along.clone(), self.axis[k].clone()));
        [0, 1, 2].map(|k| multiply(square.clone(), across(k)))
    }

    /// The axis, if it is the same in all designs.
    fn numbers(&self) -> Option<[f64; 3]> {
        let number = |x: &Expr| if let Expr::Number(x) = x { Some(*x) } else { None };
        let [x, y, z] = self.axis.each_ref().map(number);
        Some([x?, y?, z?])
    }

    /// The matrix of the speed's cross product, as matrices with factors.
    fn cross(&self) -> Vec<(Expr, [[f64; 3]; 3])> {
        let of = |[x, y, z]: [f64; 3]| [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        if let Some(axis) = self.numbers() {
            return vec![(Expr::Number(1.0), of(axis))];
        }
        let unit = |k: usize| std::array::from_fn(|j| f64::from(u8::from(j == k)));
        (0..3).map(|k| (self.axis[k].clone(), of(unit(k)))).collect()
    }

    /// What is left of a vector without its part along the axis, the same.
    fn across(&self) -> Vec<(Expr, [[f64; 3]; 3])> {
        let one = |is: bool| f64::from(u8::from(is));
        if let Some(axis) = self.numbers() {
            let of = |a: usize, b: usize| one(a == b) - axis[a] * axis[b];
            return vec![(Expr::Number(1.0), std::array::from_fn(|a| std::array::from_fn(|b| of(a, b))))];
        }
        let identity = std::array::from_fn(|a| std::array::from_fn(|b| one(a == b)));
        let pair = |k: usize, l: usize| {
            let of = |a: usize, b: usize| one((a, b) == (k, l) || (a, b) == (l, k));
            let product = multiply(self.axis[k].clone(), self.axis[l].clone());
            (negate(product), std::array::from_fn(|a| std::array::from_fn(|b| of(a, b))))
        };
        let pairs = (0..3).flat_map(|k| (k..3).map(move |l| (k, l)));
        [(Expr::Number(1.0), identity)].into_iter().chain(pairs.map(|(k, l)| pair(k, l))).collect()
    }
}

impl Resolver<'_> {
    /// How a body turns that is driven at a constant speed about an axis of the ground, along which gravity acts.
    pub(super) fn spin(
        &mut self,
        name: &Ident,
        base: Frame,
        at: Extent,
        joints: &[Joint],
        gravity: &Vector,
    ) -> Option<Spin> {
        let plain = |joint: &&Joint| {
            joint.from == Frame::Ground
                && joint.from_placement.rotations.is_empty()
                && joint.to_placement.rotations.is_empty()
        };
        let joint = joints.iter().filter(|joint| joint.to == base && joint.closing.is_some()).find(plain);
        let driven = joint.and_then(|joint| {
            let [step] = &joint.steps[..] else { return None };
            let Motion::Driven(speed) = &self.declared_coordinates[step.coordinate.index()].motion else { return None };
            (step.motion == StepMotion::Turn)
                .then(|| (step.axis.clone(), speed.clone(), joint.to_placement.offset.clone()))
        });
        let Some((axis, speed, place)) = driven else {
            let message =
                format!("`{name}` stands on a body that does not turn at a constant speed about an axis of the ground");
            let help = "carry the body by a joint as `joint drive: revolute(z) from ground to hub, driven at omega;`";
            self.diagnostics.error_with_help(at, message, help);
            return None;
        };
        let along = dot(&axis, gravity);
        let across = [0, 1, 2].map(|k| subtract(gravity[k].clone(), multiply(along.clone(), axis[k].clone())));
        let turns = axis.iter().any(|part| !matches!(part, Expr::Number(_)));
        let acts = gravity.iter().any(|part| self.nominal_of(part) != 0.0);
        if turns && acts || across.iter().any(|part| self.nominal_of(part).abs() > ROUNDED) {
            let message = format!("gravity turns in the axes of `{name}`, once in each revolution");
            let help = "let it act along the axis, or leave it out: what is linear has the same modes without it";
            self.diagnostics.error_with_help(at, message, help);
            return None;
        }
        Some(Spin { axis, place, speed })
    }

    /// With what its mass adds in axes that turn, unless its gyroscopic forces are given with all else that grows with the speed.
    pub(super) fn spun(&mut self, name: &Ident, declared: &Declared, spin: &Spin) -> Option<Declared> {
        let mut spun = declared.clone();
        if !declared.damping[1].is_empty() {
            return Some(spun);
        }
        let [cross, across] = [spin.cross(), spin.across()];
        for Share { factor, matrix, .. } in &declared.mass {
            if !is_of_nodes(declared, matrix) {
                let message = format!(
                    "the mass of `{name}` is not that of nodes without turns: what it does in axes that turn is not known from it"
                );
                let help = "give matrices at 1 rad/s, those of Coriolis's forces and of all stiffness that grows with the speed: \
                            `gyroscopic: [[\"coriolis.mtx\", omega]], stiffness: [\"k.mtx\", [\"stiffening.mtx\", omega^2], [\"centrifugal.mtx\", -omega^2]]`";
                self.diagnostics.error_with_help(name, message, help);
                return None;
            }
            let of_pair = |[i, j]: [usize; 2]| matrix.mean(MOTIONS * i, MOTIONS * j);
            let twice = multiply(Expr::Number(2.0), multiply(factor.clone(), spin.speed.clone()));
            let square = negate(multiply(factor.clone(), power_integer(spin.speed.clone(), 2)));
            for (part, cross) in &cross {
                let coriolis = Square::of_nodes(matrix.order, -1.0, |nodes, [a, b]| of_pair(nodes) * cross[a][b]);
                let factor = multiply(twice.clone(), part.clone());
                spun.damping[1].push(Share { factor, matrix: Rc::new(coriolis), grows: false });
            }
            for (part, across) in &across {
                let softening = Square::of_nodes(matrix.order, 1.0, |nodes, [a, b]| of_pair(nodes) * across[a][b]);
                let factor = multiply(square.clone(), part.clone());
                spun.stiffness.push(Share { factor, matrix: Rc::new(softening), grows: true });
            }
        }
        Some(spun)
    }
}

/// Whether nodes move in three directions, each with the same mass, and nothing else moves.
fn is_of_nodes(declared: &Declared, mass: &Square) -> bool {
    let order = MOTIONS * declared.stations.len();
    let greatest = (0..mass.order).map(|row| mass.entry(row, row)).fold(0.0, f64::max);
    let is_right = |row: usize, column: usize| {
        let [i, j] = [row, column].map(|k| (k / MOTIONS, k % MOTIONS));
        let expected = if i.1 == j.1 && i.1 < 3 { mass.mean(MOTIONS * i.0, MOTIONS * j.0) } else { 0.0 };
        (mass.mean(row, column) - expected).abs() <= ROUNDED.max(mass.rounding) * greatest
    };
    mass.order == order && (0..order).all(|row| (0..order).all(|column| is_right(row, column)))
}
