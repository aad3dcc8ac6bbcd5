//! The sense in which spinning shafts whirl, seen from the ground.

use std::f64::consts::PI;

use eigentol::kernels::Kernels;
use eigentol::{Complex, Input, Mode, Study};
use eigentol_interpreter::Interpreted;

use crate::beams::compared::machine;

const LENGTH: f64 = 1.2;
const STIFFNESS: f64 = 9.0;
const MASS: f64 = 0.6;
const INERTIA: f64 = 2e-3;

/// A round shaft along x in two bearings, with gyroscopic moments that are not small.
fn shaft() -> Interpreted {
    machine(&format!(
        "mechanism Shaft {{
            input omega: rad/s;
            body shaft: beam(length: {LENGTH} m, along: x, up: z, mass_per_length: {MASS} kg/m,
                stiffness_y: {STIFFNESS} N*m^2, stiffness_z: {STIFFNESS} N*m^2, inertia_y: {INERTIA} kg*m,
                inertia_z: {INERTIA} kg*m, bending: 10) spinning at omega;
            joint left: universal(about_y: y, about_z: z) from ground to shaft;
            point end: shaft at tip;
            point right: ground at [{LENGTH}, 0, 0] m;
            constraint bearing: coincident(from: right, to: end, along: [y, z]);
            point seen: shaft at 0.3 length;
            output y = position(seen).y;
            output z = position(seen).z;
        }}"
    ))
}

/// Angular velocities of circular whirl with `n` half waves, positive in the sense of the spin: roots of
/// `(m + j k^2) w^2 - 2 j k^2 omega w - EI k^4 = 0`, `k = n pi / L`.
fn whirl(n: f64, spin: f64) -> [f64; 2] {
    let k = n * PI / LENGTH;
    let mass = MASS + INERTIA * k * k;
    let half = INERTIA * k * k * spin / mass;
    let root = (half * half + STIFFNESS * k.powi(4) / mass).sqrt();
    [half - root, half + root]
}

/// Displacements of the seen section along y and z, per unit of the mode.
fn displacement(shaft: &Interpreted, spin: f64, mode: &Mode) -> [Complex; 2] {
    let shaft: &dyn Kernels = shaft;
    let moved = |part: fn(&Complex) -> f64| {
        let size = 1e-5 / mode.shape.iter().map(|component| component.norm()).fold(0.0, f64::max);
        let at = |sign: f64| {
            let q: Vec<f64> = mode.shape.iter().map(|component| sign * size * part(component)).collect();
            shaft.outputs(&q, &[spin], &[])
        };
        let (ahead, behind) = (at(1.0), at(-1.0));
        [0, 1].map(|k| (ahead[k] - behind[k]) / (2.0 * size))
    };
    let (real, imaginary) = (moved(|x| x.re), moved(|x| x.im));
    [0, 1].map(|k| Complex::new(real[k], imaginary[k]))
}

/// With the spin the orbit is `y = cos w t, z = sin w t`, so that `z = -i y`; against it `z = i y`.
#[test]
fn forward_whirl_turns_with_the_spin_and_is_faster() {
    let shaft = shaft();
    for spin in [60.0, -60.0, 150.0] {
        let study = Study::new(shaft.clone()).input(Input::new(0), spin);
        let modes = study.modes().expect("modes");
        for n in [1.0, 2.0] {
            let whirls = whirl(n, spin);
            for expected in whirls {
                let near = |mode: &&Mode| (mode.s - Complex::new(0.0, expected.abs())).norm() < 1e-8 * expected.abs();
                let mode = modes.modes.iter().find(near);
                let mode = mode.unwrap_or_else(|| panic!("no mode near {expected} at {spin}"));
                let [y, z] = displacement(&shaft, spin, mode);
                let turned = y * Complex::new(0.0, -expected.signum());
                assert!(y.norm() > 1e-3, "{y}");
                assert!((z - turned).norm() < 1e-6 * y.norm(), "{spin}, {expected}: {y} {z}");
            }
            // the one with the spin is the faster one
            let [slow, fast] = whirls;
            let forward = if spin > 0.0 { fast } else { -slow };
            let backward = if spin > 0.0 { -slow } else { fast };
            assert!(forward > whirl(n, 0.0)[1] && backward < whirl(n, 0.0)[1]);
        }
    }
}

/// Frequencies of the first four modes rise or fall with the spin as their sense says.
#[test]
fn forward_whirl_rises_with_the_spin_and_backward_falls() {
    let shaft = shaft();
    let found = |spin: f64| {
        let study = Study::new(shaft.clone()).input(Input::new(0), spin);
        study.modes().expect("modes")
    };
    let mut before = [(0.0, f64::INFINITY); 2];
    for spin in [20.0, 60.0, 100.0, 140.0] {
        let modes = found(spin);
        let (mut forward, mut backward) = (Vec::new(), Vec::new());
        for mode in modes.modes.iter().take(4) {
            let [y, z] = displacement(&shaft, spin, mode);
            match (z / y).im < 0.0 {
                true => forward.push(mode.s.im),
                false => backward.push(mode.s.im),
            }
        }
        assert_eq!((forward.len(), backward.len()), (2, 2), "at {spin}");
        for (k, before) in before.iter_mut().enumerate() {
            assert!(forward[k] > before.0 && backward[k] < before.1, "at {spin}");
            *before = (forward[k], backward[k]);
        }
    }
}
