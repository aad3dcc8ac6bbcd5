//! A fan shakes its mounts: which balance grade does the wheel need so that the bearing stays quiet?
//!
//! ISO 21940-11 states a grade as the eccentricity of the mass times the speed, in mm/s; ISO 14694 admits, for a fan of
//! this kind on flexible mounts, a velocity of 6.3 mm/s (effective value) at the bearings when it is set up.

use std::error::Error;
use std::io::Write;

use eigentol::forced::Measure;
use eigentol::requirement::Requirement;
use eigentol::response::{Response, Vibration};
use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    part Mount(stiffness: N/m, damping: N*s/m) {
        port floor;
        port foot;
        force rubber: bushing(from: floor, to: foot,
            stiffness: [stiffness, stiffness, stiffness], damping: [damping, damping, damping]);
    }

    /// A wheel overhung on a frame that stands on four mounts; typical data.
    pub mechanism Fan {
        /// Speed of the wheel.
        input speed: rpm;

        design wheel_mass = 38 kg +/- 2 %;
        design overhang = 310 mm +/- 2 mm;
        /// Of each mount, along every axis.
        design mount = 220 kN/m +/- 15 % uniform;
        design mount_damping = 420 N*s/m +/- 30 % uniform;
        /// Balance grade: eccentricity times rated speed.
        design grade = 6.3 mm/s;
        design rated = 1480 rpm;
        /// Where the rest of the unbalance sits, nobody knows.
        design angle = 0 deg +/- 180 deg uniform;

        gravity 9.81 m/s^2 along -z;

        body frame: box(mass: 95 kg, size: [700, 500, 300] mm);
        body wheel: cylinder(mass: wheel_mass, radius: 315 mm, length: 160 mm, axis: x);

        joint stand: free(x: x, y: y, z: z, roll: x, pitch: y, yaw: z) from ground to frame;
        joint spin: revolute(x) from frame to wheel at [overhang, 0, 200 mm], driven at speed;

        point bearing: frame at [250, 0, 200] mm;
        for i in 0..2 { for j in 0..2 {
            use corner[2 * i + j]: Mount(stiffness: mount, damping: mount_damping) with
                floor: ground at [300 * (1 - 2 * i), 200 * (1 - 2 * j), -150] mm,
                foot: frame at [300 * (1 - 2 * i), 200 * (1 - 2 * j), -150] mm;
        } }

        unbalance residual: on wheel, eccentricity: grade / rated, angle: angle;

        output across = position(bearing).y;
        output up = position(bearing).z;
        output on_floor = reaction_force(corner[0].rubber).z;
    }
}

/// Working speed, rpm.
pub const WORKING: f64 = 1480.0;

/// Admissible velocity, m/s: amplitude of a sine with the effective value of the standard.
pub const ADMISSIBLE: f64 = 6.3e-3 * std::f64::consts::SQRT_2;

/// The fan at its working speed.
pub fn study() -> Study<Fan> {
    Study::new(Fan).input(Fan::speed, WORKING * RPM)
}

/// The bearing's velocity across the shaft, which is greater than the one upward.
pub fn velocity() -> Vibration {
    Vibration::new(Fan::across, Fan::residual).measure(Measure::Velocity)
}

/// The probability that a fan of a balance grade, m/s, shakes more than admissible.
pub fn too_loud(grade: f64) -> Result<f64, Box<dyn Error>> {
    let limit = Requirement::at_most(Response::Vibration(velocity()), ADMISSIBLE);
    let found = study().design(Fan::grade, grade).samples(4000).chances(&[limit])?;
    Ok(found.all.failure())
}

/// The coarsest grade, m/s, at which 97.7 % of the fans stay below the admissible velocity: amplitudes are proportional
/// to the eccentricity.
pub fn coarsest() -> Result<f64, Box<dyn Error>> {
    let spread = study().vibration_spread(&[velocity()])?;
    let spread = spread.spreads[0].as_ref().ok_or("the fan vibrates")?;
    let upper = spread.quantiles.iter().find(|quantile| quantile.probability > 0.97);
    let upper = upper.ok_or("there are quantiles")?.value;
    Ok(6.3e-3 * ADMISSIBLE / upper)
}

/// Writes the vibration, the grade that is needed, and how many fans of the next coarser one are too loud.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let spread = study().vibration_spread(&[velocity()])?;
    let spread = spread.spreads[0].as_ref().ok_or("the fan vibrates")?;
    writeln!(
        out,
        "FAN: balanced to G 6.3 its bearing moves with {:.1} mm/s, sigma {:.2}, because mounts scatter.",
        1e3 * spread.mean.value,
        1e3 * spread.sigma.ok_or("it varies")?.value,
    )?;
    let grade = coarsest()?;
    writeln!(
        out,
        "Admissible are {:.1} mm/s: G {:.1} keeps 97.7 % of the fans below; solved anew, {:.1} % of 4000 are above.\n",
        1e3 * ADMISSIBLE,
        1e3 * grade,
        100.0 * too_loud(grade)?
    )?;
    Ok(())
}
