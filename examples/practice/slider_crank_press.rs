//! How hard does this press strike at a given torque, and do the blows vary because of the material or the lengths?
//!
//! Near the dead centre the force of the ram grows without limit, `F = M / (dx / d phi)`, so small errors in length
//! matter.

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

mechanism! {
    /// An eccentric press of about 60 kN, at rest against an elastic workpiece; typical data.
    pub mechanism SliderCrankPress {
        /// Torque on the crank.
        input torque: N*m;

        design crank = 60 mm +/- 0.05 mm;
        design rod = 300 mm +/- 0.1 mm;
        /// Distance from the crank axis at which the ram meets the workpiece.
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

/// Clutch torque, N m.
pub const TORQUE: f64 = 2000.0;

/// The press at rest against the workpiece.
pub fn study() -> Study<SliderCrankPress> {
    Study::new(SliderCrankPress)
        .input(SliderCrankPress::torque, TORQUE)
        .start(SliderCrankPress::angle, 30f64.to_radians())
        .guess(SliderCrankPress::guide, 0.35)
}

/// Writes the blow, its scatter, and the causes of the scatter.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = study();
    let spreads = study.output_tolerances()?;
    let blow = spreads.spreads[SliderCrankPress::blow.index()].as_ref().ok_or("the blow varies")?;
    let worst = 3.0 * blow.sigma / blow.mean;
    writeln!(
        out,
        "SLIDER-CRANK PRESS: {:.1} kN with {TORQUE} N m, +/- {:.1} % (3 sigma).",
        1e-3 * blow.mean,
        100.0 * worst
    )?;
    let lengths: f64 = blow.variance_shares[..3].iter().sum();
    let (lengths, material) = (100.0 * lengths, 100.0 * blow.variance_shares[3]);
    writeln!(out, "The material makes {material:.0} % of the variance, all lengths together {lengths:.0} %.")?;
    writeln!(out, "Tighter lengths are money lost: sort the blanks by thickness and hardness.\n")?;
    Ok(())
}
