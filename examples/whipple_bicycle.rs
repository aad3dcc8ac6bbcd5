//! The bicycle of Whipple (1899) with the benchmark parameters of Meijaard, Papadopoulos, Ruina and Schwab (Proc. R.
//! Soc. A 463, 2007): at which speeds is it stable without hands, and how much do the tolerances of its 26 parameters
//! shift these speeds?
//!
//! The wheels roll without slip: of seven coordinates, only lean and steer have independent rates at a given forward
//! speed.
//!
//! `cargo run --release --example whipple_bicycle`

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use eigentol::sweep::EventTolerance;
use eigentol::{Campbell, Mechanism, Study, mechanism};
use eigentol_examples::table::{Table, number};
use eigentol_examples::{Failure, Options, program, rotor};
use eigentol_figures::{Style, eigenvalues};

mechanism! {
    /// Two wheels, a rear body and a front body, each symmetric about its middle plane, rolling straight ahead without
    /// hands.
    pub mechanism WhippleBicycle {
        /// Forward speed.
        input v: m/s;

        /// Wheel base.
        design w = 1.02 m +/- 5 mm;
        /// Trail: how far the front contact is behind the steer axis, on the road.
        design c = 0.08 m +/- 1 mm;
        /// Of the steer axis from the vertical: `lambda`.
        design tilt = 18 deg +/- 0.3 deg;
        /// Acceleration of gravity.
        design g = 9.81 m/s^2 +/- 0.01 m/s^2;

        design r_r = 0.3 m +/- 1 mm;
        design m_r = 2 kg +/- 1%;
        design i_rxx = 0.0603 kg*m^2 +/- 0.2%;
        design i_ryy = 0.12 kg*m^2 +/- 0.2%;

        design x_b = 0.3 m +/- 1 cm;
        design z_b = -0.9 m +/- 1 cm;
        design m_b = 85 kg +/- 2%;
        design i_bxx = 9.2 kg*m^2 +/- 2%;
        design i_byy = 11 kg*m^2 +/- 2%;
        design i_bzz = 2.8 kg*m^2 +/- 2%;
        design i_bxz = 2.4 kg*m^2 +/- 2%;

        design x_h = 0.9 m +/- 5 mm;
        design z_h = -0.7 m +/- 5 mm;
        design m_h = 4 kg +/- 1%;
        design i_hxx = 0.05892 kg*m^2 +/- 1%;
        design i_hyy = 0.06 kg*m^2 +/- 1%;
        design i_hzz = 0.00708 kg*m^2 +/- 1%;
        design i_hxz = -0.00756 kg*m^2 +/- 0.00005 kg*m^2;

        design r_f = 0.35 m +/- 1 mm;
        design m_f = 3 kg +/- 1%;
        design i_fxx = 0.1405 kg*m^2 +/- 0.1%;
        design i_fyy = 0.28 kg*m^2 +/- 0.1%;

        let axis = [sin(tilt), 0, cos(tilt)];
        let head = [w + c, 0, 0];

        gravity g along z;

        body base: massless;
        body mast: massless;
        body cradle: massless;
        body rear_wheel: rigid(mass: m_r, inertia: [i_rxx, i_ryy, i_rxx]);
        body frame: rigid(mass: m_b, inertia: [i_bxx, i_byy, i_bzz, 0, 0, i_bxz], center: [x_b, 0, z_b]);
        body fork: rigid(mass: m_h, inertia: [i_hxx, i_hyy, i_hzz, 0, 0, i_hxz], center: [x_h, 0, z_h]);
        body front_wheel: rigid(mass: m_f, inertia: [i_fxx, i_fyy, i_fxx]);

        joint travel: planar(forward: x, side: y, yaw: z) from ground to base, coasting;
        joint height: prismatic(z) from base to mast;
        joint lean: revolute(x) from mast to cradle;
        joint pitch: revolute(y) from cradle to frame;
        joint rear_spin: revolute(y) from frame to rear_wheel at [0, 0, -r_r], driven at -v / r_r;
        joint steer: revolute(axis) from frame to fork at head, at head on fork;
        joint front_spin: revolute(y) from fork to front_wheel at [w, 0, -r_f], coasting;

        point road: ground;
        point rear_hub: rear_wheel;
        point front_hub: front_wheel;

        constraint rear_contact: rolling(wheel: rear_hub, axis: y, radius: r_r, on: road, normal: -z);
        constraint front_contact: rolling(wheel: front_hub, axis: y, radius: r_f, on: road, normal: -z);

        /// Normal force on the rear wheel.
        output rear_load = reaction_force(rear_contact).z;
        /// Normal force on the front wheel.
        output front_load = reaction_force(front_contact).z;
    }
}

/// Fastest speed, m/s.
const FASTEST: f64 = 10.0;
/// Slowest speed, m/s: at rest, a wheel with a single contact point has no rolling direction.
const SLOWEST: f64 = 0.1;

/// Runs the whole example: command-line `arguments`, summary to `out`, figures and CSV files to a directory.
pub fn run(arguments: Vec<OsString>, out: &mut dyn Write) -> Result<(), Failure> {
    let about = "At which speeds a bicycle stays upright, and what tolerances do to them";
    let options = Options::parse("whipple_bicycle", about, arguments)?;
    let study = Study::new(WhippleBicycle)
        .seed(options.seed)
        .threads(options.threads);
    let step = (FASTEST - SLOWEST) / (options.speeds.max(2) - 1) as f64;
    let speeds: Vec<f64> = (0..options.speeds)
        .map(|k| (SLOWEST + step * k as f64).min(FASTEST))
        .collect();
    let campbell = study.campbell(WhippleBicycle::v, &speeds, &[] as &[f64])?;

    rotor::record::diagram(&campbell, &options.file("sweep.csv"))?;
    let title = "Whipple's bicycle: eigenvalues over the speed";
    let style = Style::of(&study).title(title).highest(10.0);
    eigenvalues(&campbell, &style)?.save(options.file("eigenvalues.svg"))?;

    writeln!(
        out,
        "WHIPPLE'S BICYCLE, riding straight ahead without hands\n"
    )?;
    writeln!(out, "{}", table(&campbell))?;
    for event in campbell.flutter_onsets.iter() {
        limit(out, "The weave grows below, decays above", event)?;
    }
    for event in campbell.critical.iter() {
        limit(out, "It capsizes above, slowly", event)?;
    }
    options.print_directory(out)
}

/// About ten rows of the eigenvalues.
fn table(campbell: &Campbell) -> Table {
    let labels = campbell.labels();
    let mut table = Table::new(
        std::iter::once("speed m/s".to_owned())
            .chain(labels.iter().map(|label| format!("mode {} 1/s", label + 1))),
    );
    let every = campbell.points.len().div_ceil(11).max(1);
    for point in campbell.points.iter().step_by(every) {
        let modes = point.modes.as_deref().unwrap_or_default();
        let cell = |label: &usize| {
            let Some(mode) = modes.iter().find(|mode| mode.label == *label) else {
                return number(None, 3);
            };
            let real = number(Some(mode.s.re), 3);
            match mode.behaviour.frequency() {
                Some(frequency) => format!("{real} +/- {frequency:.3} i"),
                None => real,
            }
        };
        let speed = std::iter::once(number(Some(point.value), 3));
        table.row(speed.chain(labels.iter().map(cell)));
    }
    table
}

/// Prints a stability limit and the three variables that affect it most.
fn limit(out: &mut dyn Write, what: &str, event: &EventTolerance) -> Result<(), Failure> {
    write!(out, "{what} {:.4} m/s", event.value)?;
    let Ok(spread) = &event.spread else {
        writeln!(out)?;
        return Ok(());
    };
    writeln!(
        out,
        ", standard deviation {:.4} m/s, mostly from",
        spread.sigma
    )?;
    let mut order: Vec<usize> = (0..spread.by_design.len()).collect();
    order.sort_by(|&a, &b| spread.variance_shares[b].total_cmp(&spread.variance_shares[a]));
    for &k in order.iter().take(3) {
        let info = &WhippleBicycle::DESCRIPTION.design[k];
        writeln!(
            out,
            "    {:<6} {:5.1} % of the variance, {:+.4} m/s for one tolerance more",
            info.name,
            100.0 * spread.variance_shares[k],
            spread.by_design[k] * info.tolerance.upper,
        )?;
    }
    writeln!(out)?;
    Ok(())
}

fn main() -> ExitCode {
    program(run)
}
