//! A linkage of four bars, one bearing of which is shaken.

use crate::corpus::machine;

machine! {
    /// A crank and a rocker; the bearing of the rocker slides with its foundation.
    pub mechanism ShakenLinkage {
        input hum: rad/s;
        design arm = 0.3 m +/- 0.1 mm;
        design span = 0.7 m +/- 0.2 mm;
        design size = 0.2 mm +/- 0.1 mm;
        design stiffness = 20 N*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body crank: rod(mass: 1 kg, length: arm, along: z);
        body coupler: rod(mass: 2 kg, length: span, along: x);
        body foundation: massless;
        body rocker: rod(mass: 1.5 kg, length: 1.5 * arm, along: z);
        joint a: revolute(y) from ground to crank;
        joint b: revolute(y) from crank to coupler at [0, 0, arm];
        joint slip: prismatic(x) from ground to foundation at [span, 0, -0.5 * arm], shaken(amplitude: size, frequency: hum);
        joint d: revolute(y) from foundation to rocker;
        joint c: revolute(y) from coupler to rocker at [span, 0, 0], at [0, 0, 1.5 * arm] on rocker, cut;
        force holding: spring(on: a, stiffness: stiffness, rest: 20 deg);
        force rub: damper(on: a, damping: 0.1 N*m*s/rad);
        force motor: harmonic(on: a, moment: 0.3 N*m, frequency: hum, phase: 25 deg);
        output pull = reaction_force(slip).x;
        output pin = reaction_force(c).x;
        point knee: coupler at [span, 0, 0];
        output height = position(knee).z;
    }
}
