//! Jeffcott's rotor, seen from the shaft that turns with it.

machine! {
    /// An unbalanced disk in the middle of a slender shaft; the shaft's bending stiffness follows from its dimensions.
    pub mechanism Rotor {
        input speed: rpm;
        design diameter = 20 mm +/- 0.02 mm;
        design span = 800 mm +/- 1 mm;
        design disk_mass = 15 kg +/- 0.1 kg;
        design unbalance = 0.3 mm +/- 0.05 mm;
        let modulus = 206 GPa;
        let second_moment = pi * diameter^4 / 64;
        let bending = 48 * modulus * second_moment / span^3;
        body bearings: massless;
        body across: massless;
        body wheel: disk(mass: disk_mass, radius: 150 mm, axis: z, center: [unbalance, 0, 0]);
        joint spin: revolute(z) from ground to bearings, driven at speed;
        joint u: prismatic(x) from bearings to across;
        joint v: prismatic(y) from across to wheel;
        force bend_u: spring(on: u, stiffness: bending);
        force bend_v: spring(on: v, stiffness: 1.1 * bending);
        force internal_u: damper(on: u, damping: 4 N*s/m);
        output deflection = norm([u, v, 0 mm]);
        output phase = atan2(v, u + unbalance);
    }
}
