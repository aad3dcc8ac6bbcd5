//! Mechanisms with deviating inputs: kernels, and every question involving tolerances, against the mechanism at shifted
//! inputs and closed forms.

mod analyses;
mod events;
mod kernels;
mod margin;
mod sampling;
mod sweeps;

use eigentol::equilibrium::equilibrium;
use eigentol::kernels::{DeviatingInputs, Kernels};
use eigentol::modes::modes;
use eigentol::{Equilibrium, Input, Modes, Policy, Vector, mechanism};

mechanism! {
    mechanism Single {
        input omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    mechanism Double {
        input omega: rad/s;
        input load: N;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m;
        design l2 = 1.0 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        force pull: potential(energy: load * l1 * cos(theta1));
    }
}

mechanism! {
    /// A damped bar on a spherical joint that can be turned into its singular pose, with a mass and a length that
    /// inputs set.
    mechanism Spherical {
        input m: kg;
        input omega: rad/s;
        input l: m;
        design k = 20.0 N*m/rad;
        design c = 0.3 N*m*s/rad;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: box(mass: m, size: [0.1 m, 0.2 m, l]);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint hang: spherical(yaw: x, pitch: y, roll: z) from shaft to bar at [0.3 m, 0, 0], at [0, 0, 0.5 * l] on bar;
        force twist: spring(on: roll, stiffness: k);
        force bend: spring(on: yaw, stiffness: k);
        force loss: damper(on: pitch, damping: c);
        point tip: bar at [0, 0, -0.5 * l];
        output height = position(tip).z;
        output speed = 2 * omega * cos(pitch);
    }
}

mechanism! {
    /// A bob on a rod whose length is a constraint, on a shaft: unknowns are its two coordinates and the tension of the
    /// rod.
    mechanism Governor {
        input omega: rad/s;
        design m = 2.0 kg;
        design l = 0.7 m;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body slide: massless;
        body bob: point(mass: m);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint x: prismatic(x) from shaft to slide;
        joint z: prismatic(z) from slide to bob;
        point pivot: shaft;
        point end: bob;
        constraint rod: distance(from: pivot, to: end, length: l);
    }
}

const OMEGA: Input = Input::new(0);
const GRAVITY: f64 = 9.81;

/// Square of the critical speed of [`Single`].
const CRITICAL: f64 = 1.5 * GRAVITY;

/// A mechanism in which all inputs deviate, in order.
fn all_deviate<K: Kernels + ?Sized>(kernels: &K) -> DeviatingInputs<'_, K> {
    let inputs: Vec<Input> = (0..kernels.sizes().inputs).map(Input::new).collect();
    DeviatingInputs::new(kernels, &inputs).unwrap()
}

fn nominal(kernels: &dyn Kernels) -> Vector {
    let description = kernels.description();
    description.design.iter().map(|info| info.nominal).collect()
}

fn solved(kernels: &dyn Kernels, u: &[f64], b: &[f64], start: &[f64]) -> (Equilibrium, Modes) {
    let state = equilibrium(kernels, u, b, start, Policy::Stable).unwrap();
    let found = modes(&state).unwrap();
    (state, found)
}

/// Frequency of a uniform bar of 1 m on a shaft at speed `u`, hanging or swung out.
fn frequency(u: f64) -> f64 {
    let square = u * u;
    if square > CRITICAL { (square - CRITICAL * CRITICAL / square).sqrt() } else { (CRITICAL - square).sqrt() }
}

/// The first two derivatives of `sqrt(u^2 - c^2 / u^2)`, the frequency above the critical speed.
fn frequency_slopes(u: f64) -> [f64; 2] {
    let square = CRITICAL * CRITICAL;
    let (first, second) = (2.0 * u + 2.0 * square / u.powi(3), 2.0 - 6.0 * square / u.powi(4));
    let omega = frequency(u);
    let slope = 0.5 * first / omega;
    [slope, (0.5 * second - slope * slope) / omega]
}
