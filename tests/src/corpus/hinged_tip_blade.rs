//! A flexible blade on a spinning hub with a flap on a spring hinge at its tip.

machine! {
    /// The blade droops under its weight and is straightened by the spin; the flap hangs at the slope of the tip.
    pub mechanism HingedTipBlade {
        input omega: rad/s;
        design length = 1.2 m +/- 2 mm;
        design height = 8 mm +/- 1%;
        design rate = 4 N*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        material alloy: density 2700 kg/m^3, modulus 70 GPa;
        body hub: massless;
        body blade: beam(length: length, along: x, up: z, material: alloy, bending_y: 3, lag: 0.2 ms,
                         section: rectangle(width: 50 mm, height: height) to rectangle(width: 30 mm, height: 0.6 * height));
        body flap: rod(mass: 0.2 kg, length: 0.15 m, along: x);
        joint spin: revolute(z) from ground to hub, driven at omega;
        joint clamp: fixed from hub to blade at [80 mm, 0, 0] rotated(-y, 3 deg);
        joint hinge: revolute(y) from blade at tip to flap;
        force leaf: spring(on: hinge, stiffness: rate);
        point middle: blade at 0.5 length;
        point end: flap at [0.15 m, 0, 0];
        output sag = position(middle).z;
        output reach = distance_from_axis(end, z);
        output root_moment = reaction_moment(clamp).y;
        output hinge_pull = reaction_force(hinge).x;
        output stored = potential_energy() + kinetic_energy();
    }
}
