//! How much do the gears, and how much does the bending of a slender link, take from the accuracy and the lowest frequency
//! of a robot arm?

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use eigentol::{Study, mechanism};

mechanism! {
    /// A long arm with a tube for its upper link, stretched out; typical data.
    pub mechanism FlexibleArm {
        design upper = 1.2 m;
        design fore = 0.8 m;
        design outer = 45 mm;
        design inner = 42 mm +/- 0.1 mm;
        design tube_density = 2700 kg/m^3;
        design modulus = 70 GPa +/- 2 %;
        design fore_mass = 4 kg;
        design payload = 5 kg +/- 0.1 kg;
        /// Of the gears.
        design shoulder_gear = 120 kN*m/rad +/- 15 %;
        design elbow_gear = 40 kN*m/rad +/- 15 %;

        gravity 9.81 m/s^2 along -z;

        body link: beam(length: upper, along: x, up: z, section: tube(outer: outer, inner: inner),
            density: tube_density, modulus: modulus, bending_y: 4);
        body forearm: rod(mass: fore_mass, length: fore, along: x);
        body tool: point(mass: payload);

        joint shoulder: revolute(-y) from ground to link;
        joint elbow: revolute(-y) from link at tip to forearm;
        joint grip: fixed from forearm to tool at [fore, 0, 0];

        force shoulder_drive: spring(on: shoulder, stiffness: shoulder_gear);
        force elbow_drive: spring(on: elbow, stiffness: elbow_gear);

        point end: tool;
        output height = position(end).z;
    }
}

/// The arm stretched out.
pub fn study() -> Study<FlexibleArm> {
    Study::new(FlexibleArm)
}

/// Height of the tool, m, and lowest frequency, Hz.
pub fn of(study: &Study<FlexibleArm>) -> Result<[f64; 2], Box<dyn Error>> {
    let height = study.outputs()?.values[FlexibleArm::height.index()];
    let lowest = study.modes()?.frequencies()[0].ok_or("the arm swings")?;
    Ok([height, lowest / TAU])
}

/// Writes sag and frequency with and without the bending of the link, and what spreads the sag.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let [height, lowest] = of(&study())?;
    let [rigid_height, rigid_lowest] = of(&study().design(FlexibleArm::modulus, 70e15))?;
    writeln!(
        out,
        "FLEXIBLE ARM: the tool sags by {:.2} mm and swings at {lowest:.2} Hz; with a rigid link {:.2} mm and {rigid_lowest:.2} Hz.",
        -1e3 * height,
        -1e3 * rigid_height,
    )?;
    let spreads = study().output_tolerances()?;
    let spread = spreads.spreads[FlexibleArm::height.index()].as_ref().ok_or("the height varies")?;
    let share = |variable: eigentol::DesignVariable<FlexibleArm>| 100.0 * spread.variance_shares[variable.index()];
    writeln!(
        out,
        "Its height scatters with a sigma of {:.2} mm, {:.0} % of the variance from the gears, {:.0} % from the link.",
        1e3 * spread.sigma,
        share(FlexibleArm::shoulder_gear) + share(FlexibleArm::elbow_gear),
        share(FlexibleArm::inner) + share(FlexibleArm::modulus)
    )?;
    writeln!(out, "A model with joint springs only is too stiff by a factor of {:.1}.\n", height / rigid_height)?;
    Ok(())
}
