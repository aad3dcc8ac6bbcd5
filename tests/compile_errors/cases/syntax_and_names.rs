//! A syntax error hides no mistake of another kind, and makes none.

use eigentol::mechanism;

mechanism! {
    pub mechanism Pendulum {
        input omega rad/s;
        design m = 3,0 kg;
        design l = 1 metre +/- 3%;
        gravity 9.81 m/s^2 along down;
        body shaft: massless;
        body bar: rod(mass: m, length: -1 m, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shft to bar;
    }
}

fn main() {}
