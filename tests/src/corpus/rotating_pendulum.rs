//! The paper's single bar (section 6.1).

machine! {
    /// A uniform bar hinged on a vertical shaft that spins.
    pub mechanism RotatingPendulum {
        input omega: rad/s;
        design l = 1 m +/- 3%;
        design m = 3 kg +/- 3%;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin: revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        point tip: bar at [0, 0, -l];
        output tip_radius = distance_from_axis(tip, z);
        output rise = l + position(tip).z;
    }
}
