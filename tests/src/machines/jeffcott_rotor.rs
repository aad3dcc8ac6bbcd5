//! Jeffcott's rotor in non-rotating coordinates, with rotating damping.
//!
//! For `z = x + i y`: `m z'' + (c_e + c_i) z' + (k - i W c_i) z = -i m g`. Forward whirl grows beyond
//! `W = sqrt(k / m) (1 + c_e / c_i)`.

use crate::corpus::machine;

machine! {
    /// A disk in the middle of an elastic horizontal shaft; external damping is at rest, internal damping turns with
    /// the shaft.
    pub mechanism JeffcottRotor {
        input speed: rad/s;
        design mass = 8 kg +/- 1%;
        design stiffness = 50 kN/m +/- 3%;
        design external = 60 N*s/m +/- 10%;
        design internal = 25 N*s/m +/- 10%;
        gravity 9.81 m/s^2 along -y;
        body line: massless;
        body across: massless;
        body center: massless;
        body wheel: disk(mass: mass, radius: 150 mm, axis: z);
        joint line_spin: revolute(z) from ground to line, driven at speed;
        joint x_sway: prismatic(x) from ground to across;
        joint y_sway: prismatic(y) from across to center;
        joint spin: revolute(z) from center to wheel, driven at speed;
        point undeformed: line;
        point deformed: center;
        force bend_x: spring(on: x_sway, stiffness: stiffness);
        force bend_y: spring(on: y_sway, stiffness: stiffness);
        force oil_x: damper(on: x_sway, damping: external);
        force oil_y: damper(on: y_sway, damping: external);
        force hysteresis: bushing(from: undeformed, to: deformed, damping: [internal, internal, 0]);
        output sag = -y_sway;
    }
}
