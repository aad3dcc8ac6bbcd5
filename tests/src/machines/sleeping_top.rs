//! A sleeping top: held upright by its spin alone.
//!
//! For the tilt `w = alpha + i beta`: `A w'' - i C W w' - m g h w = 0`, with `A` about the pivot. Precession and
//! nutation are `(C W -+ sqrt(C^2 W^2 - 4 A m g h)) / (2 A)`; below `C W = 2 sqrt(A m g h)` the top falls.

use crate::corpus::machine;

machine! {
    /// An upright top on a fixed point, spinning at a constant rate.
    pub mechanism SleepingTop {
        input spin: rad/s;
        design mass = 0.4 kg +/- 1%;
        design height = 50 mm +/- 0.2 mm;
        design transverse = 3e-4 kg*m^2 +/- 1%;
        design polar = 5e-4 kg*m^2 +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body cage: massless;
        body top: rigid(mass: mass, inertia: [transverse, transverse, polar], center: [0, 0, height]);
        joint pivot: universal(alpha: x, beta: y) from ground to cage;
        joint turn: revolute(z) from cage to top, driven at spin;
    }
}
