//! A helicopter blade with flap and lag coupled by Coriolis forces.

machine! {
    /// An articulated rotor blade with its flap hinge inside its lag hinge, coned by gravity and preset pitch.
    pub mechanism RotorBlade {
        input omega: rad/s;
        design blade = 5 m +/- 5 mm;
        design mass = 40 kg +/- 0.4 kg;
        design hinge = 0.25 m +/- 1 mm;
        design lag_stiffness = 12 kN*m/rad +/- 3%;
        design precone = 3 deg +/- 0.1 deg;
        gravity 9.81 m/s^2 along -z;
        body hub: massless;
        body knuckle: massless;
        body aerofoil: rigid(mass: mass, center: [blade / 2, 20 mm, 0],
                             inertia: [0.02 m^2 * mass, mass * blade^2 / 12, mass * (blade^2 / 12 + 0.018 m^2), 0, 0, 0]);
        joint spin: revolute(z) from ground to hub, driven at omega;
        joint flap: revolute(-y) from hub to knuckle at [hinge, 0, 0] rotated(y, -precone);
        joint lag: revolute(z) from knuckle to aerofoil at [100 mm, 0, 0];
        force lag_damper: damper(on: lag, damping: 250 N*m*s/rad);
        force lag_spring: spring(on: lag, stiffness: lag_stiffness);
        point blade_tip: aerofoil at [blade, 0, 0];
        output tip_height = dot(position(blade_tip), [0, 0, 1]);
        output coning = atan(tan(flap));
    }
}
