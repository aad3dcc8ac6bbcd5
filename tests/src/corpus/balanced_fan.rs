//! A fan that is out of balance, on a frame that sways and tilts.

machine! {
    /// A fan on rubber: static unbalance by its balance grade, a skew hub, blades that pass, and a shaking floor.
    pub mechanism BalancedFan {
        input speed: rad/s;
        input hum: rad/s;
        design grade = 6.3 mm/s +/- 1 mm/s;
        design angle = 20 deg +/- 180 deg uniform;
        design skew = 0.2 mrad +/- 0.1 mrad;
        design wheel_mass = 12 kg +/- 0.1 kg;
        design stiffness = 400 kN/m +/- 5%;
        design thrust = 3 N +/- 10%;
        gravity 9.81 m/s^2 along -z;
        body plate: massless;
        body frame: box(mass: 8 kg, size: [0.3, 0.3, 0.2] m);
        body wheel: cylinder(mass: wheel_mass, radius: 0.25 m, length: 8 cm, axis: x, center: [12 cm, 0, 0]);
        joint floor: prismatic(z) from ground to plate, shaken(acceleration: 0.1 m/s^2, frequency: hum, phase: 10 deg);
        joint sway: planar(side: y, lift: z, roll: x) from plate to frame, roll driven at 0;
        joint lean: universal(pitch: y, yaw: z) from frame to housing;
        body housing: massless;
        joint spin: revolute(x) from housing to wheel, driven at speed;
        point seat: plate;
        point foot: housing at [0, 0, -5 cm];
        point bearing: housing at [15 cm, 0, 0];
        force rubber: bushing(from: seat, to: foot, stiffness: stiffness * [1, 1, 2],
            damping: [300, 300, 500] N*s/m, turning_stiffness: [0, 2, 2] kN*m/rad);
        unbalance balance: on wheel, eccentricity: grade / speed, angle: angle;
        unbalance couple: on wheel, tilt: skew, angle: -40 deg;
        unbalance screw: on wheel, amount: 30 g*mm, angle: 2 * angle, at [14 cm, 0, 0];
        force blades: harmonic(at: bearing, force: [0, 0, thrust], moment: [0, 0.2 N*m, 0], order: 7 of spin, phase: 30 deg);
        force current: harmonic(on: yaw, moment: 0.1 N*m, frequency: 2 * hum);
        output height = position(bearing).z;
        output across = position(bearing).y;
        output load = reaction_force(spin).y;
        output floor_force = reaction_force(floor).z;
    }
}
