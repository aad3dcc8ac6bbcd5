//! The bicycle of Whipple (1899) with the benchmark parameters of Meijaard, Papadopoulos, Ruina and Schwab (Proc. R.
//! Soc. A 463, 2007): at which speeds is it stable without hands, and how much do the tolerances of its 26 parameters
//! shift these speeds?
//!
//! The wheels roll without slip: of seven coordinates, only lean and steer have independent rates at a given forward
//! speed.
//!
//! `cargo run --release -p eigentol-examples --example whipple_bicycle`

use std::error::Error;
use std::io::{self, Write};

use eigentol::{Study, mechanism};

mechanism! {
    /// Two wheels, a rear body and a front body, each symmetric about its middle plane, rolling straight ahead without
    /// hands.
    pub mechanism WhippleBicycle {
        /// Forward speed.
        input v: m/s;

        /// Wheel base.
        design w = 1.02 m +/- 5 mm;
        /// Trail: how far the front contact is behind the steer axis, on the road.
        design c = 0.08 m +/- 1 mm;
        /// Of the steer axis from the vertical: `lambda`.
        design tilt = 18 deg +/- 0.3 deg;
        /// Acceleration of gravity.
        design g = 9.81 m/s^2 +/- 0.01 m/s^2;

        design r_r = 0.3 m +/- 1 mm;
        design m_r = 2 kg +/- 1%;
        design i_rxx = 0.0603 kg*m^2 +/- 0.2%;
        design i_ryy = 0.12 kg*m^2 +/- 0.2%;

        design x_b = 0.3 m +/- 1 cm;
        design z_b = -0.9 m +/- 1 cm;
        design m_b = 85 kg +/- 2%;
        design i_bxx = 9.2 kg*m^2 +/- 2%;
        design i_byy = 11 kg*m^2 +/- 2%;
        design i_bzz = 2.8 kg*m^2 +/- 2%;
        design i_bxz = 2.4 kg*m^2 +/- 2%;

        design x_h = 0.9 m +/- 5 mm;
        design z_h = -0.7 m +/- 5 mm;
        design m_h = 4 kg +/- 1%;
        design i_hxx = 0.05892 kg*m^2 +/- 1%;
        design i_hyy = 0.06 kg*m^2 +/- 1%;
        design i_hzz = 0.00708 kg*m^2 +/- 1%;
        design i_hxz = -0.00756 kg*m^2 +/- 0.00005 kg*m^2;

        design r_f = 0.35 m +/- 1 mm;
        design m_f = 3 kg +/- 1%;
        design i_fxx = 0.1405 kg*m^2 +/- 0.1%;
        design i_fyy = 0.28 kg*m^2 +/- 0.1%;

        let axis = [sin(tilt), 0, cos(tilt)];
        let head = [w + c, 0, 0];

        gravity g along z;

        body base: massless;
        body mast: massless;
        body cradle: massless;
        body rear_wheel: rigid(mass: m_r, inertia: [i_rxx, i_ryy, i_rxx]);
        body frame: rigid(mass: m_b, inertia: [i_bxx, i_byy, i_bzz, 0, 0, i_bxz], center: [x_b, 0, z_b]);
        body fork: rigid(mass: m_h, inertia: [i_hxx, i_hyy, i_hzz, 0, 0, i_hxz], center: [x_h, 0, z_h]);
        body front_wheel: rigid(mass: m_f, inertia: [i_fxx, i_fyy, i_fxx]);

        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint height: prismatic(z) from base to mast;
        joint lean: revolute(x) from mast to cradle;
        joint pitch: revolute(y) from cradle to frame;
        joint rear_spin: revolute(y) from frame to rear_wheel at [0, 0, -r_r], driven at -v / r_r;
        joint steer: revolute(axis) from frame to fork at head, at head on fork;
        joint front_spin: revolute(y) from fork to front_wheel at [w, 0, -r_f], coasting;

        point road: ground;
        point rear_hub: rear_wheel;
        point front_hub: front_wheel;

        constraint rear_contact: rolling(wheel: rear_hub, axis: y, radius: r_r, on: road, normal: -z);
        constraint front_contact: rolling(wheel: front_hub, axis: y, radius: r_f, on: road, normal: -z);

        /// Normal force on the rear wheel.
        output rear_load = reaction_force(rear_contact).z;
        /// Normal force on the front wheel.
        output front_load = reaction_force(front_contact).z;
    }
}

/// Speeds from 0.1 to 10 m/s: at rest, a wheel with a single contact point has no rolling direction.
pub fn speeds() -> Vec<f64> {
    (1..=100).map(|k| 0.1 * f64::from(k)).collect()
}

/// Writes the modes along the speed, and the two limits of stability with what moves them.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = Study::new(WhippleBicycle);
    let along = study.campbell(WhippleBicycle::v, &speeds(), &[] as &[f64])?;
    writeln!(out, "{along}")?;
    for limit in along.flutter_onsets.iter().chain(&along.critical) {
        writeln!(out, "{limit}")?;
    }
    writeln!(out, "Published: above 4.2924 m/s the weave decays, above 6.0243 m/s the bicycle capsizes, slowly.")?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
