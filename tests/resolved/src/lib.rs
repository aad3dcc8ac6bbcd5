//! Total derivatives, first and second, by solving the whole problem again in hyper-dual numbers: equilibrium, matrices,
//! eigenpairs. No formula of a derivative occurs here, neither adjoint nor Nelson's; where the product has one, this is what
//! it must agree with.
//!
//! A solution `x` of `F(x; p) = 0` in doubles becomes one in hyper-dual numbers by repeating `x -= J^-1 F(x; p)` with the
//! Jacobian of the doubles: each repetition makes one more order of the infinitesimals exact.
//!
//! Variables are the design variables, then the inputs. Of the compiler only the kernels `residual`, `linear` and
//! `outputs` are used, and the stiffness of `residual_and_stiffness` where Newton's method needs some Jacobian.

mod complex;
pub mod dual;
pub mod hyper;
mod machine;
mod modes;
mod num_dual;
mod pair;
mod spectrum;

pub use machine::{Machine, State};
pub use modes::{ComplexDerived, GeneralMode, UndampedMode};

use crate::hyper::Hyper;

/// A number with all its total derivatives by the variables: design variables first, then inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// The number itself.
    pub value: f64,
    /// First derivatives.
    pub gradient: Vec<f64>,
    /// Second derivatives, symmetric.
    pub hessian: Vec<Vec<f64>>,
}

/// Pairs of variables `i <= j`, the order of the solutions in hyper-dual numbers.
fn pairs(variables: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..variables).flat_map(move |i| (i..variables).map(move |j| (i, j)))
}

impl Derived {
    /// Puts together what was found along each of [`pairs`]; for no variables, from a single solution.
    fn collect(variables: usize, solutions: impl Iterator<Item = Hyper>) -> Self {
        let solutions: Vec<[f64; 4]> = solutions.map(Hyper::parts).collect();
        let mut gradient = vec![0.0; variables];
        let mut hessian = vec![vec![0.0; variables]; variables];
        for ((i, j), [_, by_i, by_j, by_both]) in pairs(variables).zip(&solutions) {
            (gradient[i], gradient[j]) = (*by_i, *by_j);
            (hessian[i][j], hessian[j][i]) = (*by_both, *by_both);
        }
        Self {
            value: solutions[0][0],
            gradient,
            hessian,
        }
    }
}
