//! Flexures of beams, and the forces of their strain.

use num_dual::Dual;

use super::bodies::value;
use super::forces::Moving;
use super::kinematics::Axis;
use super::scalar::{along, seeded, still};
use super::space::{Matrix, Pose, Vector, rotation};
use super::{Oracle, Scalar};
use crate::model::{Beam, Coordinate, Flexure, Section};

/// `R(psi) = I + f (S + S S / 2)`, `S = [psi]x`, `f = 1 / (1 + psi . psi / 4)`; about one axis, by the angle.
fn turned<D: Scalar>(beam: &Beam, turn: [D; 3]) -> Matrix<D> {
    if let Some(axis) = beam.plane() {
        return rotation(beam.axes[axis], turn[axis]);
    }
    let axes = beam.axes.iter().zip(turn);
    let psi = axes.fold(Vector::zero(), |sum, (&axis, turn)| {
        sum + Vector::constant(axis).scaled(turn)
    });
    let [x, y, z] = psi.0;
    let o = D::zero();
    let s = Matrix([[o, -z, y], [z, o, -x], [-y, x, o]]);
    Matrix::identity() + (s + (s * s).scaled(D::from(0.5))).scaled(factor(psi))
}

/// `1 / (1 + psi . psi / 4)`.
fn factor<D: Scalar>(psi: Vector<D>) -> D {
    (psi.dot(psi) * 0.25 + 1.0).recip()
}

/// The pose of a section in the frame of the root: `r = L integral R e1`.
fn section<D: Scalar>(beam: &Beam, q: &[D], place: f64, design: &[D]) -> Pose<D> {
    let first = Vector::constant(beam.axes[0]);
    let points = beam.sections.iter().zip(beam.weights_to(place));
    let mean = points.fold(Vector::zero(), |sum, (own, weight)| {
        let direction = turned(beam, beam.turn(q, own.place)) * first;
        sum + direction.scaled(D::from(weight))
    });
    Pose {
        rotation: turned(beam, beam.turn(q, place)),
        origin: mean.scaled(value(beam.length, design)),
    }
}

/// Twist and curvatures along the axes of the beam: `f (psi' - psi x psi' / 2) / L`; in a plane, the slope of the
/// angle.
fn strain<D: Scalar>(beam: &Beam, q: &[D], section: &Section, length: D) -> Vector<D> {
    let psi = Vector(beam.turn(q, section.place));
    let slope = Vector(beam.slope(q, section.place));
    let strain = match beam.plane() {
        Some(_) => slope,
        None => (slope - psi.cross(slope).scaled(D::from(0.5))).scaled(factor(psi)),
    };
    strain.scaled(length.recip())
}

/// The stiffness of a section along the axes of the beam: that along its own, turned by the twist.
fn stiffness<D: Scalar>(section: &Section, design: &[D]) -> Matrix<D> {
    let [first, second, third] = section.stiffness.map(|k| value(k, design));
    let o = D::zero();
    let own = Matrix([[first, o, o], [o, second, o], [o, o, third]]);
    let twist = rotation([1.0, 0.0, 0.0], value(section.twist, design));
    twist * own * twist.transpose()
}

impl Oracle<'_> {
    /// Whether a coordinate moves what is beyond a joint: it is one of its own, or both belong to one beam.
    pub(super) fn moves(&self, coordinate: Coordinate, joint: usize) -> bool {
        let beam = |joint: usize| self.model.joints[joint].flexure.map(|own| own.beam);
        match beam(joint) {
            None => coordinate.joint == joint,
            own => beam(coordinate.joint) == own,
        }
    }

    /// Coordinates or speeds of a beam.
    fn of_beam<D: Scalar>(&self, beam: &Beam, free: &[D], driven: &[D]) -> Vec<D> {
        let joint = beam.joint;
        let steps = 0..beam.coordinates();
        let steps = steps.map(|step| self.coordinate(Coordinate { joint, step }, free, driven));
        steps.collect()
    }

    /// The frame beyond a flexure that begins at `frame`, and what each coordinate of the beam does to it.
    pub(super) fn across<D: Scalar>(
        &self,
        flexure: Flexure,
        reversed: bool,
        frame: Pose<D>,
        [free, driven, design]: [&[D]; 3],
    ) -> (Pose<D>, Vec<Axis<D>>) {
        let beam = &self.model.beams[flexure.beam];
        let q = self.of_beam(beam, free, driven);
        let beyond = |q: &[Dual<D>]| {
            let pose = section(beam, q, flexure.place, &still(design));
            let pose = if reversed { pose.inverse() } else { pose };
            let lifted = Pose {
                rotation: Matrix(frame.rotation.0.map(|row| row.map(Dual::from_re))),
                origin: Vector(frame.origin.0.map(Dual::from_re)),
            };
            lifted * pose
        };
        let axis = |step: usize| {
            let moved = beyond(&seeded(&q, step));
            let turn = moved.rotation.rate() * moved.rotation.now().transpose();
            Axis {
                origin: moved.origin.now(),
                spin: turn.vee(),
                slide: moved.origin.rate(),
            }
        };
        let axes = (0..q.len()).map(axis).collect();
        let here = beyond(&still(&q));
        let here = Pose {
            rotation: here.rotation.now(),
            origin: here.origin.now(),
        };
        (here, axes)
    }

    /// By coordinate of a beam, minus the work that the moment `D (k + lag kdot)` does: `-L sum w moment . dk/dq`.
    pub(super) fn elastic<D: Scalar>(
        &self,
        beam: &Beam,
        moving: &Moving<D>,
    ) -> Vec<(Coordinate, D)> {
        let design = &moving.state.design;
        let (length, lag) = (value(beam.length, design), value(beam.lag, design));
        let (driven, drives) = moving.driven;
        let q = self.of_beam(beam, &moving.state.position, driven);
        let speeds = self.of_beam(beam, &moving.state.velocity, drives);
        let mut efforts = vec![D::zero(); q.len()];
        for section in &beam.sections {
            let strain = |q: &[Dual<D>]| strain(beam, q, section, Dual::from_re(length));
            let now = strain(&along(&q, &speeds));
            let strained = now.now() + now.rate().scaled(lag);
            let moment = stiffness(section, design) * strained;
            for (step, effort) in efforts.iter_mut().enumerate() {
                let change = strain(&seeded(&q, step)).rate();
                *effort -= length * moment.dot(change) * section.weight;
            }
        }
        let joint = beam.joint;
        let efforts = efforts.into_iter().enumerate();
        efforts
            .map(|(step, effort)| (Coordinate { joint, step }, effort))
            .collect()
    }
}
