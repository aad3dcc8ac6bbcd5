//! Accelerations of the full nonlinear motion, for time integration by the caller.

use crate::algebra::{Cholesky, Lu, Matrix, Vector, all_finite, all_finite_matrix, dot};
use crate::arguments::check_count;
use crate::constraints::{Structure, Tangent, fix_gauge};
use crate::kernels::{DirectionalKernels, Kernels, Linear, MotionKernels};
use crate::shafts::refuse;
use crate::{Description, Error};

/// Accelerations `qddot` of the free coordinates, from `M* qddot = Q*` (eqs. 7-9).
///
/// `velocity` is `qdot`, `q` the coordinates, `u` the inputs, `b` the design variables; all SI. With speeds and
/// constraints the result holds `qddot`, the rates of the speeds, and the instantaneous reactions, from
///
/// ```text
/// [ M  H^T A^T ] [qddot, vdot]   [ -h                                                    ]
/// [ H  0   0   ] [mu_1       ] = [ -(H_q qdot) qdot                                      ]
/// [ A  0   0   ] [mu_2       ]   [ -(A_q' qdot) qdot - B qdot, B = d(A_v v + a)/dq       ]
/// ```
///
/// `q` must satisfy the position constraints, and `velocity` and the speeds in `q` their rates. The entries of
/// `velocity` for speeds and of `q` for reactions are ignored. If redundant constraints leave reactions undetermined,
/// those are returned whose forces have the smallest sum of squares.
///
/// # Errors
/// [`Error::SingularMass`] if `M*` is not positive definite (with constraints: over the motions they leave free),
/// [`Error::OutsideDomain`] if the state lies outside the domain of an expression, [`Error::WrongLength`].
pub fn accelerations(
    mechanism: &dyn MotionKernels,
    velocity: &[f64],
    q: &[f64],
    u: &[f64],
    b: &[f64],
) -> Result<Vector, Error> {
    let description = &*mechanism.description();
    check_count("velocities", velocity, description.coordinates.len())?;
    check_count("coordinates", q, description.coordinates.len())?;
    check_count("inputs", u, description.inputs.len())?;
    check_count("design variables", b, description.design.len())?;
    refuse(description, "accelerations")?;
    let structure = Structure::of(description);
    if !structure.open() {
        return constrained_accelerations(mechanism, structure, velocity, q, u, b);
    }
    let (mass, right) = mechanism.motion(velocity, q, u, b);
    if !all_finite(&right) || !all_finite_matrix(&mass) {
        return Err(outside(description, q));
    }
    Cholesky::new(&mass).map(|factors| factors.solve(&right)).map_err(|row| singular(description, row))
}

fn constrained_accelerations(
    mechanism: &dyn MotionKernels,
    structure: Structure,
    velocity: &[f64],
    q: &[f64],
    u: &[f64],
    b: &[f64],
) -> Result<Vector, Error> {
    let (plain, directional): (&dyn Kernels, &dyn DirectionalKernels) = (mechanism, mechanism);
    let (n, motions) = (q.len(), structure.motions());
    let only = |x: &[f64], count: usize| -> Vector { Vector::from_fn(n, |i| if i < count { x[i] } else { 0.0 }) };
    let rates = only(velocity, structure.coordinates);
    let q = only(q, motions);
    let rest = mechanism.motion_residual(&Vector::zeros(n), &rates, &q, u, b);
    let linear = plain.linear(&q, u, b);
    let still = (Vector::zeros(u.len()), Vector::zeros(b.len()));
    let along = directional.linear_along(&q, u, b, [&rates, &still.0, &still.1]);
    // Columns of the accelerations and speed rates, then those of the reactions.
    let mut matrix = Matrix::from_fn(n, n, |i, j| {
        if structure.position_rows().contains(&i) || j >= motions {
            linear.stiffness[i][j]
        } else if structure.velocity_rows().contains(&i) {
            by_velocity(&linear, structure, i, j)
        } else if j < structure.coordinates {
            linear.mass[i][j]
        } else {
            linear.damping[i][j]
        }
    });
    let right = Vector::from_fn(n, |i| {
        if i < motions {
            -rest[i]
        } else if structure.position_rows().contains(&i) {
            -dot(&along.stiffness[i], &rates)
        } else {
            -dot(&along.damping[i], &rates) - dot(&linear.stiffness[i], &rates)
        }
    });
    if !all_finite(&right) || !all_finite_matrix(&matrix) {
        return Err(outside(&mechanism.description(), &q));
    }
    fix_gauge(&mut matrix, structure);
    if let Some(lu) = Lu::new(&matrix) {
        return Ok(lu.solve(&right));
    }
    let row = Tangent::new(&linear, structure).massless(&linear);
    Err(singular(&mechanism.description(), row))
}

/// Derivative of velocity constraint `i` with respect to the velocity of a coordinate or to a speed.
fn by_velocity(linear: &Linear, structure: Structure, i: usize, j: usize) -> f64 {
    if j < structure.coordinates { linear.damping[i][j] } else { linear.stiffness[i][j] }
}

fn outside(description: &Description, q: &[f64]) -> Error {
    Error::OutsideDomain {
        mechanism: description.name.clone(),
        what: "the equation of motion",
        coordinates: q.to_vec(),
    }
}

fn singular(description: &Description, row: usize) -> Error {
    Error::SingularMass { coordinate: description.unknown_name(row) }
}
