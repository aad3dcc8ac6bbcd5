//! A pendulum on a spinning shaft: its frequency, how far the tolerance of its length spreads it, and how probable it is
//! that it falls below 4 rad/s.

use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Quantity, Study, mechanism};

mechanism! {
    /// A uniform bar hinged on a shaft that spins at a constant rate.
    pub mechanism Pendulum {
        input  omega: rad/s;

        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;

        gravity 9.81 m/s^2 along -z;

        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);

        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;
    }
}

fn main() -> Result<(), eigentol::Error> {
    let study = Study::new(Pendulum)
        .input(Pendulum::omega, 5.0)
        .start(Pendulum::theta, 1.0);
    println!("{}\n{}", study.equilibrium()?, study.modes()?);
    println!("{}", study.first_order()?);
    let frequency = Response::Mode {
        mode: 0,
        quantity: Quantity::Frequency,
    };
    let wanted = [Requirement::at_least(frequency, 4.0)];
    println!("{}", study.probability(&wanted)?);
    Ok(())
}
