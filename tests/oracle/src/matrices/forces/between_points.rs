//! Elements between two points: opposite forces on their bodies.

use num_dual::DualNum;

use super::{Efforts, Moving};
use crate::matrices::space::{Matrix, Vector};
use crate::matrices::{Oracle, Scalar};

impl Oracle<'_> {
    /// A tension, a function of the distance `d = |r|` and its rate, pulls the points together along `r / d`.
    pub(super) fn tension<D: Scalar>(
        &self,
        efforts: &mut Efforts<D>,
        moving: &Moving<D>,
        [from, to]: [usize; 2],
        law: impl Fn(D, D) -> D,
    ) {
        let (start, end) = (self.point(moving, from), self.point(moving, to));
        let span = end.origin - start.origin;
        let distance = span.dot(span).sqrt();
        let tension = law(distance.re, distance.eps);
        let pull = span.now().scaled(tension / distance.re);
        efforts.push(self.frame_of(from), pull, start.origin.now());
        efforts.push(self.frame_of(to), Vector::zero() - pull, end.origin.now());
    }

    /// Along the axes of `from`: `d = R_from^T (p_to - p_from)`, `R = R_from^T R_to`, `r = vee((R - R^T) / 2)`; the
    /// force `-k d - c d'` and the moment `-kr r - cr r'` on `to`, the opposite at the same place on `from`.
    pub(super) fn bushing<D: Scalar>(
        &self,
        efforts: &mut Efforts<D>,
        moving: &Moving<D>,
        [from, to]: [usize; 2],
        [stiffness, damping]: [Matrix<D>; 2],
        [turning_stiffness, turning_damping]: [Matrix<D>; 2],
    ) {
        let (start, end) = (self.point(moving, from), self.point(moving, to));
        let relative = start.inverse() * end;
        let (d, r) = (relative.origin, relative.rotation.vee());
        let along_from = |vector| start.rotation.now() * vector;
        let force = along_from(Vector::zero() - stiffness * d.now() - damping * d.rate());
        let moment = along_from(Vector::zero() - turning_stiffness * r.now() - turning_damping * r.rate());
        let (here, there) = (self.frame_of(to), self.frame_of(from));
        let place = end.origin.now();
        efforts.push(here, force, place);
        efforts.turn(here, moment);
        efforts.push(there, Vector::zero() - force, place);
        efforts.turn(there, Vector::zero() - moment);
    }
}
