//! Random trees, half of them full of special cases, against the oracle: poses by matrix products, seats and axes of
//! joints, points, and the inertias implied by the drawn solids.

use std::cell::Cell;

use eigentol::picture::{Scene, Seat, Shape, scene};
use eigentol_compiler::mechanics::Limits;
use eigentol_compiler::program::Operation;
use eigentol_compiler::{Compilation, compile_text};
use eigentol_interpreter::Interpreted;
use eigentol_oracle::Oracle;
use eigentol_oracle::agreement::Case;
use eigentol_oracle::declaration::declaration;
use eigentol_oracle::model::{Frame, Model, Placement};
use eigentol_oracle::random::on_plans;

use crate::pictures::space::{Vector, add, difference, dot, scaled};

/// Metres, and components of unit vectors.
const TOLERANCE: f64 = 1e-11;

/// How a picture differs from the oracle.
fn differences(model: &Model, scene: &Scene, case: &Case) -> Vec<String> {
    let [q, _, b] = &case.at;
    let oracle = Oracle::new(model);
    let mut texts = Vec::new();
    let mut same = |what: String, one: &[f64], other: &[f64]| {
        let apart = difference(one, other);
        if apart > TOLERANCE {
            texts.push(format!("{what}: {one:?}, the oracle says {other:?}"));
        }
    };
    let body = |frame: Frame| match frame {
        Frame::Ground => None,
        Frame::Body(body) => Some(body),
    };
    let origin = |frame, placement: &Placement| oracle.place(q, b, frame, placement).0;

    assert_eq!(scene.bodies.len(), model.bodies.len());
    for ((shown, declared), (position, rotation)) in scene.bodies.iter().zip(&model.bodies).zip(oracle.poses(q, b)) {
        let name = &declared.name;
        assert!(shown.name == name.as_str());
        same(format!("place of {name}"), &shown.pose.position, &position);
        let axes = shown.pose.rotation.as_flattened();
        same(format!("axes of {name}"), axes, rotation.as_flattened());
        assert_eq!(shown.solids.len(), declared.parts.len());
        for (solid, part) in shown.solids.iter().zip(&declared.parts) {
            let (mass, center, tensor) = Oracle::piece(part, b);
            assert_eq!(solid.hole, part.hole);
            same(format!("centre in {name}"), &solid.center, &center);
            if matches!(solid.shape, Shape::Ellipsoid { .. }) && !of_a_body(&tensor) {
                continue;
            }
            let implied = inertia(&solid.shape, mass);
            let what = format!("{:?} of {name}", solid.shape);
            same(what, implied.as_flattened(), tensor.as_flattened());
        }
    }
    let gravity = scene.gravity.unwrap_or_default();
    same("gravity".to_owned(), &gravity, &oracle.gravity(b));
    assert_eq!(scene.joints.len(), model.joints.len());
    let directions = oracle.directions(q, b);
    for ((shown, declared), directions) in scene.joints.iter().zip(&model.joints).zip(directions) {
        let name = &declared.name;
        assert!(shown.name == name.as_str() && !shown.closes_loop);
        let sides = [
            (shown.from, declared.from, &declared.from_placement, directions.first()),
            (shown.to, declared.to, &declared.to_placement, directions.last()),
        ];
        for (seat, frame, placement, axis) in sides {
            let Seat { place, .. } = seat;
            assert_eq!(seat.body, body(frame));
            let place = scene.place(seat.body, place);
            same(format!("place of {name}"), &place, &origin(frame, placement));
            let count = |axis: bool| f64::from(u8::from(axis));
            let (found, expected) = (seat.axis.is_some(), axis.is_some());
            same(format!("axes of {name}"), &[count(found)], &[count(expected)]);
            if let (Some(axis), Some(expected)) = (seat.axis, axis) {
                let start = scene.place(seat.body, [0.0; 3]);
                let axis = add(scene.place(seat.body, axis), scaled(-1.0, start));
                same(format!("axis of {name}"), &axis, expected);
            }
        }
    }
    assert_eq!(scene.points.len(), model.points.len());
    for (shown, declared) in scene.points.iter().zip(&model.points) {
        assert!(shown.name == declared.name.as_str());
        assert_eq!(shown.body, body(declared.frame));
        let place = scene.place(shown.body, shown.place);
        let expected = origin(declared.frame, &declared.placement);
        same(format!("point {}", declared.name), &place, &expected);
    }
    texts
}

const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Whether an ellipsoid can have this central inertia `J`: `tr(J)/2 1 - J` has no negative eigenvalue beyond rounding.
/// Random design values may make a valid inertia invalid.
fn of_a_body(inertia: &[[f64; 3]; 3]) -> bool {
    let trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
    let half = (0.5 + 1e-12) * trace;
    let second: [[f64; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { half } else { 0.0 } - inertia[i][j]));
    let [[a, b, c], [_, d, e], [_, _, f]] = second;
    let determinant = a * (d * f - e * e) - b * (b * f - c * e) + c * (b * e - c * d);
    a >= 0.0 && a * d - b * b >= 0.0 && determinant >= 0.0
}

/// The inertia of anything that is not a valid solid.
const WRONG: [[f64; 3]; 3] = [[f64::NAN; 3]; 3];

/// Central inertia of a uniform solid, from textbook formulas.
fn inertia(shape: &Shape, mass: f64) -> [[f64; 3]; 3] {
    let round = |axis: Vector, about: f64, across: f64| -> [[f64; 3]; 3] {
        let entry = |i: usize, j: usize| {
            let one = if i == j { across } else { 0.0 };
            mass * (one + (about - across) * axis[i] * axis[j])
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    };
    // From squared lengths along three perpendicular directions: sum (|a|^2 1 - a a^T).
    let along = |axes: [Vector; 3], squares: [f64; 3]| -> [[f64; 3]; 3] {
        let sum: f64 = squares.iter().sum();
        let entry = |i: usize, j: usize| {
            let value: f64 = (0..3).map(|k| squares[k] * axes[k][i] * axes[k][j]).sum();
            mass * (if i == j { sum } else { 0.0 } - value)
        };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    };
    match shape {
        Shape::Point { mass: own } => {
            if (own - mass).abs() > 1e-12 * mass {
                return WRONG;
            }
            [[0.0; 3]; 3]
        }
        Shape::Rod { along, length } => round(*along, 0.0, length.powi(2) / 12.0),
        Shape::Disk { axis, radius } => round(*axis, radius.powi(2) / 2.0, radius.powi(2) / 4.0),
        Shape::Cylinder { axis, radius, length } => {
            let across = radius.powi(2) / 4.0 + length.powi(2) / 12.0;
            round(*axis, radius.powi(2) / 2.0, across)
        }
        Shape::Tube { axis, inner, outer, length } => {
            if inner >= outer {
                return WRONG;
            }
            let radii = inner.powi(2) + outer.powi(2);
            round(*axis, radii / 2.0, radii / 4.0 + length.powi(2) / 12.0)
        }
        Shape::Box { edges, size } => along(*edges, size.map(|edge| edge.powi(2) / 12.0)),
        Shape::Sphere { radius } => {
            let moment = 0.4 * radius.powi(2);
            round([1.0, 0.0, 0.0], moment, moment)
        }
        Shape::Ellipsoid { axes, semi_axes } => {
            let products = axes.map(|one| axes.map(|other| dot(one, other)));
            if difference(products.as_flattened(), UNIT.as_flattened()) > 1e-12 {
                return WRONG;
            }
            along(*axes, semi_axes.map(|length| length.powi(2) / 5.0))
        }
    }
}

/// A random tree accepted by the compiler, with a state. Only the picture kernel is kept.
fn compiled(model: &Model, seed: u64) -> Option<(Compilation, Case)> {
    let limits = Limits { explicit_partials: 0, partial_operations: usize::MAX, motion_linear: 0 };
    let mut compilation = compile_text(&declaration(model), limits).ok()?;
    let kernels = &mut compilation.program.kernels;
    kernels.retain(|kernel| kernel.name == "picture");
    assert_eq!(kernels.len(), 1);
    Some((compilation, Case::random(model, seed)))
}

fn shown(compilation: &Compilation, case: &Case) -> Scene {
    let [q, u, b] = &case.at;
    scene(&Interpreted::new(compilation), q, u, b).expect("a picture")
}

fn agree_on(trees: u32) {
    let compared = Cell::new(0);
    on_plans(trees, |plan| {
        let model = plan.model();
        if let Some((compilation, case)) = compiled(&model, plan.seed) {
            let found = differences(&model, &shown(&compilation, &case), &case);
            assert!(found.is_empty(), "{}\n{}", found.join("\n"), declaration(&model));
            compared.set(compared.get() + 1);
        }
    });
    let compared = compared.get();
    assert!(compared >= trees * 3 / 4, "{compared} trees compared");
}

/// What is left out of the comparison: a tensor whose greatest moment exceeds the sum of the other two, not a flat
/// body.
#[test]
fn only_inertias_that_no_body_has_are_left_out() {
    let diagonal =
        |moments: [f64; 3]| std::array::from_fn(|i| std::array::from_fn(|j| if i == j { moments[i] } else { 0.0 }));
    for (moments, possible) in [
        ([1.0, 1.0, 1.0], true),
        ([1.0, 2.0, 3.0], true),
        ([0.0, 1.0, 1.0], true),
        ([0.0; 3], true),
        ([1.0, 2.0, 3.001], false),
        ([2.0, 4.001, 2.0], false),
        ([1.1, 0.05, 1.0], false),
    ] {
        assert_eq!(of_a_body(&diagonal(moments)), possible, "{moments:?}");
    }
    // Moments 1, 2, 3 about axes turned by 45 degrees about the first one, and a product that is too great.
    let turned = |product: f64| [[1.0, 0.0, 0.0], [0.0, 2.5, product], [0.0, product, 2.5]];
    assert!(of_a_body(&turned(0.5)) && !of_a_body(&turned(0.501)));
}

#[test]
fn pictures_of_random_trees_are_those_of_the_oracle() {
    agree_on(30);
}

#[test]
#[ignore = "takes a minute"]
fn pictures_of_many_random_trees_are_those_of_the_oracle() {
    agree_on(600);
}

/// A comparison that cannot fail proves nothing: flips every sign of every sum in the kernel, exchanges every result
/// with the next, and changes every literal number. Changes that only affect zeros are not counted.
#[test]
fn every_wrong_sign_and_place_is_found() {
    let seen = Cell::new([0; 3]);
    on_plans(4, |plan| {
        let model = plan.model();
        let Some((compilation, case)) = compiled(&model, plan.seed) else {
            return;
        };
        let right = shown(&compilation, &case);
        let mut wrong = compilation.clone();
        let look = |kind: usize, what: String, wrong: &Compilation| {
            let wrong = shown(wrong, &case);
            if difference_of(&wrong, &right) < 1e-9 {
                return;
            }
            let found = differences(&model, &wrong, &case);
            assert!(!found.is_empty(), "{what} of\n{}", declaration(&model));
            let mut count = seen.get();
            count[kind] += 1;
            seen.set(count);
        };
        let kernel = &compilation.program.kernels[0];
        for (k, instruction) in kernel.instructions.iter().enumerate() {
            if let Some(operation) = turned_round(&instruction.operation) {
                wrong.program.kernels[0].instructions[k].operation = operation;
                look(0, format!("instruction {k}"), &wrong);
                wrong.program.kernels[0].instructions[k] = instruction.clone();
            }
        }
        for k in 1..kernel.results[0].values.len() {
            wrong.program.kernels[0].results[0].values.swap(k - 1, k);
            look(1, format!("results {k}"), &wrong);
            wrong.program.kernels[0].results[0].values.swap(k - 1, k);
        }
        let picture = &compilation.functions.picture;
        for (k, number) in picture.numbers.iter().enumerate() {
            if !picture.computed.iter().any(|&place| place as usize == k) {
                wrong.functions.picture.numbers[k] = number + 0.01;
                look(2, format!("number {k}"), &wrong);
                wrong.functions.picture.numbers[k] = *number;
            }
        }
    });
    let [signs, results, numbers] = seen.get();
    assert!(signs > 100 && results > 100 && numbers > 300, "{seen:?}");
}

fn turned_round(operation: &Operation) -> Option<Operation> {
    use eigentol_compiler::algebra::Operator::{Add, Subtract};
    match *operation {
        Operation::Binary(Add, a, b) => Some(Operation::Binary(Subtract, a, b)),
        Operation::Binary(Subtract, a, b) => Some(Operation::Binary(Add, a, b)),
        _ => None,
    }
}

/// The distance between two pictures, from the numbers in their text.
fn difference_of(one: &Scene, other: &Scene) -> f64 {
    let numbers = |scene: &Scene| -> Vec<f64> {
        let text = serde_json::to_string(scene).expect("a scene is written");
        let words = text.split(|c: char| !c.is_ascii_digit() && !"+-.eE".contains(c));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    difference(&numbers(one), &numbers(other))
}
