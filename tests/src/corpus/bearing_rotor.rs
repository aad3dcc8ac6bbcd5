//! A rigid rotor in a soft anisotropic bearing, in non-rotating coordinates.

machine! {
    /// An overhung rotor: sway and tilt of its cage are coupled by the gyroscopic moment of the spinning disk.
    pub mechanism BearingRotor {
        input speed: rpm;
        design density = 7850 kg/m^3 +/- 0.5%;
        design radius = 120 mm +/- 0.05 mm;
        design thickness = 25 mm +/- 0.05 mm;
        design overhang = 150 mm +/- 0.5 mm;
        design kx = 2 MN/m +/- 5%;
        design ky = 3 MN/m +/- 5%;
        design tilt_stiffness = 80 kN*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -y;
        body cradle: massless;
        body cage: massless;
        body rotor: cylinder(density: density, radius: radius, length: thickness, axis: z, center: [0, 0, overhang])
            + rod(mass: 3 kg, length: 300 mm, along: z, center: [0, 0, 0])
            - tube(density: density, inner: 30 mm, outer: 50 mm, length: thickness / 2, axis: z) at [0, 0, overhang];
        joint sway: planar(u: x, v: y, twist: z) from ground to cradle;
        joint tilt: universal(alpha: x, beta: y) from cradle to cage;
        joint spin: revolute(z) from cage to rotor, driven at speed;
        point seat: ground;
        point journal: cage;
        point center: cage at [0, 0, overhang];
        force bearing: bushing(from: seat, to: journal,
            stiffness: [kx, ky, 0], damping: [800, 800, 0] N*s/m,
            turning_stiffness: [tilt_stiffness, tilt_stiffness, 1 kN*m/rad], turning_damping: [20, 20, 5] N*m*s/rad);
        force windage: drag(at: center, damping: 2 N*s/m);
        output sag = position(center).y;
    }
}
