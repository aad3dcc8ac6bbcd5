//! Places of sections of beams, and the energies of their strain.

use num_dual::Dual;

use super::poses::{Four, Poses, get, index, multiply, quaternion, translation, transpose};
use crate::matrices::Scalar;
use crate::model::{Beam, Coordinate, Model, Section};

/// The frame of a section in that of the root: turned, and moved along the integral of the turned axis of the beam.
pub(super) fn section<D: Scalar>(beam: &Beam, q: &[D], place: f64, design: &[D]) -> Four<D> {
    let length = get(beam.length, design);
    let mut position = [D::zero(); 3];
    for (own, weight) in beam.sections.iter().zip(beam.weights_to(place)) {
        let turned = rotation(beam, beam.turn(q, own.place));
        for (row, sum) in position.iter_mut().enumerate() {
            for (entry, component) in turned[row].iter().zip(beam.axes[0]) {
                *sum += length * *entry * (component * weight);
            }
        }
    }
    let turned = rotation(beam, beam.turn(q, place));
    multiply(&translation(position), &turned)
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

/// `1/2 k . D k` per unit of length, summed over all beams, of any three numbers `k` per section along its own axes.
fn half_forms<D: Scalar>(
    poses: &Poses<D>,
    factor: impl Fn(&Beam) -> D,
    strain: impl Fn(&Beam, &Section) -> [D; 3],
) -> D {
    let mut total = D::zero();
    for beam in &poses.model.beams {
        let length = get(beam.length, &poses.design);
        for section in &beam.sections {
            let form: D = strain(beam, section)
                .iter()
                .zip(section.stiffness)
                .map(|(&k, stiffness)| get(stiffness, &poses.design) * k * k)
                .sum();
            total += factor(beam) * length * form * (0.5 * section.weight);
        }
    }
    total
}

/// The energy of the strain.
pub(super) fn elastic<D: Scalar>(poses: &Poses<D>) -> D {
    half_forms(
        poses,
        |_| D::one(),
        |beam, section| strain(poses, beam, section),
    )
}

/// Rayleigh's dissipation function of the lag: the same form of the rates of strain, times the lag.
pub(super) fn dissipated<D: Scalar>(poses: &Poses<D>, moving: &Poses<Dual<D>>) -> D {
    half_forms(
        poses,
        |beam| get(beam.lag, &poses.design),
        |beam, section| strain(moving, beam, section).map(|strain| strain.eps),
    )
}

/// Twist and curvatures along the axes of the section: `[k]x = R^T dR/ds`, `R` with the twist before bending left out,
/// whose own rate is not strain.
fn strain<D: Scalar>(poses: &Poses<D>, beam: &Beam, section: &Section) -> [D; 3] {
    let q = of_beam(poses.model, beam, &poses.coordinates);
    let (turn, slope) = (beam.turn(q, section.place), beam.slope(q, section.place));
    let along: [Dual<D>; 3] = std::array::from_fn(|k| Dual::new(turn[k], slope[k]));
    let turned = rotation(beam, along);
    let now = turned.map(|row| row.map(|entry| entry.re));
    let change = turned.map(|row| row.map(|entry| entry.eps));
    let spin = multiply(&transpose(&now), &change);
    let vector = [spin[2][1], spin[0][2], spin[1][0]];
    let length = get(beam.length, &poses.design);
    let along =
        |axis: [f64; 3]| -> D { vector.iter().zip(axis).map(|(&v, a)| v * a).sum::<D>() / length };
    let [first, second, third] = beam.axes.map(along);
    let (sine, cosine) = get(section.twist, &poses.design).sin_cos();
    [
        first,
        cosine * second + sine * third,
        cosine * third - sine * second,
    ]
}

/// The coordinates of a beam among all.
pub(super) fn of_beam<'a, D>(model: &Model, beam: &Beam, coordinates: &'a [D]) -> &'a [D] {
    let first = Coordinate {
        joint: beam.joint,
        step: 0,
    };
    let start = index(&model.coordinates(), first);
    &coordinates[start..start + beam.coordinates()]
}
