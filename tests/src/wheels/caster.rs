//! A towed caster wheel that shimmies: it has three eigenvalues, because the wheel determines the rate of the angle.
//!
//! With the trail `a`, the total mass `m`, `F = mass center + wheel a` and the inertia `I` about the pin:
//! `(a (a m - F) + I - a F) s^3 + (v (a m - F) + a^2 damping + friction) s^2 +
//! (v a damping + a^2 stiffness + centering) s + v a stiffness = 0`.

use crate::corpus::machine;

machine! {
    /// A wheel behind a pin that gives way sideways, towed at a constant speed.
    pub mechanism TowedCaster {
        input v: m/s;
        design pin = 2 kg +/- 1%;
        design mass = 1.5 kg +/- 1%;
        design inertia = 0.02 kg*m^2 +/- 2%;
        design center = 0.05 m +/- 1 mm;
        design trail = 0.1 m +/- 1 mm;
        design wheel = 0.8 kg +/- 1%;
        design across = 0.004 kg*m^2 +/- 2%;
        design polar = 0.006 kg*m^2 +/- 2%;
        design radius = 0.08 m +/- 1 mm;
        design stiffness = 2 kN/m +/- 3%;
        design damping = 10 N*s/m +/- 5%;
        design centering = 5 N*m/rad +/- 3%;
        design friction = 0.02 N*m*s/rad +/- 5%;
        body carriage: massless;
        body kingpin: point(mass: pin);
        body arm: rigid(mass: mass, inertia: [inertia, inertia, inertia], center: [-center, 0, 0]);
        body tire: rigid(mass: wheel, inertia: [across, polar, across]);
        joint tow: prismatic(x) from ground to carriage, driven at v;
        joint slide: prismatic(y) from carriage to kingpin;
        joint swing: revolute(z) from kingpin to arm;
        joint spin: revolute(y) from arm to tire at [-trail, 0, radius], coasting;
        point road: ground;
        point hub: tire;
        constraint contact: rolling(wheel: hub, axis: y, radius: radius, on: road, normal: z);
        force side: spring(on: slide, stiffness: stiffness);
        force oil: damper(on: slide, damping: damping);
        force center_spring: spring(on: swing, stiffness: centering);
        force rub: damper(on: swing, damping: friction);
    }
}
