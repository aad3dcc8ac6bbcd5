//! A second way to the same residual, by Lagrange's equations, that shares no kinematics with the oracle.
//!
//! `g_i = d/dt (dL/dqdot_i) - dL/dq_i + dD/dqdot_i` with `L = T - V` and Rayleigh's dissipation function `D`. Poses
//! are 4 x 4 matrices from quaternions; the kinetic energy of a body is `1/2 tr(Xdot P Xdot^T)` with its pseudo-inertia
//! `P = integral [r; 1] [r; 1]^T dm`, so neither angular velocities nor gyroscopic moments occur. Every derivative is a
//! hyper-dual number.

use num_dual::{Dual, DualNum, HyperDual64};

use crate::model::{ForceLaw, Frame, JointKind, Model, Placement, Shape, Value, Values};
use crate::oracle::Scalar;

type Four<D> = [[D; 4]; 4];

/// Coordinates and speeds of all joints (zero where fixed), inputs resolved, design variables.
struct Flow<D> {
    position: Vec<D>,
    speed: Vec<D>,
    design: Vec<D>,
}

/// `g(qddot, qdot, q; u, b)` by Lagrange's equations.
pub fn residual(
    model: &Model,
    [acceleration, velocity, q]: [&[f64]; 3],
    inputs: &[f64],
    design: &[f64],
) -> Vec<f64> {
    let joints = model.joints.len();
    let (mut position, mut speed, mut gain) =
        (vec![0.0; joints], vec![0.0; joints], vec![0.0; joints]);
    let free = model.free();
    for (index, &joint) in free.iter().enumerate() {
        (position[joint], speed[joint], gain[joint]) =
            (q[index], velocity[index], acceleration[index]);
    }
    for joint in model.driven() {
        let drive = model.joints[joint].drive.expect("a driven joint");
        speed[joint] = drive.factor * inputs[drive.input];
    }
    // Second part of each number: the rate of time.
    let in_time = |x: f64, rate: f64| HyperDual64::new(x, 0.0, rate, 0.0);
    let flow = |seed: &dyn Fn(&mut Flow<HyperDual64>)| {
        let mut flow = Flow {
            position: position
                .iter()
                .zip(&speed)
                .map(|(&x, &v)| in_time(x, v))
                .collect(),
            speed: speed
                .iter()
                .zip(&gain)
                .map(|(&v, &a)| in_time(v, a))
                .collect(),
            design: design.iter().map(|&b| in_time(b, 0.0)).collect(),
        };
        seed(&mut flow);
        flow
    };
    let equation = |&joint: &usize| {
        let by_speed = flow(&|flow| flow.speed[joint].eps1 = 1.0);
        let by_position = flow(&|flow| flow.position[joint].eps1 = 1.0);
        let momentum = lagrangian(model, &by_speed);
        // d/dt dL/dqdot_i - dL/dq_i + dD/dqdot_i
        momentum.eps1eps2 - lagrangian(model, &by_position).eps1
            + dissipation(model, &by_speed).eps1
    };
    free.iter().map(equation).collect()
}

/// `L = T - V`.
fn lagrangian<D: Scalar>(model: &Model, flow: &Flow<D>) -> D {
    let moving = Flow {
        position: flow
            .position
            .iter()
            .zip(&flow.speed)
            .map(|(&x, &v)| Dual::new(x, v))
            .collect(),
        speed: Vec::new(),
        design: lift(&flow.design),
    };
    let poses = poses(model, &moving);
    let gravity = model.gravity.map(|component| get(component, &flow.design));
    let mut total = D::zero();
    for (body, pose) in model.bodies.iter().zip(&poses) {
        let p = pseudo_inertia(&body.shape, &flow.design);
        for row in 0..3 {
            // 1/2 tr(Xdot P Xdot^T), one row of Xdot at a time; the last row of Xdot is zero
            for i in 0..4 {
                for j in 0..4 {
                    total += pose[row][i].eps * p[i][j] * pose[row][j].eps * 0.5;
                }
            }
            // -V = m gravity . c
            for i in 0..4 {
                total += gravity[row] * pose[row][i].re * p[i][3];
            }
        }
    }
    total - springs(model, flow, &poses)
}

/// `1/2 k (q - q0)^2` and `1/2 k (d - L)^2`.
fn springs<D: Scalar>(model: &Model, flow: &Flow<D>, poses: &[Four<Dual<D>>]) -> D {
    let energy = |law: &ForceLaw| match *law {
        ForceLaw::Spring {
            joint,
            stiffness,
            rest,
        } => {
            let stretch = flow.position[joint] - get(rest, &flow.design);
            get(stiffness, &flow.design) * stretch * stretch * 0.5
        }
        ForceLaw::SpringDamper {
            from,
            to,
            stiffness,
            length,
            ..
        } => {
            let stretch = distance(model, flow, poses, from, to).re - get(length, &flow.design);
            get(stiffness, &flow.design) * stretch * stretch * 0.5
        }
        ForceLaw::Damper { .. } => D::zero(),
    };
    model.forces.iter().map(|force| energy(&force.law)).sum()
}

/// Rayleigh's function: `1/2 c qdot^2` and `1/2 c ddot^2`.
fn dissipation<D: Scalar>(model: &Model, flow: &Flow<D>) -> D {
    let moving = Flow {
        position: flow
            .position
            .iter()
            .zip(&flow.speed)
            .map(|(&x, &v)| Dual::new(x, v))
            .collect(),
        speed: Vec::new(),
        design: lift(&flow.design),
    };
    let poses = poses(model, &moving);
    let power = |law: &ForceLaw| match *law {
        ForceLaw::Damper { joint, damping } => {
            get(damping, &flow.design) * flow.speed[joint] * flow.speed[joint] * 0.5
        }
        ForceLaw::SpringDamper {
            from, to, damping, ..
        } => {
            let rate = distance(model, flow, &poses, from, to).eps;
            get(damping, &flow.design) * rate * rate * 0.5
        }
        ForceLaw::Spring { .. } => D::zero(),
    };
    model.forces.iter().map(|force| power(&force.law)).sum()
}

fn distance<D: Scalar>(
    model: &Model,
    flow: &Flow<D>,
    poses: &[Four<Dual<D>>],
    from: usize,
    to: usize,
) -> Dual<D> {
    let design = lift(&flow.design);
    let position = |point: usize| {
        let point = &model.points[point];
        let r = point.position.map(|component| get(component, &design));
        match point.frame {
            Frame::Ground => r,
            Frame::Body(body) => std::array::from_fn(|i| {
                let row = poses[body][i];
                row[0] * r[0] + row[1] * r[1] + row[2] * r[2] + row[3]
            }),
        }
    };
    let (start, end): ([Dual<D>; 3], [Dual<D>; 3]) = (position(from), position(to));
    let square = |i: usize| (end[i] - start[i]) * (end[i] - start[i]);
    (square(0) + square(1) + square(2)).sqrt()
}

fn get<D: Scalar>(value: Value, design: &[D]) -> D {
    match value {
        Value::Number(number) => D::from(number),
        Value::Design { variable, factor } => design[variable] * factor,
    }
}

fn lift<D: Scalar>(values: &[D]) -> Vec<Dual<D>> {
    values.iter().map(|&value| Dual::from_re(value)).collect()
}

/// Pose of every body in the ground.
fn poses<D: Scalar>(model: &Model, flow: &Flow<D>) -> Vec<Four<D>> {
    let mut poses = vec![translation([D::zero(); 3]); model.bodies.len()];
    for branch in model.tree() {
        let joint = &model.joints[branch.joint];
        let x = flow.position[branch.joint];
        let motion = match joint.kind {
            JointKind::Fixed => translation([D::zero(); 3]),
            JointKind::Revolute(axis) => quaternion_rotation(axis, x),
            JointKind::Prismatic(axis) => {
                let length = norm(axis);
                translation(axis.map(|component| x * (component / length)))
            }
        };
        let from = placed(&joint.from_placement, &flow.design);
        let to = placed(&joint.to_placement, &flow.design);
        // The pose of the `to` body in the `from` body
        let across = multiply(&multiply(&from, &motion), &inverse(&to));
        let across = if branch.reversed {
            inverse(&across)
        } else {
            across
        };
        poses[branch.body] = match branch.parent {
            Frame::Ground => across,
            Frame::Body(parent) => multiply(&poses[parent], &across),
        };
    }
    poses
}

fn placed<D: Scalar>(placement: &Placement, design: &[D]) -> Four<D> {
    let offset: Values = placement.offset;
    let start = translation(offset.map(|component| get(component, design)));
    placement
        .rotations
        .iter()
        .fold(start, |pose, (axis, angle)| {
            multiply(&pose, &quaternion_rotation(*axis, get(*angle, design)))
        })
}

fn norm(axis: [f64; 3]) -> f64 {
    axis[0].hypot(axis[1]).hypot(axis[2])
}

fn translation<D: Scalar>(offset: [D; 3]) -> Four<D> {
    let (o, i) = (D::zero(), D::one());
    let [x, y, z] = offset;
    [[i, o, o, x], [o, i, o, y], [o, o, i, z], [o, o, o, i]]
}

/// Rotation by the unit quaternion `(w, v) = (cos(angle/2), sin(angle/2) axis)`.
fn quaternion_rotation<D: Scalar>(axis: [f64; 3], angle: D) -> Four<D> {
    let half = angle * 0.5;
    let sine = half.sin() / norm(axis);
    let w = half.cos();
    let [x, y, z] = axis.map(|component| sine * component);
    let (o, i) = (D::zero(), D::one());
    [
        [
            i - (y * y + z * z) * 2.0,
            (x * y - w * z) * 2.0,
            (x * z + w * y) * 2.0,
            o,
        ],
        [
            (x * y + w * z) * 2.0,
            i - (x * x + z * z) * 2.0,
            (y * z - w * x) * 2.0,
            o,
        ],
        [
            (x * z - w * y) * 2.0,
            (y * z + w * x) * 2.0,
            i - (x * x + y * y) * 2.0,
            o,
        ],
        [o, o, o, i],
    ]
}

fn multiply<D: Scalar>(a: &Four<D>, b: &Four<D>) -> Four<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

fn inverse<D: Scalar>(pose: &Four<D>) -> Four<D> {
    let mut inverse = translation([D::zero(); 3]);
    for i in 0..3 {
        for j in 0..3 {
            inverse[i][j] = pose[j][i];
            inverse[i][3] -= pose[j][i] * pose[j][3];
        }
    }
    inverse
}

/// `integral [r; 1] [r; 1]^T dm`: second moments, first moments, mass.
fn pseudo_inertia<D: Scalar>(shape: &Shape, design: &[D]) -> Four<D> {
    let number = |v: &Value| get(*v, design);
    let vector = |v: &Values| v.map(|component| get(component, design));
    let along = |a: [f64; 3], i: usize, j: usize| a[i] * a[j] / (norm(a) * norm(a));
    let across = |a: [f64; 3], i: usize, j: usize| f64::from(i == j) - along(a, i, j);
    let zero = [D::zero(); 3];
    // Mass, centre, and second moments about the centre.
    let (mass, center, second): (D, [D; 3], [[D; 3]; 3]) = match shape {
        Shape::Massless => (D::zero(), zero, [zero; 3]),
        Shape::Point { mass, center } => (number(mass), vector(center), [zero; 3]),
        Shape::Rod {
            mass,
            length,
            along: a,
            center,
        } => {
            let (m, l) = (number(mass), number(length));
            let half = a.map(|component| l * (0.5 * component / norm(*a)));
            let center = center.as_ref().map_or(half, vector);
            (
                m,
                center,
                table(|i, j| m * l * l * (along(*a, i, j) / 12.0)),
            )
        }
        Shape::Disk {
            mass,
            radius,
            axis,
            center,
        } => {
            let (m, r) = (number(mass), number(radius));
            (
                m,
                vector(center),
                table(|i, j| m * r * r * (across(*axis, i, j) / 4.0)),
            )
        }
        Shape::Cylinder {
            mass,
            radius,
            length,
            axis,
            center,
        } => {
            let (m, r, l) = (number(mass), number(radius), number(length));
            let moments = |i, j| {
                m * r * r * (across(*axis, i, j) / 4.0) + m * l * l * (along(*axis, i, j) / 12.0)
            };
            (m, vector(center), table(moments))
        }
        Shape::Cuboid { mass, size, center } => {
            let (m, size) = (number(mass), vector(size));
            (
                m,
                vector(center),
                table(|i, j| m * size[i] * size[j] * (f64::from(i == j) / 12.0)),
            )
        }
        Shape::Sphere {
            mass,
            radius,
            center,
        } => {
            let (m, r) = (number(mass), number(radius));
            (
                m,
                vector(center),
                table(|i, j| m * r * r * (f64::from(i == j) / 5.0)),
            )
        }
        Shape::Rigid {
            mass,
            center,
            inertia,
        } => {
            let [xx, yy, zz, xy, yz, xz] = inertia.map(|entry| get(entry, design));
            let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
            let half_trace = (xx + yy + zz) * 0.5;
            let moments = |i: usize, j: usize| half_trace * f64::from(i == j) - tensor[i][j];
            (number(mass), vector(center), table(moments))
        }
    };
    let mut p = [[D::zero(); 4]; 4];
    for i in 0..3 {
        for j in 0..3 {
            p[i][j] = second[i][j] + mass * center[i] * center[j];
        }
        p[i][3] = mass * center[i];
        p[3][i] = p[i][3];
    }
    p[3][3] = mass;
    p
}

fn table<D>(entry: impl Fn(usize, usize) -> D) -> [[D; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}
