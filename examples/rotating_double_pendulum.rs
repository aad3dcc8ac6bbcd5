//! try
use eigentol::*;
mechanism! {
    /// Two uniform bars hinged in series on a shaft that spins at a constant rate.
    pub mechanism RotatingDoublePendulum {
        input  omega: rad/s;
        design m1 = 3.0 kg;
        design m2 = 3.0 kg;
        design l1 = 1.0 m +/- 3%;
        design l2 = 1000 mm +/- 30 mm;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        point tip: bar2 at [0, 0, -l2];
        output tip_radius = distance_from_axis(tip, z);
    }
}
fn main() {
    let m = RotatingDoublePendulum;
    let b = [3.0, 3.0, 1.0, 1.0];
    println!("{:?}", m.linear(&[0.3f64, 0.2], &[2.5], &b));
    println!("{:?}", m.outputs(&[0.3f64, 0.2], &[2.5], &b));
    println!("{:?}", m.violation(&[2.5], &[3.0, f64::NAN, 1.0, 1.0]));
}
