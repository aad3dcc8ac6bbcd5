//! A robot arm on a turntable welds: how far does its tip move when the table turns, and why do arms of one series
//! differ?

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// Shoulder and elbow of an arm mounted off the axis of a turntable; servos and gearboxes act as springs; typical
    /// data.
    pub mechanism TurntableArm {
        /// Speed of the table.
        input table: rpm;

        design payload = 5 kg +/- 0.5 kg;
        design shoulder = 40 kN*m/rad +/- 5%;
        design elbow = 20 kN*m/rad +/- 5%;
        design upper = 700 mm +/- 0.2 mm;
        design fore = 600 mm +/- 0.2 mm;

        gravity 9.81 m/s^2 along -z;
        body base: massless;
        body upper_arm: rod(mass: 12 kg, length: upper, along: x);
        body forearm: rod(mass: 7 kg, length: fore, along: x) + point(mass: payload) at [fore, 0, 0];

        joint turn: revolute(z) from ground to base, driven at table;
        joint q1: revolute(-y) from base to upper_arm at [200 mm, 0, 800 mm] rotated(y, -40 deg);
        joint q2: revolute(-y) from upper_arm to forearm at [upper, 0, 0] rotated(y, 60 deg);

        force servo1: spring(on: q1, stiffness: shoulder);
        force servo2: spring(on: q2, stiffness: elbow);

        point tip: forearm at [fore, 0, 0];
        output height = position(tip).z;
    }
}

/// Working speed of the table, rpm.
pub const WORKING: f64 = 30.0;

/// The arm on a table turning at the given speed, rpm.
pub fn study(speed: f64) -> Study<TurntableArm> {
    Study::new(TurntableArm).input(TurntableArm::table, speed * RPM)
}

/// Writes the height of the tip, the effect of the rotation, and the effect of tolerances.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let still = study(0.0).output_tolerances()?.values[0];
    let working = study(WORKING);
    let spreads = working.output_tolerances()?;
    let spread = spreads.spreads[TurntableArm::height.index()].as_ref().ok_or("the height varies")?;
    let moved = 1e3 * (spread.mean - still);
    writeln!(
        out,
        "TURNTABLE ARM: {WORKING} rpm move the height of the tip by {moved:.2} mm, sigma over a series {:.2} mm.",
        1e3 * spread.sigma
    )?;
    let names = working.description().design.iter().map(|info| &*info.name);
    let mut causes: Vec<_> = spread.variance_shares.iter().zip(names).collect();
    causes.sort_by(|a, b| b.0.total_cmp(a.0));
    let first: Vec<String> =
        (causes.iter().take(3)).map(|(share, name)| format!("{name} {:.0} %", 100.0 * **share)).collect();
    writeln!(out, "The scatter comes from {}: weigh the tool and calibrate the shoulder.", first.join(", "))?;
    let lowest = working.modes()?.frequencies()[0].ok_or("the arm swings")?;
    writeln!(
        out,
        "It swings at {:.1} Hz: keep the path of the weld slower than that.\n",
        lowest / std::f64::consts::TAU
    )?;
    Ok(())
}
