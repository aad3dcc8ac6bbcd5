//! The solver against closed forms, exactly known spectra, another solver and hard random pencils.

mod checks;
mod closed_forms;
mod hard;
mod known;
mod parts;
mod torture;

use num_complex::Complex64;

use super::{Root, Roots, solve};
use crate::Linear;
use crate::modes::symmetric::Trouble;

fn linear<const N: usize>(
    mass: [[f64; N]; N],
    damping: [[f64; N]; N],
    stiffness: [[f64; N]; N],
) -> Linear<f64, N> {
    Linear {
        mass,
        damping,
        stiffness,
    }
}

fn identity<const N: usize>() -> [[f64; N]; N] {
    diagonal([1.0; N])
}

fn diagonal<const N: usize>(elements: [f64; N]) -> [[f64; N]; N] {
    let mut matrix = [[0.0; N]; N];
    for i in 0..N {
        matrix[i][i] = elements[i];
    }
    matrix
}

/// Every root, conjugates written out.
fn all<const N: usize>(roots: &Roots<N>) -> Vec<Complex64> {
    let mut values = Vec::new();
    for root in roots.as_slice() {
        values.push(root.s);
        if root.s.im > 0.0 {
            values.push(root.s.conj());
        }
    }
    values
}
