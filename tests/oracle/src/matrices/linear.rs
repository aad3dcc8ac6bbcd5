//! Linearisation at rest (eqs. 15-17, in complete form) and its partial derivatives.

use num_dual::Dual;

use super::scalar::{along, rates, seeded, still};
use super::{Oracle, Scalar, State};

/// `Mhat`, `Chat`, `Khat`, each row by row.
#[derive(Clone, Debug)]
pub struct Linear<D> {
    /// `dg/dqddot`.
    pub mass: Vec<D>,
    /// `dg/dqdot_R`.
    pub damping: Vec<D>,
    /// `dg/dq_R`.
    pub stiffness: Vec<D>,
}

/// Partial derivatives of the three matrices by each coordinate, input and design variable.
#[derive(Clone, Debug)]
pub struct LinearPartials {
    /// By each free coordinate.
    pub by_coordinate: Vec<Linear<f64>>,
    /// By each input.
    pub by_input: Vec<Linear<f64>>,
    /// By each design variable.
    pub by_design: Vec<Linear<f64>>,
}

impl<D: Scalar> Linear<Dual<D>> {
    fn rates(&self) -> Linear<D> {
        Linear { mass: rates(&self.mass), damping: rates(&self.damping), stiffness: rates(&self.stiffness) }
    }
}

impl Oracle<'_> {
    /// `g(0, 0, q; u, b)` (eq. 10).
    pub fn residual<D: Scalar>(&self, q: &[D], u: &[D], b: &[D]) -> Vec<D> {
        self.motion_residual(&State::at_rest(q, u, b))
    }

    /// Eqs. 15-17: the complete residual differentiated by accelerations, speeds and positions.
    pub fn linear<D: Scalar>(&self, q: &[D], u: &[D], b: &[D]) -> Linear<D> {
        let rest = State::at_rest(q, u, b).lifted();
        let jacobian = |seed: &dyn Fn(&mut State<Dual<D>>, usize)| {
            let column = |j| {
                let mut state = rest.clone();
                seed(&mut state, j);
                rates(&self.motion_residual(&state))
            };
            by_rows(&(0..q.len()).map(column).collect::<Vec<_>>())
        };
        Linear {
            mass: jacobian(&|state, j| state.acceleration[j].eps = D::one()),
            damping: jacobian(&|state, j| state.velocity[j].eps = D::one()),
            stiffness: jacobian(&|state, j| state.position[j].eps = D::one()),
        }
    }

    /// Explicit partial derivatives of the residual at rest by each input and each design variable, flattened with one
    /// row per coordinate.
    pub fn residual_partials(&self, q: &[f64], u: &[f64], b: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (q0, u0, b0) = (still(q), still(u), still(b));
        let by_input = (0..u.len()).map(|k| rates(&self.residual(&q0, &seeded(u, k), &b0))).collect::<Vec<_>>();
        let by_design = (0..b.len()).map(|k| rates(&self.residual(&q0, &u0, &seeded(b, k)))).collect::<Vec<_>>();
        (by_rows(&by_input), by_rows(&by_design))
    }

    /// Explicit partial derivatives of eqs. 15-17.
    pub fn linear_partials(&self, q: &[f64], u: &[f64], b: &[f64]) -> LinearPartials {
        let (q0, u0, b0) = (still(q), still(u), still(b));
        let by =
            |count: usize, linear: &dyn Fn(usize) -> Linear<Dual<f64>>| (0..count).map(|k| linear(k).rates()).collect();
        LinearPartials {
            by_coordinate: by(q.len(), &|k| self.linear(&seeded(q, k), &u0, &b0)),
            by_input: by(u.len(), &|k| self.linear(&q0, &seeded(u, k), &b0)),
            by_design: by(b.len(), &|k| self.linear(&q0, &u0, &seeded(b, k))),
        }
    }

    /// Directional derivatives of eqs. 15-17 along `(dq, du, db)`.
    pub fn linear_along(&self, [q, u, b]: [&[f64]; 3], [dq, du, db]: [&[f64]; 3]) -> Linear<f64> {
        self.linear(&along(q, dq), &along(u, du), &along(b, db)).rates()
    }
}

/// The entries, by rows, of a matrix given by columns.
fn by_rows<D: Scalar>(columns: &[Vec<D>]) -> Vec<D> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
}
