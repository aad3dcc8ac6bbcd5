//! At which speed do the oil films make this rotor unstable, and how certain is that speed?

use std::error::Error;
use std::io::Write;

use eigentol::{Study, mechanism};

use super::RPM;

mechanism! {
    /// A stiff rotor in two plain journal bearings.
    ///
    /// The oil film resists a displacement across it as well as along it. Its coefficients change with the speed; these
    /// are those of a short bearing (F. W. Ocvirk, 1952) 50 mm long and 100 mm wide, with a radial clearance of 0.1 mm,
    /// oil of 20 mPa s and about half the weight to carry (formulas: M. I. Friswell et al., Dynamics of Rotating
    /// Machines, 2010, section 5.5). They hold about the place to which the load has moved the journal: coordinates are
    /// counted from there, and weight is not declared again.
    pub mechanism RotorBearings {
        /// Speed of the rotor.
        input speed: rpm;
        design radius = 70 mm +/- 0.1 mm;
        design length = 800 mm +/- 0.5 mm;
        design near = 300 mm +/- 1 mm;
        design far = 400 mm +/- 1 mm;
        /// What stiffness and damping of the film have of their calculated values.
        design stiffness_factor = 1 +/- 15%;
        design damping_factor = 1 +/- 15%;
        curve kxx: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [12.15, 12.39, 12.44, 12.46, 12.47, 12.48] MN/m;
        curve kxy: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [20.39, 41.05, 61.64, 82.21, 102.8, 123.3] MN/m;
        curve kyx: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [-26.91, -44.58, -64.03, -84.02, -104.2, -124.6] MN/m;
        curve kyy: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [7.513, 6.608, 6.411, 6.34, 6.306, 6.288] MN/m;
        curve cxx: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [208.4, 199.7, 197.9, 197.2, 196.9, 196.7] kN*s/m;
        curve cxy: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [-58.17, -29.6, -19.81, -14.88, -11.91, -9.931] kN*s/m;
        curve cyy: [2000, 4000, 6000, 8000, 10000, 12000] rpm -> [243.3, 209.1, 202.1, 199.6, 198.5, 197.8] kN*s/m;
        let stiffness = stiffness_factor * [[kxx(speed), kxy(speed), 0], [kyx(speed), kyy(speed), 0], [0, 0, 0]];
        let damping = damping_factor * [[cxx(speed), cxy(speed), 0], [cxy(speed), cyy(speed), 0], [0, 0, 0]];
        body across: massless;
        body center: massless;
        body carrier: massless;
        body rotor: cylinder(density: 7850 kg/m^3, radius: radius, length: length, axis: z);
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to center;
        joint tilt: universal(alpha: x, beta: y) from center to carrier;
        joint spin: revolute(z) from carrier to rotor, driven at speed;
        point seat1: ground at [0, 0, -near];
        point seat2: ground at [0, 0, far];
        point journal1: carrier at [0, 0, -near];
        point journal2: carrier at [0, 0, far];
        force bearing1: bushing(from: seat1, to: journal1, stiffness: stiffness, damping: damping);
        force bearing2: bushing(from: seat2, to: journal2, stiffness: stiffness, damping: damping);
    }
}

/// The rotor at its working speed.
pub fn study() -> Study<RotorBearings> {
    Study::new(RotorBearings).input(RotorBearings::speed, 6000.0 * RPM)
}

/// Writes the stability limit, and what makes it uncertain.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (study, low, high) = (study(), 2000.0 * RPM, 12000.0 * RPM);
    let limits = study.flutter_onset_tolerances(RotorBearings::speed, low, high)?;
    let limit = limits.first().ok_or("stable at all these speeds")?;
    let spread = limit.spread.as_ref().map_err(Clone::clone)?;
    let (speed, sigma) = (limit.value / RPM, spread.sigma / RPM);
    writeln!(out, "ROTOR BEARINGS: stable up to {speed:.0} rpm, sigma {sigma:.0} rpm.")?;
    let film = 100.0 * (spread.variance_shares[4] + spread.variance_shares[5]);
    writeln!(out, "{film:.1} % of the variance is in the film: measure that before tightening anything else.\n")?;
    Ok(())
}
