//! A boom that bends in two planes and twists.

machine! {
    /// A leaning, pretwisted boom with a mass beside its tip, held by a stay.
    pub mechanism TwistingBoom {
        design length = 1.5 m +/- 3 mm;
        design lead = 0.4 kg +/- 1%;
        design offset = 60 mm +/- 1 mm;
        design twist = 20 deg +/- 0.5 deg;
        gravity 9.81 m/s^2 along -z;
        body boom: beam(length: length, along: x, up: z, torsion: 1, bending: 1, twist: twist, lag: 1 ms,
                        section: section(mass: 0.3 kg/m, EIy: 12 N*m^2, EIz: 40 N*m^2, GJ: 6 N*m^2,
                                         inertia_y: 0.2 g*m, inertia_z: 0.6 g*m));
        body weight: point(mass: lead);
        joint clamp: fixed from ground to boom rotated([0, -3, 1], 25 deg);
        joint weld: fixed from boom at tip to weight at [0, offset, 0];
        point eye: boom at 0.6 length;
        point ring: weight;
        point mast: ground at [0, 0.2, 0.8] m;
        force stay: spring_damper(from: mast, to: ring, stiffness: 15 N/m, damping: 0.4 N*s/m, length: 0.7 m);
        output height = position(eye).z;
        output side = position(eye).y;
        output torque = reaction_moment(clamp).x;
        output shear = reaction_force(weld).y;
        output stored = potential_energy();
    }
}
