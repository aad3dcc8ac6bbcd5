//! Bodies that hang on nothing.

use eigentol::mechanism;

mechanism! {
    pub mechanism Pendulum {
        input omega: rad/s;
        design m = 3 kg;
        design l = 1 m +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint theta: revolute(y) from shaft to bar;
    }
}

fn main() {}
