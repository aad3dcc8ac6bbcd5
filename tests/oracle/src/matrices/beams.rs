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
    let psi = axes.fold(Vector::zero(), |sum, (&axis, turn)| sum + Vector::constant(axis).scaled(turn));
    let [x, y, z] = psi.0;
    let o = D::zero();
    let s = Matrix([[o, -z, y], [z, o, -x], [-y, x, o]]);
    Matrix::identity() + (s + (s * s).scaled(D::from(0.5))).scaled(factor(psi))
}

/// `1 / (1 + psi . psi / 4)`.
fn factor<D: Scalar>(psi: Vector<D>) -> D {
    (psi.dot(psi) * 0.25 + 1.0).recip()
}

/// The rotation from the root to a place of the unloaded beam, along the axes of the root.
fn curved<D: Scalar>(beam: &Beam, place: f64, design: &[D]) -> Matrix<D> {
    let [second, third] = beam.prebend.about;
    let [root, tip] = beam.prebend.angles.map(|angle| value(angle, design));
    rotation([0.0, second, third], root * (1.0 - place) + tip * place)
}

/// The pose of a section in the frame of the root: `r = L integral R A t`, with the rotation `A` of the arc and the direction
/// `t = (1 + e - |g|^2 / 2, g2, g3)` along the axes of the section.
fn section<D: Scalar>(beam: &Beam, q: &[D], place: f64, design: &[D]) -> Pose<D> {
    let length = value(beam.length, design);
    let points = beam.sections.iter().zip(beam.weights_to(place));
    let mean = points.fold(Vector::zero(), |sum, (item, weight)| {
        let Vector([stretch, second, third]) = strain(beam, q, item, design);
        let shortening = (second * second + third * third) * 0.5;
        let heading = Vector([stretch + 1.0 - shortening, second, third]);
        let heading = curved(beam, item.place, design) * heading;
        let axes = beam.axes.iter().zip(heading.0);
        let direction = axes.fold(Vector::zero(), |sum, (&axis, item)| sum + Vector::constant(axis).scaled(item));
        let direction = turned(beam, beam.turn(q, item.place)) * direction;
        sum + direction.scaled(D::from(weight))
    });
    Pose { rotation: turned(beam, beam.turn(q, place)), origin: mean.scaled(length) }
}

/// Twist and curvatures along the axes of the beam: `f (psi' - psi x psi' / 2) / L`; in a plane, the slope of the
/// angle.
fn curvature<D: Scalar>(beam: &Beam, psi: Vector<D>, slope: Vector<D>, length: D) -> Vector<D> {
    let strain = match beam.plane() {
        Some(_) => slope,
        None => (slope - psi.cross(slope).scaled(D::from(0.5))).scaled(factor(psi)),
    };
    strain.scaled(length.recip())
}

fn curvature_at<D: Scalar>(beam: &Beam, q: &[D], value: f64, length: D) -> Vector<D> {
    let [psi, slope] = [beam.turn(q, value), beam.slope(q, value)];
    curvature(beam, Vector(psi), Vector(slope), length)
}

/// Stretch and shear along the axes of the beam: coordinates, or shear as in statics,
/// `g = (kGA)^-1 (-(D kappa)3', (D kappa)2') / L`. The stiffness `D` between the points of quadrature is the polynomial
/// through its values there.
fn strain<D: Scalar>(beam: &Beam, q: &[D], section: &Section, design: &[D]) -> Vector<D> {
    let coordinates = beam.strain(q, section.place);
    if !beam.static_shear {
        return Vector(coordinates);
    }
    let length = value(beam.length, design);
    let [psi, slope, curl] = [beam.turn(q, section.place), beam.slope(q, section.place), beam.curl(q, section.place)];
    let advanced = |at: [D; 3], by: [D; 3]| Vector([0, 1, 2].map(|i| Dual::new(at[i], by[i])));
    let kappa = curvature(beam, advanced(psi, slope), advanced(slope, curl), Dual::from_re(length));
    let points = beam.sections.iter().zip(beam.slopes_at(section.place));
    let growth = points.fold(Matrix::constant([[0.0; 3]; 3]), |sum, (other, share)| {
        sum + stiffness(beam, other, BENDING, design).scaled(D::from(share))
    });
    let bending = stiffness(beam, section, BENDING, design);
    let change = bending * kappa.rate() + growth * kappa.now();
    let Vector([_, about_second, about_third]) = change.scaled(length.recip());
    let force = Vector([D::zero(), -about_third, about_second]);
    let [shear_second, shear_third] = [1, 2].map(|k| value(section.stiffness[k][k], design));
    // what has no stiffness is not to shear
    let compliance = |stiffness: D| match stiffness.re() {
        0.0 => stiffness,
        _ => stiffness.recip(),
    };
    let o = D::zero();
    let (second, third) = (compliance(shear_second), compliance(shear_third));
    let compliances = Matrix([[o, o, o], [o, second, o], [o, o, third]]);
    let shear = turned_with(beam, section, compliances, design) * force;
    Vector([coordinates[0], shear.0[1], shear.0[2]])
}

/// A tensor along the axes of an unloaded section, along those of the root: turned by the arc, and by the twist about it.
fn turned_with<D: Scalar>(beam: &Beam, section: &Section, matrix: Matrix<D>, design: &[D]) -> Matrix<D> {
    let twist = rotation([1.0, 0.0, 0.0], value(section.twist, design));
    let axes = curved(beam, section.place, design) * twist;
    axes * matrix * axes.transpose()
}

/// Where blocks of the stiffness start: of forces by stretch and shear, of forces by twist and bending, and of moments by
/// these.
const SHEARING: [usize; 2] = [0, 0];
const COUPLING: [usize; 2] = [0, 3];
const BENDING: [usize; 2] = [3, 3];

/// A block of the stiffness of a section, along the axes of the root.
fn stiffness<D: Scalar>(beam: &Beam, section: &Section, [row, column]: [usize; 2], design: &[D]) -> Matrix<D> {
    let entry = |i: usize, j: usize| value(section.stiffness[row + i][column + j], design);
    let matrix = Matrix([0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))));
    turned_with(beam, section, matrix, design)
}

impl Oracle<'_> {
    /// Whether a coordinate moves what is beyond a joint: it is one of its own, or both belong to one beam.
    pub(super) fn moves(&self, coordinate: Coordinate, joint: usize) -> bool {
        let beam = |joint: usize| self.model.joints[joint].flexure.map(|flexure| flexure.beam);
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
            Axis { origin: moved.origin.now(), spin: turn.vee(), slide: moved.origin.rate() }
        };
        let axes = (0..q.len()).map(axis).collect();
        let here = beyond(&still(&q));
        let here = Pose { rotation: here.rotation.now(), origin: here.origin.now() };
        (here, axes)
    }

    /// By coordinate of a beam, minus the work of the strain: `-L sum w (moment . dkappa/dq + force . dgamma/dq)`, with the
    /// moment `D kappa + B^T gamma`, the force `A gamma + B kappa` and in both for `kappa`
    /// `kappa + lag (kappadot - spin e1 x kappa)`, and the same for stretch and shear `gamma`, all along the axes of the
    /// root as they turn.
    pub(super) fn elastic<D: Scalar>(&self, beam: &Beam, moving: &Moving<D>) -> Vec<(Coordinate, D)> {
        let design = &moving.state.design;
        let (length, lag) = (value(beam.length, design), value(beam.lag, design));
        let (driven, drives) = moving.driven;
        let q = self.of_beam(beam, &moving.state.position, driven);
        let speeds = self.of_beam(beam, &moving.state.velocity, drives);
        let spin = match beam.spin {
            Some(spin) => self.coordinate(spin, &moving.state.velocity, drives),
            None => D::zero(),
        };
        let axis = Vector([spin, D::zero(), D::zero()]);
        let lagging = |strain: Vector<Dual<D>>| {
            let now = strain.now();
            now + (strain.rate() - axis.cross(now)).scaled(lag)
        };
        let fixed = still(design);
        let mut efforts = vec![D::zero(); q.len()];
        for section in &beam.sections {
            let bent = |q: &[Dual<D>]| curvature_at(beam, q, section.place, Dual::from_re(length));
            let arc = curved(beam, section.place, &fixed);
            let strained = |q: &[Dual<D>]| arc * strain(beam, q, section, &fixed);
            let now = along(&q, &speeds);
            let (kappa, gamma) = (lagging(bent(&now)), lagging(strained(&now)));
            let [shearing, coupling, bending] =
                [SHEARING, COUPLING, BENDING].map(|block| stiffness(beam, section, block, design));
            let moment = bending * kappa + coupling.transpose() * gamma;
            let force = shearing * gamma + coupling * kappa;
            for (step, effort) in efforts.iter_mut().enumerate() {
                let seeded = seeded(&q, step);
                let work = moment.dot(bent(&seeded).rate()) + force.dot(strained(&seeded).rate());
                *effort -= length * work * section.weight;
            }
        }
        let joint = beam.joint;
        let efforts = efforts.into_iter().enumerate();
        efforts.map(|(step, effort)| (Coordinate { joint, step }, effort)).collect()
    }
}
