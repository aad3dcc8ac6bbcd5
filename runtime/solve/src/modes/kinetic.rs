//! Weights for shapes with speeds, from the kinetic energy.

use crate::algebra::{Matrix, Vector, largest_element, times_complex};
use crate::constraints::Structure;
use crate::kernels::Linear;
use crate::{Complex, Modes};

/// Share of the greatest possible weight below which a shape counts as massless.
const MASSLESS: f64 = 1e-12;

/// The weight matrix for shapes with displacements and speeds, which the largest `|s|` brings to one unit.
///
/// `None` where `Mhat` already weighs everything that moves.
pub(super) fn kinetic(from: &Modes, to: &Modes, linear: &Linear) -> Option<Matrix> {
    let structure = Structure::of(&to.description);
    if structure.holonomic() {
        return None;
    }
    let all = || from.modes.iter().chain(&to.modes);
    let rate = all().fold(0.0, |most: f64, mode| most.max(mode.s.norm()));
    let rate = if rate > 0.0 { rate } else { 1.0 };
    Some(inertia(linear, structure, rate, all().map(|mode| &*mode.shape)))
}

/// The inertia of displacements, times `rate`, and of speeds: `Mhat`, with the columns of the speeds from `Chat`.
///
/// Where one of the shapes moves no mass, every component weighs the same.
pub fn inertia<'a>(
    linear: &Linear,
    structure: Structure,
    rate: f64,
    mut shapes: impl Iterator<Item = &'a [Complex]>,
) -> Matrix {
    let (q, motions) = (structure.coordinates, structure.motions());
    let n = linear.mass.row_count();
    let weight = Matrix::from_fn(n, n, |i, j| {
        let (mass, speed) = (linear.mass[i][j], linear.damping[i][j]);
        match (i < q, j < q) {
            _ if i >= motions || j >= motions => 0.0,
            (true, true) => mass * rate * rate,
            (true, false) => speed * rate,
            (false, true) => mass * rate,
            (false, false) => speed,
        }
    });
    let greatest = largest_element(&weight);
    let moves_mass = |shape: &[Complex]| {
        let motion = Vector::from_fn(n, |i| if i < motions { shape[i] } else { Complex::default() });
        let re = product(&motion, &times_complex(&weight, &motion)).re;
        re > MASSLESS * greatest * product(&motion, &motion).re
    };
    if shapes.all(moves_mass) {
        return weight;
    }
    Matrix::from_fn(n, n, |i, j| match () {
        () if i != j || i >= motions => 0.0,
        () if i < q => rate * rate,
        () => 1.0,
    })
}

/// `x^H y`.
pub(super) fn product(x: &[Complex], y: &[Complex]) -> Complex {
    x.iter().zip(y).fold(Complex::default(), |sum, (a, b)| sum + a.conj() * b)
}
