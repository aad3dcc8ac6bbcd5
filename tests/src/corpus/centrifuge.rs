//! A swing-out laboratory centrifuge: two drives on one axis, and functions of every kind in its dimensions.

machine! {
    /// A bucket on trunnions at the end of a yoke, itself sprung against a head whose speed follows a pulley ratio.
    pub mechanism Centrifuge {
        input motor: rad/s;
        input creep: rad/s;
        design ratio = 1.5 +/- 1%;
        design yoke = 110 mm +/- 0.2 mm;
        design bucket_mass = 260 g +/- 4 g;
        design fill = 0.6 +/- 0.1;
        design trunnion = 0.8 N*m/rad;
        let sample = 90 g * fill * exp(-fill / 10);
        let depth = sqrt((60 mm)^2 + (5 mm)^2) * cos(10 deg) + 1 mm * ln(2 + fill);
        let level = depth * (1 - fill / 2) * sin(80 deg) + 0.1 mm * tan(fill) * asin(0.5);
        let side = cross([0, 0, 1], [1, 0, 0]);
        gravity 9.80665 m/s^2 along [0, 0, -1];
        body head: sphere(mass: 1.1 kg, radius: 50 mm);
        body arm: rod(mass: 0.3 kg, length: yoke, along: x);
        body bucket: cylinder(mass: bucket_mass, radius: 15 mm, length: depth, axis: z, center: [0, 0, -depth / 2]);
        body liquid: point(mass: sample, center: [1 mm * atan(fill), 0, -level]);
        joint spin: revolute(z) from ground to head, driven at ratio * motor;
        joint slip: revolute(z) from head to arm, driven at creep;
        joint swing: revolute(side) from arm to bucket at [yoke, 0, 0];
        joint filled: fixed from liquid to bucket;
        force hold: spring(on: swing, stiffness: trunnion * acos(0.5));
        output swing_out = swing / 1 deg;
        output force_ratio = (ratio * motor + creep)^2 * (yoke + level) / 9.80665 m/s^2;
    }
}
