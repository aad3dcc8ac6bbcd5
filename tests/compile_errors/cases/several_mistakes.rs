//! Every independent mistake is reported at once.

use eigentol::mechanism;

mechanism! {
    pub mechanism Pendulum {
        input omega: rad/s;
        design m = 3 kgs;
        design l = 1 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: [0, 0, 0]);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shft to bar;
    }
}

fn main() {}
