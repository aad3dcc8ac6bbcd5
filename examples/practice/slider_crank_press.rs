//! How hard does this press strike with a given torque, and is it the material or the lengths that make blows differ?
//!
//! Near the dead centre the ram gains force without limit, `F = M / (dx / d phi)`, so that small errors of length count.

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

mechanism! {
    /// An eccentric press of some 60 kN, standing against a work piece that springs back; typical data.
    pub mechanism SliderCrankPress {
        /// Torque on the crank.
        input torque: N*m;

        design crank = 60 mm +/- 0.05 mm;
        design rod = 300 mm +/- 0.1 mm;
        /// Where the ram meets the work piece, from the axis of the crank.
        design contact = 248 mm +/- 0.1 mm;
        design stiffness = 20 kN/mm +/- 10%;

        body shaft: cylinder(mass: 60 kg, radius: 150 mm, length: 200 mm, axis: y);
        body link: rod(mass: 12 kg, length: rod, along: x);
        body ram: point(mass: 80 kg);

        joint angle: revolute(-y) from ground to shaft;
        joint big_end: revolute(-y) from shaft to link at [crank, 0, 0];
        joint small_end: revolute(-y) from link to ram at [rod, 0, 0];
        joint guide: prismatic(x) from ground to ram;

        force drive: generalized(on: angle, value: torque);
        force piece: spring(on: guide, stiffness: stiffness, rest: contact);

        output crank_angle = angle;
        output blow = stiffness * (guide - contact);
        output on_pin = norm(reaction_force(small_end));
    }
}

/// Torque of the clutch, N m.
pub const TORQUE: f64 = 2000.0;

/// The press at rest against the work piece.
pub fn study() -> Study<SliderCrankPress> {
    Study::new(SliderCrankPress)
        .input(SliderCrankPress::torque, TORQUE)
        .start(SliderCrankPress::angle, 30f64.to_radians())
        .guess(SliderCrankPress::guide, 0.35)
}

/// The blow, its scatter, and its causes.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = study();
    let spreads = study.output_tolerances()?;
    let blow = spreads.spreads[SliderCrankPress::blow.index()]
        .as_ref()
        .ok_or("the blow varies")?;
    let worst = 3.0 * blow.sigma / blow.mean;
    writeln!(
        out,
        "SLIDER-CRANK PRESS: {:.1} kN with {TORQUE} N m, +/- {:.1} % (3 sigma).",
        1e-3 * blow.mean,
        100.0 * worst
    )?;
    let lengths: f64 = blow.variance_shares[..3].iter().sum();
    let (lengths, material) = (100.0 * lengths, 100.0 * blow.variance_shares[3]);
    writeln!(
        out,
        "The material makes {material:.0} % of the variance, all lengths together {lengths:.0} %."
    )?;
    writeln!(
        out,
        "Tighter lengths are money lost: sort the blanks by thickness and hardness.\n"
    )?;
    Ok(())
}
