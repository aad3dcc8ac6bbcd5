//! Which tolerances may be wide? The torsional frequency of a geared drive must stay clear of its motor's torque
//! ripple.
//!
//! Finds the cheapest tolerances that keep 999 of 1000 drives clear, if halving a tolerance doubles its cost.

use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use eigentol::allocation::{Allocation, Choices, Cost, HalfWidth};
use eigentol::requirement::Requirement;
use eigentol::response::Response;
use eigentol::{DesignVariable, Quantity, Study, mechanism};

mechanism! {
    /// A servo at constant speed, a shaft, a pair of gears, a second shaft and a drum; typical data.
    pub mechanism GearTrain {
        input speed: rpm;
        design motor_shaft = 20 mm +/- 0.1 mm;
        design load_shaft = 35 mm +/- 0.1 mm;
        design drum = 0.9 kg*m^2 +/- 5%;
        let first = 80 GPa * pi * motor_shaft^4 / 32 / 400 mm;
        let second = 80 GPa * pi * load_shaft^4 / 32 / 600 mm;
        body motor: massless;
        body output_side: massless;
        body small_gear: rigid(mass: 1 kg, inertia: [2e-3, 2e-3, 2e-3] kg*m^2);
        body large_gear: rigid(mass: 8 kg, inertia: [0.06, 0.06, 0.06] kg*m^2);
        body load: rigid(mass: 40 kg, inertia: [drum, drum, drum]);
        joint servo: revolute(z) from ground to motor, driven at speed;
        joint shifted: revolute(z) from ground to output_side at [200 mm, 0, 0], driven at -speed / 4;
        joint a: revolute(z) from motor to small_gear;
        joint b: revolute(z) from output_side to large_gear;
        joint c: revolute(z) from large_gear to load;
        constraint mesh: coupling(of: b, with: a, ratio: -1 / 4);
        force twist1: spring(on: a, stiffness: first);
        force twist2: spring(on: c, stiffness: second);
    }
}

/// Highest ripple frequency of the motor, Hz.
pub const RIPPLE: f64 = 19.5;

/// The drive as drawn.
pub fn study() -> Study<GearTrain> {
    Study::new(GearTrain)
}

/// The cheapest half-widths of both shafts and of the drum.
pub fn cheapest() -> Result<Allocation, eigentol::Error> {
    let half_width = |(variable, least): (DesignVariable<GearTrain>, f64)| HalfWidth {
        variable: variable.index(),
        limits: (least, 20.0 * least),
        cost: Cost::reciprocal(0.0, least, 1.0),
    };
    let (motor, load) = (GearTrain::motor_shaft, GearTrain::load_shaft);
    let chosen = [(motor, 2e-5), (load, 2e-5), (GearTrain::drum, 9e-3)];
    let choices = Choices { half_widths: chosen.map(half_width).into(), nominals: vec![], failure: vec![1e-3] };
    let (mode, quantity) = (0, Quantity::Frequency);
    let clear = Requirement::at_least(Response::Mode { mode, quantity }, RIPPLE * TAU);
    study().allocation(&[clear], &choices)
}

/// Writes the tolerances that the drive could have instead of its own.
pub fn answer(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let allocation = cheapest()?;
    let half = &allocation.half_widths;
    let [motor, load, drum] = [1e3 * half[0], 1e3 * half[1], 100.0 * half[2] / 0.9];
    let (before, after) = (allocation.cost_before, allocation.cost);
    writeln!(
        out,
        "GEAR TRAIN: 999 of 1000 drives keep {RIPPLE} Hz with +/- {motor:.2} mm on the motor's shaft,
{load:.2} mm on the load's and {drum:.1} % on the drum: a cost of {after:.2} instead of {before:.2}.\n"
    )?;
    Ok(())
}
