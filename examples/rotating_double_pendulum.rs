//! Two bars in series on a spinning shaft: the second example of the paper (section 6.2, figures 9 to 13, table 2),
//! extended by the contribution of each of four independent dimensions.
//!
//! `cargo run --release --example rotating_double_pendulum`

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use eigentol::{Study, mechanism};
use eigentol_examples::pictures::{angles, contributions, deviations, frequencies, means};
use eigentol_examples::summary::Paper;
use eigentol_examples::{Analysis, Failure, Options, Question, program};

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

const PAPER: Paper = Paper {
    resonance: 1.895,
    critical: 2.679,
    ratio: 1414.0,
};

/// Runs the whole example: command-line `arguments`, summary to `out`, figures and CSV files to a directory.
pub fn run(arguments: Vec<OsString>, out: &mut dyn Write) -> Result<(), Failure> {
    let about = "How tolerances spread the frequencies of two spinning bars";
    let options = Options::parse("rotating_double_pendulum", about, arguments)?;
    let equal = equal_bars(&options)?;
    let independent = independent_bars(&options)?;
    equal.print(out, "DOUBLE PENDULUM, equal bars", Some(&PAPER))?;
    independent.print(out, "DOUBLE PENDULUM, independent bars", None)?;
    options.print_directory(out)
}

/// The paper's analysis: one length for both bars.
fn equal_bars(options: &Options) -> Result<Analysis, Failure> {
    type Pendulum = RotatingDoublePendulum;
    let study = Study::new(RotatingDoublePendulum).start(Pendulum::theta1, 60f64.to_radians());
    let question = Question {
        speed: Pendulum::omega.any(),
        range: (0.0, 8.0),
        varied: vec![Pendulum::l.any()],
        levels: vec![0.03, 0.06, 0.12],
    };
    let analysis = Analysis::run(&study, &question, options)?;

    let data = analysis.sweeps();
    let figures = [
        angles(&data, "fig09", "Double pendulum: dynamic equilibrium"),
        frequencies(&data, "fig10", "Double pendulum: natural frequencies"),
        means(&data, "fig11", "Double pendulum: mean frequencies"),
        deviations(&data, "fig12", "Double pendulum: spread of mode 1", 0, 3),
        deviations(&data, "fig13", "Double pendulum: spread of mode 2", 1, 3),
    ];
    analysis.save(options, "sweep.csv", &figures)?;
    Ok(analysis)
}

/// Four dimensions that vary independently, each within 3 %.
fn independent_bars(options: &Options) -> Result<Analysis, Failure> {
    type Bars = IndependentBars;
    let study = Study::new(IndependentBars).start(Bars::theta1, 60f64.to_radians());
    let question = Question {
        speed: Bars::omega.any(),
        range: (0.0, 8.0),
        varied: [Bars::l1, Bars::l2, Bars::m1, Bars::m2]
            .map(|variable| variable.any())
            .to_vec(),
        levels: vec![0.03],
    };
    let analysis = Analysis::run(&study, &question, options)?;

    let data = analysis.sweeps();
    let figures = [
        contributions(&data, "independent_1", "Bars: spread of mode 1", 0),
        contributions(&data, "independent_2", "Bars: spread of mode 2", 1),
    ];
    analysis.save(options, "independent.csv", &figures)?;
    Ok(analysis)
}

fn main() -> ExitCode {
    program(run)
}
