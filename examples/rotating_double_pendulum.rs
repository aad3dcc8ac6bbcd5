//! Two bars in series on a spinning shaft, the second example of the paper (section 6.2, table 2), and what each of four
//! independent dimensions contributes.
//!
//! `cargo run --release -p eigentol-examples --example rotating_double_pendulum`

use std::error::Error;
use std::io::{self, Write};

use eigentol::{Study, mechanism};

mod cost;

mechanism! {
    /// Two equal bars hinged in series on a shaft that spins at a constant rate; both have the same length `l`.
    pub mechanism RotatingDoublePendulum {
        input  omega: rad/s;

        design m = 3.0 kg;
        design l = 1.0 m +/- 3%;

        gravity 9.81 m/s^2 along -z;

        body shaft: massless;
        body bar1: rod(mass: m, length: l, along: -z);
        body bar2: rod(mass: m, length: l, along: -z);

        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l];

        output angle1 = theta1;
        output angle2 = theta1 + theta2;
    }
}

mechanism! {
    /// The same with bars that are made one by one: every length and mass varies on its own.
    pub mechanism IndependentBars {
        input  omega: rad/s;

        design l1 = 1.0 m  +/- 3%;
        design l2 = 1.0 m  +/- 3%;
        design m1 = 3.0 kg +/- 3%;
        design m2 = 3.0 kg +/- 3%;

        gravity 9.81 m/s^2 along -z;

        body shaft: massless;
        body bar1: rod(mass: m1, length: l1, along: -z);
        body bar2: rod(mass: m2, length: l2, along: -z);

        joint spin:   revolute(z) from ground to shaft, driven at omega;
        joint theta1: revolute(y) from shaft to bar1;
        joint theta2: revolute(y) from bar1 to bar2 at [0, 0, -l1];

        output angle1 = theta1;
        output angle2 = theta1 + theta2;
    }
}

/// Two equal bars, searched for away from the axis: below the critical speed they fall back to it.
pub fn equal() -> Study<RotatingDoublePendulum> {
    let first = RotatingDoublePendulum::theta1;
    Study::new(RotatingDoublePendulum).start(first, 60f64.to_radians())
}

/// Two bars of four dimensions, searched for in the same place.
pub fn independent() -> Study<IndependentBars> {
    Study::new(IndependentBars).start(IndependentBars::theta1, 60f64.to_radians())
}

/// Speeds from 0 to 8 rad/s.
pub fn speeds() -> Vec<f64> {
    (0..=88).map(|k| f64::from(k) / 11.0).collect()
}

/// Writes events and frequencies along the speed, what the tolerances do at some speeds, and what that costs.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (equal, independent, speeds) = (equal(), independent(), speeds());
    let speed = RotatingDoublePendulum::omega;
    writeln!(out, "{}", equal.campbell(speed, &speeds, &[1.0])?)?;
    writeln!(out, "In the paper the resonance is at 1.895 rad/s and the critical speed at 2.679 rad/s.\n")?;
    for value in [1.5, 2.65, 5.0] {
        writeln!(out, "{}", equal.clone().input(speed, value).summary()?)?;
        let independent = independent.clone().input(IndependentBars::omega, value);
        writeln!(out, "{}", independent.first_order()?)?;
    }
    cost::compare(out, &equal, (speed, &speeds), 1414.0)
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
