//! A grinding wheel sits askew on its spindle: does the face run true at speed, and is a stiffer bearing worth its
//! price?
//!
//! A disk clamped at an angle `s` straightens itself when it turns: the remaining angle is
//! `s / (1 + (C - A) Omega^2 / k)` (J. P. Den Hartog, Mechanical Vibrations, 1956, on gyroscopic moments of disks).

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// A corundum wheel on a flange that bends with the end of the spindle; typical data.
    pub mechanism GrindingSpindle {
        /// Speed of the spindle.
        input speed: rpm;

        /// The angle at which the wheel is clamped.
        design skew = 0.02 deg +/- 0.01 deg;
        design radius = 200 mm +/- 0.5 mm;
        design width = 40 mm +/- 0.2 mm;
        /// Moment per unit tilt of the flange.
        design bending = 60 kN*m/rad +/- 10%;

        body shaft: massless;
        body flange: massless;
        body wheel: cylinder(density: 2400 kg/m^3, radius: radius, length: width, axis: z);

        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint bend: universal(alpha: x, beta: y) from shaft to flange;
        joint clamped: fixed from flange to wheel rotated(x, skew);

        force bend_x: spring(on: alpha, stiffness: bending);
        force bend_y: spring(on: beta, stiffness: bending);

        /// Axial run-out of the rim, from its highest to its lowest point.
        output face = 2 * radius * (skew + alpha);
    }
}

/// Working speed, rpm.
pub const WORKING: f64 = 3000.0;

/// The spindle at the given speed, rpm.
pub fn study(speed: f64) -> Study<GrindingSpindle> {
    Study::new(GrindingSpindle).input(GrindingSpindle::speed, speed * RPM)
}

/// Writes the face run-out at rest and at speed, and its causes.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let face = GrindingSpindle::face.index();
    let at = |speed: f64| -> Result<_, Box<dyn Error>> {
        let found = study(speed).output_tolerances()?;
        Ok(found.spreads[face].clone().ok_or("the run-out varies")?)
    };
    let (rest, work) = (at(1.0)?, at(WORKING)?);
    writeln!(
        out,
        "GRINDING SPINDLE: the face runs out by {:.1} um at rest and {:.1} um at {WORKING} rpm, sigma {:.1} um.",
        1e6 * rest.mean,
        1e6 * work.mean,
        1e6 * work.sigma
    )?;
    let share = |k: usize| 100.0 * work.variance_shares[k];
    let (skew, bearing) = (share(GrindingSpindle::skew.index()), share(GrindingSpindle::bending.index()));
    writeln!(out, "Clamping makes {skew:.1} % of the variance, the bearing {bearing:.1} %.")?;
    writeln!(out, "A stiffer bearing changes nothing: clamp against a ground shoulder, or dress at speed.\n")?;
    Ok(())
}
