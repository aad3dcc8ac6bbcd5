//! A design variable is no input.

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

fn set(_: Input<Pendulum>, _: f64) {}

fn main() {
    set(Pendulum::l, 5.0);
}
