//! Accelerations of the full nonlinear motion, for those who integrate it in time.

use crate::array::{Cholesky, Lu, Square, all_finite, all_finite_square, dot};
use crate::constraints::{Structure, Tangent, fix_gauge};
use crate::{Error, Linear, Mechanism};

/// Accelerations `qddot` of the free coordinates, from `M* qddot = Q*` (eqs. 7-9).
///
/// `velocity` is `qdot`, `q` coordinates, `u` inputs, `b` design variables; all SI. With speeds and constraints the result holds
/// `qddot`, the rates of the speeds, and the reactions at this instant, from
///
/// ```text
/// [ M  H^T A^T ] [qddot, vdot]   [ -h                                                    ]
/// [ H  0   0   ] [mu_1       ] = [ -(H_q qdot) qdot                                      ]
/// [ A  0   0   ] [mu_2       ]   [ -(A_q' qdot) qdot - B qdot, B = d(A_v v + a)/dq       ]
/// ```
///
/// `q` has to meet the constraints on positions, `velocity` and the speeds in `q` their rates; what `velocity` holds in the
/// places of speeds and `q` in those of reactions does not matter. Reactions that redundant constraints leave undetermined are
/// the least.
///
/// # Errors
/// [`Error::SingularMass`] when `M*` is not positive definite (with constraints: over the motions they leave),
/// [`Error::OutsideDomain`] when the state lies outside the domain of an expression.
pub fn accelerations<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    velocity: &[f64; N],
    q: &[f64; N],
    u: &[f64; U],
    b: &[f64; P],
) -> Result<[f64; N], Error>
where
    M: Mechanism<N, U, P, O>,
{
    if const { !Structure::of(&M::DESCRIPTION).open() } {
        return constrained(mechanism, velocity, q, u, b);
    }
    let (mass, right) = mechanism.motion(velocity, q, u, b);
    if !all_finite(&right) || !all_finite_square(&mass) {
        return Err(outside::<M, N, U, P, O>(q));
    }
    Cholesky::new(&mass)
        .map(|factors| factors.solve(&right))
        .map_err(|row| singular::<M, N, U, P, O>(row))
}

fn constrained<M, const N: usize, const U: usize, const P: usize, const O: usize>(
    mechanism: &M,
    velocity: &[f64; N],
    q: &[f64; N],
    u: &[f64; U],
    b: &[f64; P],
) -> Result<[f64; N], Error>
where
    M: Mechanism<N, U, P, O>,
{
    let structure = Structure::of(&M::DESCRIPTION);
    let motions = structure.motions();
    let only = |x: &[f64; N], count: usize| -> [f64; N] {
        core::array::from_fn(|i| if i < count { x[i] } else { 0.0 })
    };
    let rates = only(velocity, structure.coordinates);
    let q = only(q, motions);
    let rest = mechanism.motion_residual(&[0.0; N], &rates, &q, u, b);
    let linear = mechanism.linear(&q, u, b);
    let along = mechanism.linear_along(&q, u, b, &rates, &[0.0; U], &[0.0; P]);
    // Columns of accelerations and of rates of speeds, and those of reactions.
    let mut matrix: Square<N> = core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            if structure.position_rows().contains(&i) || j >= motions {
                linear.stiffness[i][j]
            } else if structure.velocity_rows().contains(&i) {
                by_velocity(&linear, structure, i, j)
            } else if j < structure.coordinates {
                linear.mass[i][j]
            } else {
                linear.damping[i][j]
            }
        })
    });
    let right: [f64; N] = core::array::from_fn(|i| {
        if i < motions {
            -rest[i]
        } else if structure.position_rows().contains(&i) {
            -dot(&along.stiffness[i], &rates)
        } else {
            -dot(&along.damping[i], &rates) - dot(&linear.stiffness[i], &rates)
        }
    });
    if !all_finite(&right) || !all_finite_square(&matrix) {
        return Err(outside::<M, N, U, P, O>(&q));
    }
    fix_gauge(&mut matrix, structure);
    if let Some(lu) = Lu::new(&matrix) {
        return Ok(lu.solve(&right));
    }
    let row = Tangent::new(&linear, structure).massless(&linear);
    Err(singular::<M, N, U, P, O>(row))
}

/// Derivative of constraint on velocities `i` by the velocity of a coordinate or by a speed.
fn by_velocity<const N: usize>(
    linear: &Linear<f64, N>,
    structure: Structure,
    i: usize,
    j: usize,
) -> f64 {
    if j < structure.coordinates {
        linear.damping[i][j]
    } else {
        linear.stiffness[i][j]
    }
}

fn outside<M, const N: usize, const U: usize, const P: usize, const O: usize>(q: &[f64; N]) -> Error
where
    M: Mechanism<N, U, P, O>,
{
    Error::OutsideDomain {
        mechanism: M::DESCRIPTION.name,
        what: "the equation of motion",
        coordinates: q.to_vec(),
    }
}

fn singular<M, const N: usize, const U: usize, const P: usize, const O: usize>(row: usize) -> Error
where
    M: Mechanism<N, U, P, O>,
{
    Error::SingularMass {
        coordinate: M::DESCRIPTION
            .coordinates
            .get(row)
            .map_or("?", |info| info.name),
    }
}
