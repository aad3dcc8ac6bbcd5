//! At which speed does the first bending mode of a tapered, twisted fan blade meet twice the speed, and how well must its
//! thickness be kept?
//!
//! Bending stiffness grows with the cube of the thickness, mass with the thickness: at rest the frequency is
//! proportional to it. The stiffening by centrifugal forces is not, so the tolerance matters less the faster the fan.

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use eigentol::sweep::EventTolerance;
use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// An aluminium blade of an axial fan, clamped at its hub; typical data.
    pub mechanism FlexibleBlade {
        /// Speed of the fan.
        input speed: rpm;

        design length = 600 mm +/- 0.5 mm;
        design hub = 150 mm;
        design chord = 120 mm;
        design tip_chord = 70 mm;
        design thickness = 10 mm +/- 0.3 mm;
        design tip_thickness = 4 mm +/- 0.3 mm;
        /// Of the section at the root against the plane of rotation.
        design setting = 35 deg +/- 1 deg;
        /// From the root to the tip.
        design washout = -20 deg;
        design modulus = 70 GPa +/- 2 %;

        material aluminium: density 2700 kg/m^3, modulus modulus, poisson 0.33;

        body rotor: massless;
        body blade: beam(length: length, along: x, up: z,
            section: rectangle(width: chord, height: thickness) to rectangle(width: tip_chord, height: tip_thickness),
            material: aluminium, bending: 4, torsion: 0, twist: washout);

        joint spin: revolute(z) from ground to rotor, driven at speed;
        joint clamp: fixed from rotor to blade at [hub, 0, 0] rotated(x, setting);
    }
}

/// Working speed, rpm.
pub const WORKING: f64 = 1200.0;

/// The blade at its working speed.
pub fn study() -> Study<FlexibleBlade> {
    Study::new(FlexibleBlade).input(FlexibleBlade::speed, WORKING * RPM)
}

/// The first bending frequency at a speed in rpm, Hz.
pub fn frequency(speed: f64) -> Result<f64, Box<dyn Error>> {
    let modes = study().input(FlexibleBlade::speed, speed * RPM).modes()?;
    Ok(modes.frequencies()[0].ok_or("the blade vibrates")? / TAU)
}

/// The speed at which the first bending frequency meets twice that speed.
pub fn meeting() -> Result<EventTolerance, Box<dyn Error>> {
    let (low, high) = (300.0 * RPM, 3000.0 * RPM);
    let found = study().crossing_tolerances(FlexibleBlade::speed, low, high, 2.0)?;
    Ok(found.into_iter().next().ok_or("no crossing")?)
}

/// Writes the frequency against speed, the resonance and what spreads it.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    writeln!(
        out,
        "FLEXIBLE BLADE: {:.2} Hz at rest, {:.2} Hz at {WORKING} rpm.",
        frequency(0.0)?,
        frequency(WORKING)?
    )?;
    let at = meeting()?;
    let spread = at.spread?;
    let share = |variable: eigentol::DesignVariable<FlexibleBlade>| 100.0 * spread.variance_shares[variable.index()];
    writeln!(
        out,
        "It meets twice the speed at {:.0} rpm, sigma {:.1}: {:.1} sigma from the working speed.",
        at.value / RPM,
        spread.sigma / RPM,
        (at.value / RPM - WORKING).abs() / (spread.sigma / RPM)
    )?;
    writeln!(
        out,
        "Of the variance {:.0} % come from the thickness at the root and {:.0} % from that at the tip.\n",
        share(FlexibleBlade::thickness),
        share(FlexibleBlade::tip_thickness)
    )?;
    Ok(())
}
