//! A mechanism compiled without the standard library, as in controller firmware.
//!
//! `cargo check -p eigentol-embedded` builds it alone, without the solvers; in a workspace build, other packages enable
//! them.
#![no_std]

pub mod smallest;

/// Declarations of this and other packages as a build script generates them. rustc treats this text as if the user had
/// written it, so it must compile without warnings. Clippy sees all of them, as part of `.ci/run`; they are not run from here.
#[cfg(clippy)]
#[deny(warnings, unused, clippy::all, clippy::pedantic)]
pub mod generated {
    include!(concat!(env!("OUT_DIR"), "/mechanisms.rs"));
}

/// Mechanisms in separate files, with C functions, as `eigentol-build` generates them.
#[deny(warnings, unused, clippy::all, clippy::pedantic)]
pub mod for_c {
    include!(concat!(env!("OUT_DIR"), "/ball.rs"));
    include!(concat!(env!("OUT_DIR"), "/swing.rs"));
}

use eigentol::{Mechanism, mechanism};

mechanism! {
    /// A bar hinged on a spinning shaft, held by a spring.
    pub mechanism SprungPendulum {
        input  omega: rad/s;
        design m = 3.0 kg;
        design l = 1.0 m;
        design k = 20 N*m/rad;
        gravity 9.81 m/s^2 along -z;
        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);
        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
        force hold: spring(on: theta, stiffness: k);
        point tip: bar at [0, 0, -l];
        output radius = distance_from_axis(tip, z);
    }
}

/// The moment missing to hold the hinge at `theta`, N m.
pub fn imbalance(theta: f64, omega: f64, design: &[f64; 3]) -> f64 {
    SprungPendulum.residual(&[theta], &[omega], design)[0]
}

/// The same moment as [`imbalance`], in single precision.
pub fn imbalance_f32(theta: f32, omega: f32, design: &[f32; 3]) -> f32 {
    SprungPendulum.residual(&[theta], &[omega], design)[0]
}
