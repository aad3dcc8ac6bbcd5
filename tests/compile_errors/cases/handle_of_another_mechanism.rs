//! A handle belongs to its mechanism: what studies another one does not take it.

use eigentol::{Input, mechanism};

mechanism! {
    pub mechanism Pendulum {
        input omega: rad/s;
        design m = 3 kg;
        design l = 1 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

mechanism! {
    pub mechanism Slider {
        input omega: rad/s;
        design m = 1 kg;
        design k = 100 N/m;
        body plate: massless;
        body block: point(mass: m);
        joint spin: revolute(z) from ground to plate, driven at omega;
        joint x: prismatic(x) from plate to block;
        force hold: spring(on: x, stiffness: k);
    }
}

/// As `Study<Pendulum>` takes it.
fn set(_: Input<Pendulum>, _: f64) {}

fn main() {
    set(Pendulum::omega, 5.0);
    set(Slider::omega, 5.0);
}
