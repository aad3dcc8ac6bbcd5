//! Ground resonance: how likely is it that the beat of the blades' lag motion meets the rocking frequency of the
//! helicopter on its wheels?
//!
//! In the frame of the body the regressing lag motion has the frequency `Omega - omega_lag`. Where this meets the
//! frequency of the body on its landing gear, both motions grow (R. P. Coleman and A. M. Feingold, NACA report 1351,
//! 1958).

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Quantity, Study, mechanism};

mechanism! {
    /// One blade of a light helicopter with coincident flap and lag hinges and an elastomeric lag bearing; typical
    /// data.
    pub mechanism HelicopterBlade {
        /// Speed of the rotor.
        input rotor: rad/s;

        design mass = 40 kg +/- 1%;
        design length = 5.7 m +/- 5 mm;
        design hinge = 300 mm +/- 1 mm;
        /// The stiffness of elastomers scatters, and they soften when warm.
        design elastomer = 40 kN*m/rad +/- 15%;
        /// Moment of the lift about the flap hinge.
        design lift = 26 kN*m +/- 5%;

        body hub: massless;
        body blade: rod(mass: mass, length: length, along: x);

        joint spin: revolute(z) from ground to hub, driven at rotor;
        joint root: universal(flap: -y, lag: z) from hub to blade at [hinge, 0, 0];

        force bearing: spring(on: lag, stiffness: elastomer);
        force air: generalized(on: flap, value: lift - 6 kN*m*s/rad * rate(flap));

        output coning = flap;
    }
}

/// Rotor speed in flight, rad/s.
pub const FLIGHT: f64 = 40.0;
/// Range of frequencies at which the body rocks on its landing gear, Hz.
const ROCKING: [f64; 2] = [3.6, 3.95];

/// The blade in flight.
pub fn study() -> Study<HelicopterBlade> {
    Study::new(HelicopterBlade).input(HelicopterBlade::rotor, FLIGHT)
}

/// Writes the frequencies per revolution, and the probability of the rocking band.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let study = study();
    let frequencies = study.modes()?.frequencies();
    let [Some(lag), Some(flap)] = frequencies[..] else {
        return Err("both motions oscillate".into());
    };
    let [high, low] = ROCKING.map(|rocking| FLIGHT - TAU * rocking);
    let response = Response::Mode { mode: 0, quantity: Quantity::Frequency };
    let wanted = Requirement::Outside { response, low, high };
    let probability = study.probability(&[wanted])?.each[0].value;
    let first = study.first_order()?;
    let spread = first.modes[0].frequency().ok_or("the lag motion oscillates")?;
    let [lag_ratio, flap_ratio] = [lag / FLIGHT, flap / FLIGHT];
    let [beat, sigma] = [(FLIGHT - lag) / TAU, spread.sigma / TAU];
    let [slow, fast] = ROCKING;
    let one_in = 1.0 / probability;
    writeln!(out, "HELICOPTER BLADE: lag {lag_ratio:.3}, flap {flap_ratio:.3} per revolution.")?;
    writeln!(out, "The lag motion beats at {beat:.2} Hz, sigma {sigma:.3} Hz; the body rocks at {slow} to {fast} Hz.")?;
    writeln!(out, "One helicopter in {one_in:.0} is at risk on the ground: sort the elastomers.\n")?;
    Ok(())
}
