//! How far does a slender glass-fibre boom bend under its load, how near is it to breaking, and how does it swing when it
//! is bent?
//!
//! Linear theory answers none of these: it puts the tip farther out than the boom is long, and misses a quarter of the
//! frequency.

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::io::Write;

use eigentol::{Study, mechanism};

mechanism! {
    /// A round rod that rises from its clamp and carries a load at its tip; typical data.
    pub mechanism BentBoom {
        /// At the tip.
        input load: kg;

        design length = 3 m +/- 5 mm;
        design radius = 8 mm +/- 0.1 mm;
        design modulus = 40 GPa +/- 4 %;
        design density = 1900 kg/m^3;
        /// Of the clamp above the horizontal.
        design rise = 30 deg +/- 0.5 deg;

        gravity 9.81 m/s^2 along -z;

        body boom: beam(length: length, along: x, up: z, section: circle(radius: radius),
            density: density, modulus: modulus, bending_y: 6);
        body weight: point(mass: load);

        joint clamp: fixed from ground to boom at [0, 0, 0] rotated(-y, rise);
        joint hook: fixed from boom at tip to weight;

        point end: weight;
        output reach = position(end).x;
        output height = position(end).z;
        /// Largest strain, on the surface at the root.
        output strain = reaction_moment(clamp).y / (modulus * (pi * radius^3 / 4));
    }
}

/// Working load, kg.
pub const WORKING: f64 = 4.0;

/// Strain at which glass fibre in resin breaks in bending, with a safety factor of 2.
pub const ADMISSIBLE: f64 = 0.012;

/// The boom under a load, kg.
pub fn study(load: f64) -> Study<BentBoom> {
    Study::new(BentBoom).input(BentBoom::load, load)
}

/// What linear theory says: how far out the tip is, m, its height, m, and the frequency, Hz, by Rayleigh's quotient with
/// the shape under a load at the tip.
pub fn linear() -> [f64; 3] {
    let (length, radius, rise) = (3.0_f64, 8e-3_f64, 30f64.to_radians());
    let stiffness = 40e9 * PI * radius.powi(4) / 4.0;
    let mass = 1900.0 * PI * radius * radius * length;
    let force = 9.81 * rise.cos() * (WORKING / 3.0 + mass / 8.0);
    let deflection = force * length.powi(3) / stiffness;
    let moved = WORKING + 33.0 / 140.0 * mass;
    [
        length * rise.cos() + deflection * rise.sin(),
        length * rise.sin() - deflection * rise.cos(),
        (3.0 * stiffness / (moved * length.powi(3))).sqrt() / TAU,
    ]
}

/// Writes the place of the tip, the strain at the root, and the frequency bent and, as linear theory has it, straight.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = study(WORKING);
    let spreads = study.output_tolerances()?;
    let own = |output: eigentol::Output<BentBoom>| {
        let spread = spreads.spreads[output.index()].as_ref();
        spread.map(|spread| (spread.mean, spread.sigma)).ok_or("it varies")
    };
    let ((reach, _), (height, sigma)) = (own(BentBoom::reach)?, own(BentBoom::height)?);
    let [linear_reach, linear_height, linear_frequency] = linear();
    writeln!(
        out,
        "BENT BOOM: the tip is {reach:.2} m out at a height of {height:.2} m, sigma {:.0} mm; linear theory says {linear_reach:.2} m and {linear_height:.2} m.",
        1e3 * sigma
    )?;
    let (strain, sigma) = own(BentBoom::strain)?;
    writeln!(
        out,
        "The strain at the root is {:.2} %, sigma {:.3} %; {:.1} % are admissible.",
        100.0 * strain.abs(),
        100.0 * sigma,
        100.0 * ADMISSIBLE
    )?;
    let lowest = study.modes()?.frequencies()[0].ok_or("the boom swings")?;
    writeln!(
        out,
        "Bent like this it swings at {:.3} Hz; straight it would at {linear_frequency:.3} Hz.\n",
        lowest / TAU
    )?;
    Ok(())
}
