//! A heavy disk on an elastic shaft with gyroscopic moments, stationary damping and rotating damping: where are its
//! critical speeds and its limit of stability, and is it safe at its running speed?
//!
//! The machine runs above its first-order critical speeds. Two things can go wrong there: the backward whirl of the
//! tilting disk, which the unbalance can excite through the asymmetric seal, may come within 10 % of the speed; and the
//! rotating damping of the shaft may overcome the stationary damping of the seal.
//!
//! `cargo run --release -p eigentol-examples --example jeffcott_rotor`

use std::error::Error;
use std::io::{self, Write};

use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{InDeclaredUnit, Quantity, Study, mechanism};

mechanism! {
    /// Jeffcott's rotor with the disk nearer to one of its two rigid bearings.
    ///
    /// There the shaft couples displacement and tilt of the disk: with the distances `a` and `b` to the bearings,
    /// `l = a + b` and `EI` it resists with `3 EI l (a^2 - a b + b^2) / (a b)^3`, `3 EI l (a - b) / (a b)^2` and
    /// `3 EI l / (a b)`. Two equal springs at the distances `offset - arm` and `offset + arm` along the axis do the
    /// same. They turn with the shaft, and with them its material damping: stress lags behind strain by a time `lag`.
    ///
    /// A seal around the disk, stiffer upwards than sideways, damps at rest.
    pub mechanism JeffcottRotor {
        /// Speed of the shaft.
        input speed: rpm;

        design modulus = 206 GPa +/- 2%;
        design diameter = 30 mm +/- 0.1 mm;
        design near = 260 mm +/- 1 mm;
        design far = 320 mm +/- 1 mm;
        design lag = 80 us +/- 30%;
        design radius = 250 mm +/- 0.2 mm;
        design width = 30 mm +/- 0.2 mm;
        design seal_x = 150 kN/m +/- 20%;
        design seal_y = 250 kN/m +/- 20%;
        design seal_damping = 80 N*s/m +/- 30%;

        let bending = modulus * pi * diameter^4 / 64;
        let shape = near^2 - near * far + far^2;
        let stiffness = 3 * bending * (near + far) * shape / (near * far)^3;
        let offset = near * far * (near - far) / shape;
        let arm = sqrt((near * far)^3) / shape;
        let spring = stiffness / 2;

        gravity 9.81 m/s^2 along -y;

        body line: massless;
        body across: massless;
        body center: massless;
        body carrier: massless;
        body disk: cylinder(density: 7850 kg/m^3, radius: radius, length: width, axis: z);

        joint turn: revolute(z) from ground to line, driven at speed;
        joint x: prismatic(x) from ground to across;
        joint y: prismatic(y) from across to center;
        joint tilt: universal(alpha: x, beta: y) from center to carrier;
        joint spin: revolute(z) from carrier to disk, driven at speed;

        point straight1: line at [0, 0, offset - arm];
        point straight2: line at [0, 0, offset + arm];
        point bent1: carrier at [0, 0, offset - arm];
        point bent2: carrier at [0, 0, offset + arm];
        force shaft1: bushing(from: straight1, to: bent1,
            stiffness: [spring, spring, 0], damping: [lag * spring, lag * spring, 0]);
        force shaft2: bushing(from: straight2, to: bent2,
            stiffness: [spring, spring, 0], damping: [lag * spring, lag * spring, 0]);

        force sideways: spring(on: x, stiffness: seal_x);
        force upwards: spring(on: y, stiffness: seal_y);
        force water_x: damper(on: x, damping: seal_damping);
        force water_y: damper(on: y, damping: seal_damping);
    }
}

/// The rotor at its running speed.
pub fn study() -> Study<JeffcottRotor> {
    Study::new(JeffcottRotor).input(JeffcottRotor::speed, InDeclaredUnit(3000.0))
}

/// The number, from 0, of the backward whirl of the tilting disk.
pub const TILTING: usize = 2;

/// The backward whirl of the tilting disk stays away from the speed.
#[must_use]
pub fn resonance() -> Requirement {
    let tilting = Response::Mode { mode: TILTING, quantity: Quantity::Frequency };
    Requirement::away(tilting, JeffcottRotor::speed.any(), 0.1)
}

/// Writes the Campbell diagram with its events, what tolerances do at the running speed, and the risks there.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (study, speed) = (study(), JeffcottRotor::speed);
    let speeds: Vec<_> = (0..=60).map(|k| InDeclaredUnit(100.0 * f64::from(k))).collect();
    writeln!(out, "{}", study.campbell(speed, &speeds, &[1.0, 2.0])?)?;
    for limit in study.flutter_onset_tolerances(speed, speeds[0], speeds[60])? {
        writeln!(out, "{limit}")?;
    }
    writeln!(out, "{}", study.summary()?)?;
    write!(out, "{}", study.probability(&[resonance(), Requirement::Stable])?)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
