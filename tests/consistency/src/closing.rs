//! Loop closures: a cut joint, or constraints, between two frames of a tree. The loop need not assemble for its kernels
//! to be compared; only the equations matter.

use eigentol_oracle::model::{Frame, Model, Motion, Word};
use eigentol_oracle::random::Random;

const AXES: [&str; 6] = ["x", "y", "z", "-y", "[0, 3, -4]", "[1e-9, 1, 0]"];
const PLACES: [&str; 4] = ["[0, 0, 0] m", "[0.4, 0, 0] m", "[0, -0.3, 0.5] m", "[0.2, 0.1, -0.6] m"];
const TURNS: [&str; 5] = ["", "", " rotated(x, 90 deg)", " rotated(z, -90 deg)", " rotated([1, 2, 0], 0.7 rad)"];

/// Declarations that close a loop in a model.
pub fn items(model: &Model, random: &mut Random) -> String {
    let name = |frame: Frame| match frame {
        Frame::Ground => "ground".to_owned(),
        Frame::Body(index) => model.bodies[index].name.clone(),
    };
    let count = model.bodies.len();
    let to = random.below(count);
    let from = match random.below(count) {
        other if other != to => Frame::Body(other),
        _ => Frame::Ground,
    };
    let (from, to) = (name(from), name(Frame::Body(to)));
    let axis = random.of(&AXES);
    let [one, other] = [0; 2].map(|_| format!("{}{}", random.of(&PLACES), random.of(&TURNS)));
    let ends = format!("from {from} to {to} at {one}, at {other} on {to}");
    let points = format!("point here: {from} at {one}; point there: {to} at {other};");
    match random.below(13) {
        0 => format!("joint closing: fixed {ends}, cut;"),
        1 | 2 => format!("joint closing: revolute({axis}) {ends}, cut;"),
        3 => format!("joint closing: prismatic({axis}) {ends}, cut;"),
        4 => format!("joint closing: cylindrical(ca: {axis}, cb: {axis}) {ends}, cut;"),
        5 => format!("joint closing: universal(ca: x, cb: [0.3, 1, 0]) {ends}, cut;"),
        6 => format!("joint closing: planar(ca: x, cb: y, cc: z) {ends}, cut;"),
        7 => format!("joint closing: spherical(ca: x, cb: y, cc: z) {ends}, cut;"),
        8 => format!("{points} constraint closing: coincident(from: here, to: there, along: [y, z]);"),
        9 => format!("{points} constraint closing: aligned(from: here, to: there, axis: {axis});"),
        10 => {
            format!("{points} constraint closing: distance(from: here, to: there, length: 0.9 m);")
        }
        11 => {
            let around = random.of(&["x", "z", "[0, 3, -4]"]);
            format!(
                "{points} constraint closing: rolling(wheel: there, axis: {around}, radius: 0.3 m, on: here, normal: y);"
            )
        }
        _ => coupling(model),
    }
}

/// Couples two hinges by a gear.
fn coupling(model: &Model) -> String {
    let hinges = model.joints.iter().filter(|joint| {
        joint.word == Word::Revolute
            && joint.steps.iter().all(|step| step.drive.is_none() && step.motion == Motion::Turn)
    });
    let names: Vec<&str> = hinges.map(|joint| joint.name.as_str()).collect();
    match names[..] {
        [one, other, ..] => {
            format!("constraint closing: coupling(of: {one}, with: {other}, ratio: -2);")
        }
        _ => String::new(),
    }
}
