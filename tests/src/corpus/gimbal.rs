//! A gyroscope: two free rotations, one driven, and a steady state although the wheel never rests.

machine! {
    /// A wheel at speed in two gimbals that springs hold upright, the inner one mounted askew.
    pub mechanism Gimbal {
        input wheel_speed: rpm;
        design wheel_mass = 0.9 kg +/- 5 g;
        design wheel_radius = 60 mm +/- 0.1 mm;
        design outer_spring = 2.5 N*m/rad +/- 3%;
        design inner_spring = 1.5 N*m/rad +/- 3%;
        design skew = 2 deg +/- 0.25 deg;
        design sag = 1.5 mm +/- 0.1 mm;
        gravity 9.81 m/s^2 along -z;
        body outer: rigid(mass: 0.4 kg, inertia: [0.8e-3, 1.1e-3, 1.2e-3, 2e-5, 0, -1e-5] kg*m^2);
        body inner: box(mass: 0.2 kg, size: [0.1, 0.12, 0.02] m);
        body wheel: cylinder(mass: wheel_mass, radius: wheel_radius, length: 30 mm, axis: z, center: [0, 0, -sag]);
        joint outer_turn: revolute(x) from ground to outer;
        joint inner_turn: revolute(y) from outer to inner rotated(z, skew), rotated(z, -skew) on inner;
        joint spin: revolute(z) from inner to wheel, driven at wheel_speed;
        force hold_outer: spring(on: outer_turn, stiffness: outer_spring, rest: 1 deg);
        force hold_inner: spring(on: inner_turn, stiffness: inner_spring);
        output stored = potential_energy();
        output lean = acos(cos(outer_turn) * cos(inner_turn));
    }
}
