//! Two gears out of balance, one driven, on a gearbox that rocks.

use crate::corpus::machine;

machine! {
    /// A wheel that a pinion drives, both out of balance, and the teeth between them.
    pub mechanism GearedUnbalance {
        input speed: rad/s;
        design ratio = 0.4 +/- 1%;
        design offset = 20 um +/- 10 um;
        design teeth = 17;
        design stiffness = 5 kN*m/rad +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body gearbox: box(mass: 5 kg, size: [0.3, 0.4, 0.2] m);
        body pinion: cylinder(mass: 1 kg, radius: 5 cm, length: 4 cm, axis: y, center: [0, 4 cm, 0]);
        body wheel: cylinder(mass: 4 kg, radius: 12 cm, length: 4 cm, axis: y, center: [0, 5 cm, 0]);
        joint rock: universal(roll: x, yaw: z) from ground to gearbox;
        joint fast: revolute(y) from gearbox to pinion at [0, 0, 6 cm], driven at speed;
        joint slow: revolute(y) from gearbox to wheel at [0, 0, -11 cm], coasting;
        force mount_roll: spring(on: roll, stiffness: stiffness);
        force mount_yaw: spring(on: yaw, stiffness: stiffness);
        force rub: damper(on: roll, damping: 3 N*m*s/rad);
        constraint mesh: coupling(of: slow, with: fast, ratio: -ratio);
        unbalance first: on pinion, eccentricity: offset, angle: 10 deg;
        unbalance second: on wheel, eccentricity: 2 * offset, angle: 70 deg;
        force tooth: harmonic(on: roll, moment: 0.2 N*m, order: teeth of fast);
        output tangential = reaction(mesh);
        output bearing = reaction_force(slow).x;
        output tipped = roll;
    }
}
