//! Accelerations of the full nonlinear motion, for those who integrate it in time.

use crate::array::{Cholesky, all_finite};
use crate::{Error, Mechanism};

/// Accelerations `qddot` of the free coordinates, from `M* qddot = Q*` (eqs. 7-9).
///
/// `velocity` is `qdot`, `q` coordinates, `u` inputs, `b` design variables; all SI.
///
/// # Errors
/// [`Error::SingularMass`] when `M*` is not positive definite, [`Error::OutsideDomain`] when the state lies outside the
/// domain of an expression.
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
    let (mass, right) = mechanism.motion(velocity, q, u, b);
    if !all_finite(&right) || !crate::array::all_finite_square(&mass) {
        return Err(Error::OutsideDomain {
            mechanism: M::DESCRIPTION.name,
            what: "the equation of motion",
            coordinates: q.to_vec(),
        });
    }
    match Cholesky::new(&mass) {
        Ok(factors) => Ok(factors.solve(&right)),
        Err(row) => Err(Error::SingularMass {
            coordinate: M::DESCRIPTION
                .coordinates
                .get(row)
                .map_or("?", |info| info.name),
        }),
    }
}
