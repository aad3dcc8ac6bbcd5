//! One tube is overfilled: how far does the head run out at working speed, and how close is the critical speed?
//!
//! An unbalance `m r` deflects the spindle by `m r Omega^2 / (k - M Omega^2)` (H. H. Jeffcott, 1919).

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// The head of a laboratory centrifuge on its spindle, in the rotating frame of the head; typical data.
    pub mechanism Centrifuge {
        /// Speed of the head.
        input speed: rpm;

        /// Excess mass in one tube relative to the opposite one.
        design overfill = 2 g +/- 1 g;
        design radius = 150 mm +/- 0.5 mm;
        design head = 6 kg +/- 50 g;
        design spindle = 3 kN/mm +/- 4%;

        body shaft: massless;
        body across: massless;
        body rotor: point(mass: head) + point(mass: overfill) at [radius, 0, 0];

        joint spin: revolute(z) from ground to shaft, driven at speed;
        joint x: prismatic(x) from shaft to across;
        joint y: prismatic(y) from across to rotor;

        force bend_x: spring(on: x, stiffness: spindle);
        force bend_y: spring(on: y, stiffness: spindle);

        output run_out = sqrt(x^2 + y^2);
    }
}

/// Working speed, rpm.
pub const WORKING: f64 = 6000.0;
/// Run-out that the bearings tolerate, m.
const ALLOWED: f64 = 0.3e-3;

/// The centrifuge at its working speed.
pub fn study() -> Study<Centrifuge> {
    Study::new(Centrifuge).input(Centrifuge::speed, WORKING * RPM)
}

/// Writes the speed margin and the run-out.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = study();
    // In the frame of the head, the frequency of the slower mode is the critical speed minus the speed of the head.
    let first = study.first_order()?;
    let beat = first.modes[0].frequency().ok_or("the head whirls")?;
    let (margin, sigma) = (beat.mean / RPM, beat.sigma / RPM);
    writeln!(out, "CENTRIFUGE: the critical speed is {margin:.0} rpm above {WORKING} rpm, sigma {sigma:.0} rpm.")?;
    let spreads = study.output_tolerances()?;
    let spread = spreads.spreads[Centrifuge::run_out.index()].as_ref().ok_or("the run-out varies")?;
    let (mean, sigma) = (1e3 * spread.mean, 1e3 * spread.sigma);
    writeln!(out, "There the head runs out by {mean:.3} mm, sigma {sigma:.3} mm.")?;
    let most = (ALLOWED - spread.mean) / spread.sigma;
    let part = 100.0 * spread.variance_shares[Centrifuge::overfill.index()];
    writeln!(
        out,
        "The bearings bear {:.2} mm, {most:.1} sigma more; {part:.0} % of the scatter is in the filling.\n",
        1e3 * ALLOWED
    )?;
    Ok(())
}
