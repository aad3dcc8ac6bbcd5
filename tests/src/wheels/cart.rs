//! A cart that finds its own speed, with a pendulum that trails in the wind.
//!
//! `speed = push / (drag + air)`, `tan(swing) = -air speed / (bob g)`. With
//! `m = cart + wheel + polar / radius^2 + bob`, the length `l`, and `c`, `s` the cosine and sine of the swing, the
//! eigenvalues are the roots of
//! `(m s + drag + air) ((bob l^2 + inertia) s^2 + air l^2 s + bob g l c - air l s speed) - (bob l c s^2 + air l c s) (bob l c s + air l c)`.

use crate::corpus::machine;

machine! {
    /// A cart on a wheel, pushed against drag, with a pendulum.
    pub mechanism PushedCart {
        input push: N;
        design cart = 2 kg +/- 1%;
        design wheel = 1 kg +/- 1%;
        design polar = 0.02 kg*m^2 +/- 1%;
        design radius = 0.15 m +/- 1 mm;
        design bob = 1.2 kg +/- 1%;
        design inertia = 0.01 kg*m^2 +/- 1%;
        design length = 0.4 m +/- 1 mm;
        design drag = 1.5 N*s/m +/- 5%;
        design air = 0.9 N*s/m +/- 5%;
        gravity 9.81 m/s^2 along -z;
        body chassis: point(mass: cart);
        body tire: rigid(mass: wheel, inertia: [polar, polar, polar]);
        body pendulum: rigid(mass: bob, inertia: [inertia, inertia, inertia], center: [0, 0, -length]);
        joint run: prismatic(x) from ground to chassis, coasting;
        joint spin: revolute(y) from chassis to tire at [0, 0, radius], coasting;
        joint swing: revolute(-y) from chassis to pendulum;
        point road: ground;
        point hub: tire;
        point tow: chassis;
        point tip: pendulum at [0, 0, -length];
        constraint contact: rolling(wheel: hub, axis: y, radius: radius, on: road, normal: z);
        force shove: load(at: tow, force: [push, 0, 0]);
        force brake: drag(at: tow, damping: drag);
        force wind: drag(at: tip, damping: air);
        output pace = rate(run);
    }
}
