//! First and second total derivatives, obtained by solving the whole problem again in hyper-dual numbers: equilibrium,
//! matrices, eigenpairs, forced vibrations. No derivative formula is used here, neither adjoint nor Nelson's; where the
//! product uses one, it must agree with this.
//!
//! A solution `x` of `F(x; p) = 0` in doubles becomes one in hyper-dual numbers by repeating `x -= J^-1 F(x; p)` with
//! the Jacobian in doubles: each repetition makes one more order of the infinitesimals exact.
//!
//! Variables are the design variables, then the inputs. The only compiler kernels used are `residual`, `linear`,
//! `outputs`, `forcing` and `output_motion`, and the stiffness from `residual_and_stiffness` where Newton's method needs
//! a Jacobian.

mod complex;
pub mod dual;
pub mod hyper;
mod machine;
mod modes;
mod num_dual;
mod pair;
mod spectrum;
mod vibrations;

pub use machine::{Machine, State};
pub use modes::{ComplexDerived, GeneralMode, UndampedMode};
pub use vibrations::Vibration;

use crate::hyper::Hyper;

/// A number with all its total derivatives: by design variables first, then by inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// The number itself.
    pub value: f64,
    /// First derivatives.
    pub gradient: Vec<f64>,
    /// Second derivatives, symmetric.
    pub hessian: Vec<Vec<f64>>,
}

/// Pairs of variables `i <= j`, in the order of the hyper-dual solutions.
fn pairs(variables: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..variables).flat_map(move |i| (i..variables).map(move |j| (i, j)))
}

impl Derived {
    /// Assembles the derivatives found along each of [`pairs`]; with no variables, the value of the single solution.
    fn collect(variables: usize, solutions: impl Iterator<Item = Hyper>) -> Self {
        let solutions: Vec<[f64; 4]> = solutions.map(Hyper::parts).collect();
        let mut gradient = vec![0.0; variables];
        let mut hessian = vec![vec![0.0; variables]; variables];
        for ((i, j), [_, by_i, by_j, by_both]) in pairs(variables).zip(&solutions) {
            (gradient[i], gradient[j]) = (*by_i, *by_j);
            (hessian[i][j], hessian[j][i]) = (*by_both, *by_both);
        }
        Self { value: solutions[0][0], gradient, hessian }
    }
}
