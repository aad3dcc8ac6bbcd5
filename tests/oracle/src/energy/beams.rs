//! Places of sections of beams, and the energies of their strain.

use num_dual::Dual;

use super::poses::{Four, Poses, get, index, lift, multiply, quaternion, quaternion_rotation, translation, transpose};
use crate::matrices::Scalar;
use crate::model::{Beam, Coordinate, Model, Section};

/// The frame of a section in that of the root: turned, and moved along the integral of the direction of the beam.
pub(super) fn section<D: Scalar>(beam: &Beam, q: &[D], value: f64, design: &[D]) -> Four<D> {
    let length = get(beam.length, design);
    let mut position = [D::zero(); 3];
    let points = beam.sections.iter().zip(beam.weights_to(value));
    for (k, (own, weight)) in points.enumerate() {
        let unloaded = unloaded(beam, D::from(own.place), design);
        let turned = multiply(&rotation(beam, beam.turn(q, own.place)), &unloaded);
        let heading = heading(beam, q, k, design);
        let direction: [D; 3] = std::array::from_fn(|i| (0..3).map(|c| heading[c] * beam.axes[c][i]).sum());
        for (sum, row) in position.iter_mut().zip(&turned) {
            for (entry, component) in row.iter().zip(direction) {
                *sum += length * *entry * component * weight;
            }
        }
    }
    let turned = rotation(beam, beam.turn(q, value));
    multiply(&translation(position), &turned)
}

/// The rotation of the axes of the beam from the root to a place along the arc.
fn unloaded<D: Scalar>(beam: &Beam, place: D, design: &[D]) -> Four<D> {
    let [second, third] = beam.prebend.about;
    let about = [0, 1, 2].map(|i| second * beam.axes[1][i] + third * beam.axes[2][i]);
    let [root, tip] = beam.prebend.angles.map(|angle| get(angle, design));
    quaternion_rotation(about, root + (tip - root) * place)
}

/// The direction of the beam along the axes of a section: `(1 + e - |g|^2 / 2, g2, g3)`.
fn heading<D: Scalar>(beam: &Beam, q: &[D], k: usize, design: &[D]) -> [D; 3] {
    let [stretch, second, third] = stretch_and_shear(beam, q, k, design);
    let shortening = (second * second + third * third) * 0.5;
    [stretch + 1.0 - shortening, second, third]
}

/// Stretch, and shear along the second and the third axis of the beam, at a point of quadrature.
fn stretch_and_shear<D: Scalar>(beam: &Beam, q: &[D], k: usize, design: &[D]) -> [D; 3] {
    let section = &beam.sections[k];
    let own = beam.strain(q, section.place);
    if !beam.static_shear {
        return own;
    }
    let length = get(beam.length, design);
    let bent = curvature(beam, q, section.place, design);
    let [now, change] = [bent.map(|bent| bent.re), bent.map(|bent| bent.eps)];
    // the derivative of D k, with D between the points of quadrature the polynomial through its values there
    let mut moment = moments(section, change, design);
    for (other, share) in beam.sections.iter().zip(beam.slopes_at(section.place)) {
        for (sum, part) in moment.iter_mut().zip(moments(other, now, design)) {
            *sum += part * share;
        }
    }
    // shear forces are the change of the moments, (-M3', M2'); what has no stiffness is not to shear
    let force = [-moment[1] / length, moment[0] / length];
    let twist = get(section.twist, design);
    let mut own_shear = turned_back(force, twist);
    for (along, shear) in (1..).zip(&mut own_shear) {
        let stiffness = get(section.stiffness[along][along], design);
        *shear = match stiffness.re() {
            0.0 => D::zero(),
            _ => *shear / stiffness,
        };
    }
    let [second, third] = turned_back(own_shear, -twist);
    [own[0], second, third]
}

/// Bending moments about the second and the third axis of the beam.
fn moments<D: Scalar>(section: &Section, bent: [D; 3], design: &[D]) -> [D; 2] {
    let twist = get(section.twist, design);
    let [second, third] = turned_back([bent[1], bent[2]], twist);
    let [about_second, about_third] = [4, 5].map(|k| get(section.stiffness[k][k], design));
    turned_back([about_second * second, about_third * third], -twist)
}

/// Components along axes that are turned by an angle.
fn turned_back<D: Scalar>([second, third]: [D; 2], angle: D) -> [D; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * second + sine * third, cosine * third - sine * second]
}

/// Rotation by an angle in a plane; in space by the quaternion `(1, turn / 2)` over its norm.
fn rotation<D: Scalar>(beam: &Beam, turn: [D; 3]) -> Four<D> {
    let [w, x, y, z] = match beam.plane() {
        Some(axis) => {
            let half = turn[axis] * 0.5;
            let vector = beam.axes[axis].map(|component| half.sin() * component);
            [half.cos(), vector[0], vector[1], vector[2]]
        }
        None => {
            let component = |i: usize| -> D { (0..3).map(|k| turn[k] * beam.axes[k][i]).sum() };
            let half = [0, 1, 2].map(|i| component(i) * 0.5);
            let square: D = half.iter().map(|&x| x * x).sum();
            let norm = (square + 1.0).sqrt();
            let [x, y, z] = half.map(|x| x / norm);
            [norm.recip(), x, y, z]
        }
    };
    quaternion(w, [x, y, z])
}

/// `1/2 e . C e` per unit of length, summed over all beams, of any six numbers `e` per section along its own axes, with the
/// stiffness `C`.
fn half_forms<D: Scalar>(poses: &Poses<D>, factor: impl Fn(&Beam) -> D, strain: impl Fn(&Beam, usize) -> [D; 6]) -> D {
    let mut total = D::zero();
    for beam in &poses.model.beams {
        let length = get(beam.length, &poses.design);
        for (k, section) in beam.sections.iter().enumerate() {
            let strain = strain(beam, k);
            let mut form = D::zero();
            for (row, one) in section.stiffness.iter().zip(strain) {
                for (stiffness, other) in row.iter().zip(strain) {
                    form += get(*stiffness, &poses.design) * one * other;
                }
            }
            total += factor(beam) * length * form * (0.5 * section.weight);
        }
    }
    total
}

/// The energy of the strain.
pub(super) fn elastic<D: Scalar>(poses: &Poses<D>) -> D {
    half_forms(poses, |_| D::one(), |beam, k| strain(poses, beam, k))
}

/// Rayleigh's dissipation function of the lag: the same form of the rates of strain, times the lag. The axes along which
/// strain is taken turn with the material, so that a spinning beam dissipates what its material feels.
pub(super) fn dissipated<D: Scalar>(poses: &Poses<D>, moving: &Poses<Dual<D>>) -> D {
    half_forms(poses, |beam| get(beam.lag, &poses.design), |beam, k| strain(moving, beam, k).map(|strain| strain.eps))
}

/// Stretch and shear, twist and bending along the axes of the material.
fn strain<D: Scalar>(poses: &Poses<D>, beam: &Beam, k: usize) -> [D; 6] {
    let section = &beam.sections[k];
    let q = of_beam(poses.model, beam, &poses.coordinates);
    let bent = curvature(beam, q, section.place, &poses.design).map(|x| x.re);
    let strained = stretch_and_shear(beam, q, k, &poses.design);
    let mut angle = get(section.twist, &poses.design);
    if let Some(spin) = beam.spin {
        angle += poses.coordinate(spin);
    }
    let [second, third] = turned_back([bent[1], bent[2]], angle);
    let [shear_second, shear_third] = turned_back([strained[1], strained[2]], angle);
    [strained[0], shear_second, shear_third, bent[0], second, third]
}

/// Twist and bending along the axes of the beam as they turn with the section, and their derivatives by the place as a
/// fraction of the length: what `[k]x = T^T dT/ds` has grown by since `T` was the arc without load. The twist before bending
/// is left out of `T`: its own rate is not strain.
fn curvature<D: Scalar>(beam: &Beam, q: &[D], value: f64, design: &[D]) -> [Dual<D>; 3] {
    let (turn, slope) = (beam.turn(q, value), beam.slope(q, value));
    let curl = beam.curl(q, value);
    let along: [Dual<Dual<D>>; 3] =
        std::array::from_fn(|k| Dual::new(Dual::new(turn[k], slope[k]), Dual::new(slope[k], curl[k])));
    let here = Dual::new(D::from(value), D::one());
    let arc = unloaded(beam, Dual::new(here, Dual::from_re(D::one())), &lift(&lift(design)));
    let turned = multiply(&rotation(beam, along), &arc);
    let length = Dual::from_re(get(beam.length, design));
    let [loaded, before] = [turned, arc].map(|pose| spin(&pose));
    beam.axes.map(|axis| {
        let grown = loaded.iter().zip(before).zip(axis);
        let components = grown.map(|((&now, before), a)| (now - before) * a);
        components.sum::<Dual<D>>() / length
    })
}

/// `v` of `[v]x = R^T R'`.
fn spin<D: Scalar>(rotation: &Four<Dual<D>>) -> [D; 3] {
    let now = rotation.map(|row| row.map(|entry| entry.re));
    let change = rotation.map(|row| row.map(|entry| entry.eps));
    let spin = multiply(&transpose(&now), &change);
    [spin[2][1], spin[0][2], spin[1][0]]
}

/// The coordinates of a beam among all.
pub(super) fn of_beam<'a, D>(model: &Model, beam: &Beam, coordinates: &'a [D]) -> &'a [D] {
    let first = Coordinate { joint: beam.joint, step: 0 };
    let start = index(&model.coordinates(), first);
    &coordinates[start..start + beam.coordinates()]
}
