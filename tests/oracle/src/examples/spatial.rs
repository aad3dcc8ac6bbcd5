//! Multi-coordinate joints, and a screw.

use super::{Y, Z, body, gravity, spinning};
use crate::model::{Frame, Input, Joint, Model, Motion, Part, Shape, Step, Unit, Value, Values, Word, ZERO};

fn turn(name: &str, axis: [f64; 3]) -> Step {
    Step::new(Motion::Turn, axis).named(name)
}

/// A body on a spherical joint: turned about z at the first input, free to tilt about y, spinning about its
/// own z at the second input.
pub fn top(shape: Shape, weight: Values) -> Model {
    let steps = vec![turn("precession", Z).driven(0, 1.0), turn("tilt", Y), turn("spin", Z).driven(1, 1.0)];
    let inputs = ["Omega", "nu"].map(|name| Input { name: name.to_owned(), unit: Unit::RadianPerSecond });
    let pivot = Joint::new("pivot", Word::Spherical, steps, Frame::Ground, Frame::Body(0));
    Model {
        name: "Top".to_owned(),
        inputs: inputs.into(),
        gravity: weight,
        bodies: vec![body("top", vec![Part::whole(shape)])],
        beams: Vec::new(),
        joints: vec![pivot],
        ..spinning("Top")
    }
}

/// A blade that flaps about y, then lags about z, at the centre of a spinning hub.
pub fn blade(shape: Shape) -> Model {
    let mut model = spinning("Blade");
    model.bodies.push(body("blade", vec![Part::whole(shape)]));
    let (hub, blade) = (Frame::Body(0), Frame::Body(1));
    let steps = vec![turn("flap", Y), turn("lag", Z)];
    model.joints.push(Joint::new("root", Word::Universal, steps, hub, blade));
    model
}

/// A particle at distance `arm` from a screw whose axis is inclined by `rise`; at zero it hangs below the axis.
pub fn screw_pendulum(mass: f64, arm: f64, lead: f64, rise: f64) -> Model {
    let (sine, cosine) = rise.sin_cos();
    let particle = Shape::Point {
        mass: Value::Number(mass),
        center: [Value::Number(arm * sine), ZERO, Value::Number(-arm * cosine)],
    };
    let lead = Value::Number(lead);
    let step = Step::new(Motion::Screw { lead }, [cosine, 0.0, sine]);
    let (ground, nut) = (Frame::Ground, Frame::Body(0));
    Model {
        inputs: Vec::new(),
        gravity: gravity(),
        bodies: vec![body("nut", vec![Part::whole(particle)])],
        beams: Vec::new(),
        joints: vec![Joint::new("theta", Word::Screw, vec![step], ground, nut)],
        ..spinning("ScrewPendulum")
    }
}
