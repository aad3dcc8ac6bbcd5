//! A bar on a spinning shaft: the first example of the paper (section 6.1, figures 3 to 7, table 1).
//!
//! `cargo run --release --example rotating_pendulum`

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use eigentol::{Study, mechanism};
use eigentol_examples::pictures::{angles, deviations, frequencies, means};
use eigentol_examples::summary::Paper;
use eigentol_examples::{Analysis, Failure, Options, Question, program};

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

const PAPER: Paper = Paper {
    resonance: 2.712,
    critical: 3.835,
    ratio: 1179.0,
};

/// Runs the whole example: command-line `arguments`, summary to `out`, figures and `sweep.csv` to a directory.
pub fn run(arguments: Vec<OsString>, out: &mut dyn Write) -> Result<(), Failure> {
    let about = "How a tolerance of its length spreads the frequency of a spinning bar";
    let options = Options::parse("rotating_pendulum", about, arguments)?;

    let study = Study::new(RotatingPendulum).start(RotatingPendulum::theta, 60f64.to_radians());
    let question = Question {
        speed: RotatingPendulum::omega.any(),
        range: (0.0, 8.0),
        varied: vec![RotatingPendulum::l.any()],
        levels: vec![0.03, 0.06, 0.12],
    };
    let analysis = Analysis::run(&study, &question, &options)?;

    let data = analysis.sweeps();
    let figures = [
        angles(&data, "fig03", "Pendulum: dynamic equilibrium"),
        frequencies(&data, "fig04", "Pendulum: natural frequency"),
        means(&data, "fig05", "Pendulum: mean frequency"),
        deviations(&data, "fig06", "Pendulum: spread at 3 %", 0, 1),
        deviations(&data, "fig07", "Pendulum: spread at 3, 6 and 12 %", 0, 3),
    ];
    analysis.save(&options, "sweep.csv", &figures)?;
    analysis.print(out, "ROTATING PENDULUM", Some(&PAPER))?;
    options.print_directory(out)
}

fn main() -> ExitCode {
    program(run)
}
