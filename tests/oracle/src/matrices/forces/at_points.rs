//! Elements at one point.

use super::{Efforts, Moving};
use crate::matrices::space::Vector;
use crate::matrices::{Oracle, Scalar};

impl Oracle<'_> {
    /// A force and a moment, with components along the axes of the ground or of the point.
    pub(super) fn load<D: Scalar>(
        &self,
        efforts: &mut Efforts<D>,
        moving: &Moving<D>,
        point: usize,
        wrench: [Vector<D>; 2],
        following: bool,
    ) {
        let (frame, at) = (self.frame_of(point), self.point(moving, point));
        let [force, moment] =
            wrench.map(|vector| if following { at.rotation.now() * vector } else { self.in_ground(vector) });
        efforts.push(frame, force, at.origin.now());
        efforts.turn(frame, moment);
    }

    /// `F = -c v` and `M = -ct omega`, with `[omega]x = Rdot R^T`.
    pub(super) fn drag<D: Scalar>(
        &self,
        efforts: &mut Efforts<D>,
        moving: &Moving<D>,
        point: usize,
        [damping, turning_damping]: [D; 2],
    ) {
        let (frame, at) = (self.frame_of(point), self.point(moving, point));
        let spin = (at.rotation.rate() * at.rotation.now().transpose()).vee();
        efforts.push(frame, at.origin.rate().scaled(-damping), at.origin.now());
        efforts.turn(frame, spin.scaled(-turning_damping));
    }
}
