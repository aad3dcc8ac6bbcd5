//! Does the flap frequency of a turbine blade meet three times the rotor speed, and does pitching the blade help?
//!
//! Centrifugal forces stiffen the blade, the more so the more it flaps out of the rotor plane:
//! `omega^2 = omega_0^2 + (cos^2 pitch + 3 e / (2 L)) Omega^2` (R. V. Southwell and B. S. Gough, 1921; hinge offset
//! `e`).

use std::error::Error;
use std::io::Write;

use eigentol::sweep::EventTolerance;
use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// A rigid 30 m blade on a root spring that gives the first flap frequency of the real blade; typical data.
    pub mechanism TurbineBlade {
        /// Speed of the rotor.
        input rotor: rpm;
        /// Pitch angle of the blade.
        input pitch: deg;

        design mass = 5 t +/- 2%;
        design length = 30 m +/- 20 mm;
        design hub = 1.5 m +/- 5 mm;
        design root = 70 MN*m/rad +/- 8%;

        body nacelle: massless;
        body pitched: massless;
        body blade: rod(mass: mass, length: length, along: x);

        joint turn: revolute(z) from ground to nacelle, driven at rotor;
        joint bearing: fixed from nacelle to pitched at [hub, 0, 0] rotated(x, pitch);
        joint flap: revolute(-y) from pitched to blade;

        force stiffness: spring(on: flap, stiffness: root);
    }
}

/// Rated speed, rpm.
pub const RATED: f64 = 21.5;

/// The blade at rated speed.
pub fn study() -> Study<TurbineBlade> {
    Study::new(TurbineBlade).input(TurbineBlade::rotor, RATED * RPM)
}

/// The rotor speed at which the flap frequency meets three times that speed, for a pitch angle in degrees.
pub fn meeting(pitch: f64) -> Result<EventTolerance, Box<dyn Error>> {
    let found = study().input(TurbineBlade::pitch, pitch.to_radians()).crossing_tolerances(
        TurbineBlade::rotor,
        5.0 * RPM,
        40.0 * RPM,
        3.0,
    )?;
    Ok(found.into_iter().next().ok_or("no crossing")?)
}

/// Writes the resonance speed at two pitch angles and compares it with the rated speed.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    write!(out, "TURBINE BLADE: ")?;
    for pitch in [0.0, 25.0] {
        let at = meeting(pitch)?;
        let speed = at.value / RPM;
        let sigma = at.spread?.sigma / RPM;
        let away = (speed - RATED) / sigma;
        writeln!(
            out,
            "pitched by {pitch} deg it meets 3P at {speed:.2} rpm, sigma {sigma:.2} rpm: {away:.1} sigma above the rated speed."
        )?;
    }
    writeln!(out, "Pitching does not help; the margin is a matter of the root's stiffness.\n")?;
    Ok(())
}
