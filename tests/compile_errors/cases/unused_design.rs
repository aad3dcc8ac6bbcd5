//! A design variable that nothing refers to is a variable that nothing reads; an underscore says that this is meant.

#![deny(unused_variables)]

use eigentol::mechanism;

mechanism! {
    pub mechanism Pendulum {
        input omega: rad/s;
        design m = 3 kg;
        design l = 1 m +/- 3%;
        design width = 5 cm;
        design _depth = 5 cm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

fn main() {}
