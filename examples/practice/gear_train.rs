//! Which tolerances may be wide? The torsional vibration of a geared drive must stay clear of the ripple of its motor.
//!
//! The cheapest tolerances that keep 999 of 1000 drives clear, where half of a tolerance costs twice as much.

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use eigentol::allocation::{Allocation, Choices, Cost, HalfWidth};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{Quantity, Study, mechanism};

mechanism! {
    /// A servo that keeps its speed, a shaft, a pair of gears, a second shaft and a drum; typical data.
    pub mechanism GearTrain {
        input speed: rpm;

        design motor_shaft = 20 mm +/- 0.1 mm;
        design load_shaft = 35 mm +/- 0.1 mm;
        design pinion = 2e-3 kg*m^2 +/- 2%;
        design wheel = 0.06 kg*m^2 +/- 2%;
        design drum = 0.9 kg*m^2 +/- 5%;

        let ratio = 1 / 4;
        let first = 80 GPa * pi * motor_shaft^4 / 32 / 400 mm;
        let second = 80 GPa * pi * load_shaft^4 / 32 / 600 mm;

        body motor: massless;
        body output_side: massless;
        body small_gear: rigid(mass: 1 kg, inertia: [pinion, pinion, pinion]);
        body large_gear: rigid(mass: 8 kg, inertia: [wheel, wheel, wheel]);
        body load: rigid(mass: 40 kg, inertia: [drum, drum, drum]);

        joint servo: revolute(z) from ground to motor, driven at speed;
        joint shifted: revolute(z) from ground to output_side at [200 mm, 0, 0], driven at -ratio * speed;
        joint a: revolute(z) from motor to small_gear;
        joint b: revolute(z) from output_side to large_gear;
        joint c: revolute(z) from large_gear to load;
        constraint mesh: coupling(of: b, with: a, ratio: -ratio);

        force twist1: spring(on: a, stiffness: first);
        force twist2: spring(on: c, stiffness: second);
    }
}

/// The highest ripple of the motor, Hz.
pub const RIPPLE: f64 = 19.5;

/// The drive at its speed.
pub fn study() -> Study<GearTrain> {
    Study::new(GearTrain).input(GearTrain::speed, 1500.0 * super::RPM)
}

/// The cheapest half-widths of both shafts and of the drum.
pub fn cheapest() -> Result<Allocation, eigentol::Error> {
    let least = [
        (GearTrain::motor_shaft, 0.02e-3),
        (GearTrain::load_shaft, 0.02e-3),
        (GearTrain::drum, 9e-3),
    ];
    let half_widths = least.map(|(variable, least)| HalfWidth {
        variable: variable.index(),
        limits: (least, 20.0 * least),
        cost: Cost::reciprocal(0.0, least, 1.0),
    });
    let lowest = Response::Mode {
        mode: 0,
        quantity: Quantity::Frequency,
    };
    let clear = Requirement::at_least(lowest, RIPPLE * TAU);
    study().solve()?.allocation(
        &[clear],
        &Choices {
            half_widths: half_widths.into(),
            nominals: vec![],
            failure: vec![1e-3],
        },
    )
}

/// What the drive has now, and what it could have.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let found = cheapest()?;
    let [motor, load, _, _, drum] = found.half_widths[..] else {
        return Err("five variables".into());
    };
    let (before, after) = (found.cost_before, found.cost);
    writeln!(
        out,
        "GEAR TRAIN: it stays above {RIPPLE} Hz in 999 of 1000 drives with +/- {:.2} mm on the motor's shaft,",
        1e3 * motor
    )?;
    writeln!(
        out,
        "+/- {:.2} mm on the load's shaft and +/- {:.1} % on the drum, at {after:.2} instead of {before:.2} of cost.\n",
        1e3 * load,
        100.0 * drum / 0.9
    )?;
    Ok(())
}
