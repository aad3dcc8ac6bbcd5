//! Derives the same residual a second way, from Lagrange's equations, sharing no kinematics with the oracle.
//!
//! `g_i = d/dt (dL/dqdot_i) - dL/dq_i + dD/dqdot_i - Q_i` with `L = T - V`, Rayleigh's dissipation function `D` and the
//! virtual work `Q_i dq_i` of forces that have neither an energy nor a dissipation function. Poses are 4 x 4 matrices
//! built from quaternions. The kinetic energy of a body is `1/2 tr(Xdot P Xdot^T)` with its pseudo-inertia
//! `P = integral [r; 1] [r; 1]^T dm`, so neither angular velocities nor gyroscopic moments occur. Every derivative is a
//! hyper-dual number. Beams are slices whose places come from the same integrals as in the product, computed here from
//! scratch; strain is `R^T dR/ds`.

mod beams;
mod expressions;
mod masses;
mod poses;
mod work;

use num_dual::{Dual, HyperDual64};

use self::expressions::evaluate;
use self::masses::pseudo_inertia;
use self::poses::{Poses, get, index, lift};
use crate::matrices::Scalar;
use crate::model::{ForceLaw, Model};

/// Coordinates and speeds of all joints, inputs, design variables.
struct Flow<'a, D> {
    model: &'a Model,
    position: Vec<D>,
    speed: Vec<D>,
    inputs: &'a [f64],
    design: Vec<D>,
}

impl<'a, D: Scalar> Flow<'a, D> {
    /// Poses and their time rates.
    fn moving(&self) -> Poses<'a, Dual<D>> {
        let both = self.position.iter().zip(&self.speed);
        let position = both.map(|(&x, &v)| Dual::new(x, v)).collect();
        Poses::new(self.model, position, lift(&self.design))
    }
}

/// `g(qddot, qdot, q; u, b)` by Lagrange's equations.
pub fn residual(model: &Model, [acceleration, velocity, q]: [&[f64]; 3], inputs: &[f64], design: &[f64]) -> Vec<f64> {
    let all = model.coordinates();
    let mut position = vec![0.0; all.len()];
    let (mut speed, mut gain) = (position.clone(), position.clone());
    let free: Vec<usize> = model.free().iter().map(|&q| index(&all, q)).collect();
    for (place, &coordinate) in free.iter().enumerate() {
        position[coordinate] = q[place];
        speed[coordinate] = velocity[place];
        gain[coordinate] = acceleration[place];
    }
    for coordinate in model.driven() {
        let drive = model.step(coordinate).drive.expect("it is driven");
        speed[index(&all, coordinate)] = drive.factor * inputs[drive.input];
    }
    // The second part of each number is its time rate.
    let in_time = |x: f64, rate: f64| HyperDual64::new(x, 0.0, rate, 0.0);
    let together = |values: &[f64], rates: &[f64]| -> Vec<HyperDual64> {
        let both = values.iter().zip(rates);
        both.map(|(&value, &rate)| in_time(value, rate)).collect()
    };
    let flow = || Flow {
        model,
        position: together(&position, &speed),
        speed: together(&speed, &gain),
        inputs,
        design: design.iter().map(|&b| in_time(b, 0.0)).collect(),
    };
    let still = Flow { model, position: position.clone(), speed: speed.clone(), inputs, design: design.to_vec() };
    let equation = |&coordinate: &usize| {
        let (mut by_speed, mut by_position) = (flow(), flow());
        by_speed.speed[coordinate].eps1 = 1.0;
        by_position.position[coordinate].eps1 = 1.0;
        // d/dt dL/dqdot_i - dL/dq_i + dD/dqdot_i - Q_i
        lagrangian(&by_speed).eps1eps2 - lagrangian(&by_position).eps1 + dissipation(&by_speed).eps1
            - work::along(&still, coordinate)
    };
    free.iter().map(equation).collect()
}

/// Kinetic and potential energy of a motion.
pub fn energies(model: &Model, [velocity, q]: [&[f64]; 2], inputs: &[f64], design: &[f64]) -> [f64; 2] {
    let (mut position, mut speed) = (Vec::new(), Vec::new());
    let mut free = q.iter().zip(velocity);
    for coordinate in model.coordinates() {
        let own = match model.step(coordinate).drive {
            Some(drive) => (&0.0, &(drive.factor * inputs[drive.input])),
            None => free.next().expect("one entry per free coordinate"),
        };
        position.push(*own.0);
        speed.push(*own.1);
    }
    let flow = Flow { model, position, speed, inputs, design: design.to_vec() };
    [kinetic(&flow), potential(&flow)]
}

/// `L = T - V`.
fn lagrangian<D: Scalar>(flow: &Flow<D>) -> D {
    kinetic(flow) - potential(flow)
}

/// `1/2 tr(Xdot P Xdot^T)`, one row of `Xdot` at a time; its last row is zero. And `1/2 inertance qdot^2` of inerters.
fn kinetic<D: Scalar>(flow: &Flow<D>) -> D {
    let mut total = D::zero();
    let poses = flow.moving();
    for force in &flow.model.forces {
        if let &ForceLaw::Inerter { coordinate, inertance } = &force.law {
            let speed = poses.coordinate(coordinate).eps;
            total += get(inertance, &flow.design) * speed * speed * 0.5;
        }
    }
    for (body, pose) in flow.model.bodies.iter().zip(&poses.bodies) {
        let p = pseudo_inertia(&body.parts, &flow.design);
        for row in &pose[..3] {
            for i in 0..4 {
                for j in 0..4 {
                    total += row[i].eps * p[i][j] * row[j].eps * 0.5;
                }
            }
        }
    }
    total
}

/// `-m gravity . c` of the bodies, and the energies of the elements and of the beams.
fn potential<D: Scalar>(flow: &Flow<D>) -> D {
    let model = flow.model;
    let here = Poses::new(model, flow.position.clone(), flow.design.clone());
    let gravity = model.gravity.map(|component| get(component, &flow.design));
    let mut total = beams::elastic(&here);
    for (body, pose) in model.bodies.iter().zip(&here.bodies) {
        let p = pseudo_inertia(&body.parts, &flow.design);
        for (row, gravity) in pose.iter().zip(gravity) {
            for i in 0..4 {
                total -= gravity * row[i] * p[i][3];
            }
        }
    }
    let elements = model.forces.iter();
    let elements = elements.map(|force| energy(flow, &here, &force.law));
    total + elements.sum::<D>()
}

/// Potential energy of an element; zero if it has none.
fn energy<D: Scalar>(flow: &Flow<D>, poses: &Poses<D>, law: &ForceLaw) -> D {
    let get = |v| get(v, &flow.design);
    match law {
        // 1/2 k (q - q0)^2
        &ForceLaw::Spring { coordinate, stiffness, rest } => {
            let stretch = poses.coordinate(coordinate) - get(rest);
            get(stiffness) * stretch * stretch * 0.5
        }
        // 1/2 k (d - L)^2
        &ForceLaw::SpringDamper { from, to, stiffness, length, .. } => {
            let stretch = poses.distance(from, to) - get(length);
            get(stiffness) * stretch * stretch * 0.5
        }
        ForceLaw::Potential { energy } => evaluate(energy, flow.inputs, poses),
        // 1/2 d . K d; only the symmetric part of K counts
        ForceLaw::Bushing { from, to, stiffness, .. } => {
            let relative = poses.relative(*from, *to);
            let d = [relative[0][3], relative[1][3], relative[2][3]];
            half_form(stiffness.map(|row| row.map(get)), d)
        }
        // -F . p
        ForceLaw::Load { point, force, following: false, .. } => {
            let at = poses.position(*point);
            -(0..3).map(|i| get(force[i]) * at[i]).sum::<D>()
        }
        _ => D::zero(),
    }
}

/// Rayleigh's dissipation function.
fn dissipation<D: Scalar>(flow: &Flow<D>) -> D {
    let poses = flow.moving();
    let get = |v| get(v, &flow.design);
    let speed = |coordinate| poses.coordinate(coordinate).eps;
    let power = |law: &ForceLaw| match law {
        // 1/2 c qdot^2
        &ForceLaw::Damper { coordinate, damping } => get(damping) * speed(coordinate) * speed(coordinate) * 0.5,
        // 1/2 c ddot^2
        &ForceLaw::SpringDamper { from, to, damping, .. } => {
            let rate = poses.distance(from, to).eps;
            get(damping) * rate * rate * 0.5
        }
        // 1/2 d' . C d'; only the symmetric part of C counts
        ForceLaw::Bushing { from, to, damping, .. } => {
            let relative = poses.relative(*from, *to);
            let rate = [relative[0][3].eps, relative[1][3].eps, relative[2][3].eps];
            half_form(damping.map(|row| row.map(get)), rate)
        }
        // 1/2 c v^2 + 1/2 ct omega^2, and the squares of the entries of Rdot add up to 2 omega^2
        &ForceLaw::Drag { point, damping, turning_damping } => {
            let frame = poses.point(point);
            let squares = |columns: std::ops::Range<usize>| {
                let mut sum = D::zero();
                for row in &frame[..3] {
                    for entry in &row[columns.clone()] {
                        sum += entry.eps * entry.eps;
                    }
                }
                sum
            };
            get(damping) * squares(3..4) * 0.5 + get(turning_damping) * squares(0..3) * 0.25
        }
        _ => D::zero(),
    };
    let here = Poses::new(flow.model, flow.position.clone(), flow.design.clone());
    model_forces(flow).map(power).sum::<D>() + beams::dissipated(&here, &poses)
}

fn model_forces<'a, D>(flow: &Flow<'a, D>) -> impl Iterator<Item = &'a ForceLaw> {
    flow.model.forces.iter().map(|force| &force.law)
}

/// `1/2 x . A x`.
fn half_form<D: Scalar>(a: [[D; 3]; 3], x: [D; 3]) -> D {
    let rows = a.iter().zip(x);
    let products = rows.flat_map(|(row, xi)| row.iter().zip(x).map(move |(&aij, xj)| xi * aij * xj));
    products.sum::<D>() * 0.5
}
