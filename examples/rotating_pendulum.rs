//! A bar on a spinning shaft, the first example of the paper (section 6.1, table 1): how does a tolerance of its length
//! spread its frequency, up to which speed does it hang, and when is it in resonance with the drive?
//!
//! `cargo run --release -p eigentol-examples --example rotating_pendulum`

use std::error::Error;
use std::io::{self, Write};

use eigentol::{Study, mechanism};

mod cost;

mechanism! {
    /// A uniform bar hinged on a shaft that spins at a constant rate.
    pub mechanism RotatingPendulum {
        input  omega: rad/s;

        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;

        gravity 9.81 m/s^2 along -z;

        body shaft: massless;
        body bar: rod(mass: m, length: l, along: -z);

        joint spin:  revolute(z) from ground to shaft, driven at omega;
        joint theta: revolute(y) from shaft to bar;

        output angle = theta;
    }
}

/// The bar, searched for away from the axis: below the critical speed it falls back to it.
pub fn study() -> Study<RotatingPendulum> {
    Study::new(RotatingPendulum).start(RotatingPendulum::theta, 60f64.to_radians())
}

/// Speeds from 0 to 8 rad/s.
pub fn speeds() -> Vec<f64> {
    (0..=88).map(|k| f64::from(k) / 11.0).collect()
}

/// Writes events and frequencies along the speed, what the tolerance does at some speeds, and what that costs.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (study, speeds) = (study(), speeds());
    let speed = RotatingPendulum::omega;
    writeln!(out, "{}", study.campbell(speed, &speeds, &[1.0])?)?;
    writeln!(out, "In the paper the resonance is at 2.712 rad/s and the critical speed at 3.835 rad/s.\n")?;
    for value in [2.0, 3.8, 5.0] {
        writeln!(out, "{}", study.clone().input(speed, value).summary()?)?;
    }
    cost::compare(out, &study, (speed, &speeds), 1179.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
