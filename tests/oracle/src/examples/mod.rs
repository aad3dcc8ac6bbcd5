//! Mechanisms with known solutions.

mod rotors;
mod spatial;

pub use rotors::{anisotropic_bearing, jeffcott_in_the_ground, jeffcott_in_the_shaft, steadied_by_the_shaft};
pub use spatial::{blade, screw_pendulum, top};

use crate::model::{
    Amount, Body, Coordinate, DesignVariable, Force, ForceLaw, Frame, Input, Joint, Model, Motion, ORIGIN, Part,
    Placement, Shape, Step, Unit, Value, Word, ZERO,
};
use crate::truth::Truth;

const DOWN: [f64; 3] = [0.0, 0.0, -1.0];
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn design(variable: usize) -> Value {
    Value::Design { variable, factor: 1.0 }
}

fn variable(name: &str, nominal: f64, unit: Unit) -> DesignVariable {
    DesignVariable { name: name.to_owned(), unit, nominal }
}

fn body(name: &str, parts: Vec<Part>) -> Body {
    Body { name: name.to_owned(), parts }
}

fn revolute(name: &str, axis: [f64; 3], from: Frame, to: usize) -> Joint {
    let steps = vec![Step::new(Motion::Turn, axis)];
    Joint::new(name, Word::Revolute, steps, from, Frame::Body(to))
}

fn prismatic(name: &str, axis: [f64; 3], from: Frame, to: usize) -> Joint {
    let steps = vec![Step::new(Motion::Slide, axis)];
    Joint::new(name, Word::Prismatic, steps, from, Frame::Body(to))
}

fn gravity() -> [Value; 3] {
    [ZERO, ZERO, Value::Number(-9.81)]
}

/// A model with a shaft that turns at `omega` about z.
fn spinning(name: &str) -> Model {
    let mut spin = revolute("spin", Z, Frame::Ground, 0);
    spin.steps[0] = spin.steps[0].clone().driven(0, 1.0);
    Model {
        name: name.to_owned(),
        inputs: vec![Input { name: "omega".to_owned(), unit: Unit::RadianPerSecond }],
        design: Vec::new(),
        gravity: gravity(),
        bodies: vec![body("shaft", Vec::new())],
        beams: Vec::new(),
        joints: vec![spin],
        points: Vec::new(),
        forces: Vec::new(),
    }
}

/// Uniform bars hinged in series in the vertical plane of a spinning shaft (the paper's examples have one and two).
/// Coordinates are relative angles; design variables are the lengths, then the masses.
pub fn chain(lengths: &[f64], masses: &[f64]) -> Model {
    let bars = lengths.len();
    let mut model = spinning("Chain");
    for (i, &length) in lengths.iter().enumerate() {
        model.design.push(variable(&format!("l{}", i + 1), length, Unit::Metre));
    }
    for (i, &mass) in masses.iter().enumerate() {
        model.design.push(variable(&format!("m{}", i + 1), mass, Unit::Kilogram));
    }
    for i in 0..bars {
        let (length, mass) = (design(i), design(bars + i));
        let bar = Shape::Rod { mass: Amount::Mass(mass), length, along: DOWN, center: None };
        model.bodies.push(body(&format!("bar{}", i + 1), vec![Part::whole(bar)]));
        let mut hinge = revolute(&format!("theta{}", i + 1), Y, Frame::Body(i), i + 1);
        if i > 0 {
            let end = Value::Design { variable: i - 1, factor: -1.0 };
            hinge.from_placement = Placement::at([ZERO, ZERO, end]);
        }
        model.joints.push(hinge);
    }
    model
}

/// A point mass on two sliders on a spinning plate. Design variables: m, kx, ky, x0, y0, cx, cy.
pub fn two_sliders(nominal: [f64; 7]) -> Model {
    let mut model = spinning("TwoSliders");
    let units = [
        ("mass", Unit::Kilogram),
        ("kx", Unit::NewtonPerMetre),
        ("ky", Unit::NewtonPerMetre),
        ("x0", Unit::Metre),
        ("y0", Unit::Metre),
        ("cx", Unit::NewtonSecondPerMetre),
        ("cy", Unit::NewtonSecondPerMetre),
    ];
    model.design = units.iter().zip(nominal).map(|(&(name, unit), x)| variable(name, x, unit)).collect();
    model.bodies.push(body("carriage", Vec::new()));
    model.bodies.push(body("particle", vec![Part::whole(Shape::Point { mass: design(0), center: ORIGIN })]));
    model.joints.push(prismatic("along_x", X, Frame::Body(0), 1));
    model.joints.push(prismatic("along_y", Y, Frame::Body(1), 2));
    for (i, axis) in ["x", "y"].into_iter().enumerate() {
        let coordinate = Coordinate { joint: 1 + i, step: 0 };
        let (stiffness, rest, damping) = (design(1 + i), design(3 + i), design(5 + i));
        let spring = ForceLaw::Spring { coordinate, stiffness, rest };
        let damper = ForceLaw::Damper { coordinate, damping };
        model.forces.push(Force { name: format!("spring_{axis}"), law: spring });
        model.forces.push(Force { name: format!("damper_{axis}"), law: damper });
    }
    model
}

/// The seven-joint arm of `truth/panda_arm.json` with all joints free.
pub fn arm(truth: &Truth) -> Model {
    let mut model = Model { inputs: Vec::new(), bodies: Vec::new(), ..spinning("Arm") };
    model.joints.clear();
    for (i, link) in truth.get("joints").list().iter().enumerate() {
        let number = |x: f64| Value::Number(x);
        let vector = |field: &str| {
            let list = link.get(field).numbers();
            [number(list[0]), number(list[1]), number(list[2])]
        };
        let tensor = link.get("Ic").matrix();
        let inertia = [0, 4, 8, 1, 5, 2].map(|entry| number(tensor[entry]));
        let mass = number(link.get("mass").number());
        let shape = Shape::Rigid { mass, center: vector("com"), inertia, about: None };
        let parts = vec![Part::whole(shape)];
        model.bodies.push(body(&format!("link{}", i + 1), parts));
        let parent = if i == 0 { Frame::Ground } else { Frame::Body(i - 1) };
        let mut hinge = revolute(&format!("q{}", i + 1), Z, parent, i);
        hinge.from_placement.offset = vector("p");
        hinge.from_placement.rotations = axis_and_angle(&link.get("R").matrix());
        model.joints.push(hinge);
    }
    model
}

/// Axis and angle (less than half a turn) of a rotation matrix; empty for the identity.
fn axis_and_angle(r: &[f64]) -> Vec<([f64; 3], Value)> {
    // r - r^T = 2 sin(angle) [axis]x
    let axis = [r[7] - r[5], r[2] - r[6], r[3] - r[1]];
    let sine = axis[0].hypot(axis[1]).hypot(axis[2]) / 2.0;
    let angle = sine.atan2((r[0] + r[4] + r[8] - 1.0) / 2.0);
    if sine == 0.0 { Vec::new() } else { vec![(axis, Value::Number(angle))] }
}
