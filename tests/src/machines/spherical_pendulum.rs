//! A spherical pendulum seen from a turning frame: a double frequency that is split by the rotation.
//!
//! At rest both frequencies are `sqrt(g / l)`; in a frame that turns at `W` they are `sqrt(g / l) +- W`. Without the
//! gyroscopic matrix both would be `sqrt(g / l - W^2)`.

use crate::corpus::machine;

machine! {
    /// A point mass on a light rod that swings freely under a turning post.
    pub mechanism SphericalPendulum {
        input speed: rad/s;
        design length = 0.8 m +/- 1%;
        design mass = 1.5 kg +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body post: massless;
        body bob: point(mass: mass, center: [0, 0, -length]);
        joint turn: revolute(z) from ground to post, driven at speed;
        joint swing: universal(alpha: x, beta: y) from post to bob;
    }
}
