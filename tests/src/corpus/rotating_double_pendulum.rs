//! The paper's double bar (section 6.2).

machine! {
    /// Two uniform bars hinged in series on a vertical shaft that spins.
    pub mechanism RotatingDoublePendulum {
        input omega: rad/s;
        design l1 = 1.0 m +/- 3%;
        design l2 = 1000 mm +/- 30 mm;
        design m1 = 3.0 kg +/- 90 g;
        design m2 = 3.0 kg +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];
        point tip: bar2 at [0, 0, -l2];
        output tip_radius = distance_from_axis(tip, z);
        output tip_angle = theta1 + theta2;
    }
}
