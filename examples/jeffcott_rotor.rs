//! A heavy disk on an elastic shaft with gyroscopic moments, stationary damping and rotating damping: Campbell diagram,
//! critical speeds and stability limit with their tolerances, and the risks at the running speed.
//!
//! The machine runs above its first-order critical speeds. Two things can go wrong there: the backward whirl of the
//! tilting disk, which the unbalance can excite through the asymmetric seal, may come within 10 % of the speed; and the
//! rotating damping of the shaft may overcome the stationary damping of the seal.
//!
//! `cargo run --release --example jeffcott_rotor`

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use eigentol::{Mechanism, Study, mechanism};
use eigentol_examples::rotor::margin::margin;
use eigentol_examples::rotor::{RPM, Risk, events, record, tables};
use eigentol_examples::{Failure, Options, RotorQuestion, program};
use eigentol_figures::{Style, campbell, damping_ratios};

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

/// Number of speeds in the figure around the running speed.
const CLOSE: usize = 49;

/// Runs the whole example: command-line `arguments`, summary to `out`, figures and CSV files to a directory.
pub fn run(arguments: Vec<OsString>, out: &mut dyn Write) -> Result<(), Failure> {
    let about = "How tolerances move the critical speeds and the limit of stability of a rotor";
    let options = Options::parse("jeffcott_rotor", about, arguments)?;
    let question = RotorQuestion {
        speed: JeffcottRotor::speed.any(),
        range: (0.0, 6000.0 * RPM),
        running: 3000.0 * RPM,
        orders: vec![1.0, 2.0],
        margin: 0.1,
    };
    let study = Study::new(JeffcottRotor)
        .seed(options.seed)
        .threads(options.threads);

    let diagram = question.campbell(&study, question.range, options.speeds)?;
    let events = events::find(&study, &question)?;
    let risk = Risk::assess(&study, &question, options.samples)?;

    let design = study.description().design.clone();
    let names: Vec<&str> = design.iter().map(|info| &*info.name).collect();
    record::diagram(&diagram, &options.file("sweep.csv"))?;
    record::events(&events, &names, &options.file("events.csv"))?;
    let near = (0.8 * question.running, 1.2 * question.running);
    let close = question.campbell(&study, near, CLOSE)?;
    let style = Style::of(&study).mark(question.running / RPM, "running speed");
    let title = |text: &str| style.clone().title(format!("Rotor: {text}"));
    for (name, figure) in [
        (
            "campbell",
            campbell(&diagram, &title("Campbell diagram").highest(120.0))?,
        ),
        (
            "damping",
            damping_ratios(&diagram, &title("damping ratios"))?,
        ),
        (
            "margin",
            margin(
                &question,
                &close,
                &risk,
                title("frequencies near the running speed"),
            )?,
        ),
    ] {
        figure.save(options.file(&format!("{name}.svg")))?;
    }

    writeln!(out, "JEFFCOTT ROTOR, disk off the middle\n")?;
    tables::diagram(out, &diagram)?;
    tables::events(
        out,
        &events,
        &study.tolerances()?,
        &JeffcottRotor::DESCRIPTION,
    )?;
    tables::risk(out, &risk, &question)?;
    options.print_directory(out)
}

fn main() -> ExitCode {
    program(run)
}
