//! At which speed does this governor begin to lift its sleeve, where does it hold the engine, and how much do both
//! scatter?
//!
//! The balls of a Porter governor swing at the height `h = (1 + M / m) g / Omega^2` below the hinge, whatever the
//! length of the arms (T. Bevan, The Theory of Machines, 1939).

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// One side of a Porter governor: a ball of 1 kg between two arms and half of a sleeve of 8 kg. All joints are on
    /// the axis of the spindle; typical data.
    pub mechanism FlyBallGovernor {
        input speed: rpm;
        design arm = 200 mm +/- 0.2 mm;
        design ball = 1 kg +/- 1%;
        design half_sleeve = 4 kg +/- 1%;
        gravity 9.81 m/s^2 along -z;
        body spindle: massless;
        body upper: massless;
        body flyball: point(mass: ball);
        body lower: massless;
        body collar: point(mass: half_sleeve);

        joint spin: revolute(z) from ground to spindle, driven at speed;
        joint swing: revolute(-y) from spindle to upper;
        joint screwed: fixed from upper to flyball at [0, 0, -arm];
        joint elbow: revolute(-y) from upper to lower at [0, 0, -arm];
        joint eye: revolute(-y) from lower to collar at [0, 0, -arm];
        joint slide: prismatic(z) from spindle to collar;

        output height = arm * cos(swing);
        output lift = slide + 2 * arm;
    }
}

/// Speed at which the governor is to hold the engine, rpm.
pub const HELD: f64 = 240.0;

/// The governor with its balls swung out.
pub fn study() -> Study<FlyBallGovernor> {
    let angle = 50f64.to_radians();
    Study::new(FlyBallGovernor)
        .input(FlyBallGovernor::speed, HELD * RPM)
        .start(FlyBallGovernor::swing, angle)
        .guess(FlyBallGovernor::elbow, -2.0 * angle)
        .guess(FlyBallGovernor::slide, -0.4 * angle.cos())
}

/// Writes the critical speed at which the hanging position becomes unstable, and the sleeve position at the governed
/// speed.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (speed, lift) = (FlyBallGovernor::speed, FlyBallGovernor::lift.index());
    let begins = Study::new(FlyBallGovernor).critical_tolerance(speed, 100.0 * RPM, 300.0 * RPM)?;
    let (rise, sigma) = (begins.value / RPM, begins.spread?.sigma / RPM);
    writeln!(out, "FLY-BALL GOVERNOR: the sleeve rises from {rise:.2} rpm, sigma {sigma:.2} rpm.")?;
    let study = study();
    let spreads = study.output_tolerances()?.spreads;
    let spread = spreads[lift].as_ref().ok_or("the lift varies")?;
    let slopes = study.outputs()?.by_input;
    let slope = slopes[lift].as_ref().ok_or("the lift has a slope")?[0];
    let (at, sigma, scatter) = (1e3 * spread.mean, 1e3 * spread.sigma, spread.sigma / slope / RPM);
    writeln!(out, "At {HELD} rpm it stands {at:.1} mm up, sigma {sigma:.2} mm:")?;
    writeln!(out, "a valve set to that place holds the engine within {scatter:.2} rpm (sigma).\n")?;
    Ok(())
}
