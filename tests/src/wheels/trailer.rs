//! A trailer on a circle: no velocity freedom is left, as the wheels determine every rate.
//!
//! `sin(swing) = -length / radius`, `s = -(speed / length) sqrt(radius^2 - length^2)`: the trailer jackknifes when the
//! circle is smaller than its length. Both wheels resist sideways motion in the same way, a redundant constraint.

use crate::corpus::machine;

machine! {
    /// A trailer with two wheels, its hitch led around a circle.
    pub mechanism CirclingTrailer {
        /// Of the hitch around the circle.
        input speed: rad/s;
        /// Of the circle of the hitch.
        input radius: m;
        design length = 3 m +/- 1 cm;
        design center = 2 m +/- 2 cm;
        design mass = 400 kg +/- 2%;
        design inertia = 900 kg*m^2 +/- 2%;
        design wheel = 15 kg +/- 1%;
        design across = 0.4 kg*m^2 +/- 1%;
        design polar = 0.7 kg*m^2 +/- 1%;
        design tire = 0.3 m +/- 1 mm;
        design track = 0.75 m +/- 5 mm;
        body post: massless;
        body bed: rigid(mass: mass, inertia: [inertia, inertia, inertia], center: [0, -center, 0]);
        body left_wheel: rigid(mass: wheel, inertia: [polar, across, across]);
        body right_wheel: rigid(mass: wheel, inertia: [polar, across, across]);
        joint lead: revolute(z) from ground to post, driven at speed;
        joint swing: revolute(z) from post to bed at [radius, 0, 0];
        joint left_spin: revolute(x) from bed to left_wheel at [-track, -length, tire], coasting;
        joint right_spin: revolute(x) from bed to right_wheel at [track, -length, tire], coasting;
        point road: ground;
        point left_hub: left_wheel;
        point right_hub: right_wheel;
        constraint left: rolling(wheel: left_hub, axis: -x, radius: tire, on: road, normal: z);
        constraint right: rolling(wheel: right_hub, axis: -x, radius: tire, on: road, normal: z);
        /// Of both wheels together, towards the centre of the circle.
        output side_force = reaction_force(left).y + reaction_force(right).y;
    }
}
