//! Conical whirl of a disk with gyroscopic moments.
//!
//! For the tilt `w = alpha + i beta`: `It w'' - i W Ip w' + k w = 0`, frequencies
//! `W Ip / (2 It) +- sqrt((W Ip / (2 It))^2 + k / It)`. The forward frequency equals the speed at
//! `W = sqrt(k / (It - Ip))`, if `It > Ip`.

use crate::corpus::machine;

machine! {
    /// A rotor that tilts about its center of mass in an isotropic elastic support while it spins.
    pub mechanism OverhungRotor {
        input speed: rad/s;
        design transverse = 0.09 kg*m^2 +/- 1%;
        design polar = 0.05 kg*m^2 +/- 1%;
        design stiffness = 900 N*m/rad +/- 3%;
        body cage: massless;
        body rotor: rigid(mass: 5 kg, inertia: [transverse, transverse, polar]);
        joint tilt: universal(alpha: x, beta: y) from ground to cage;
        joint spin: revolute(z) from cage to rotor, driven at speed;
        force about_x: spring(on: alpha, stiffness: stiffness);
        force about_y: spring(on: beta, stiffness: stiffness);
    }
}
