//! The solver against closed forms, exactly known spectra, another solver and hard random pencils.

mod checks;
mod closed_forms;
mod conservative;
mod families;
mod hard;
mod known;
mod machines;
mod near;
mod parts;
mod pencils;
mod refined;
mod scale;
mod stored;
mod torture;

use num_complex::Complex64;

use super::{Root, solve};
use crate::algebra::{Matrix, Vector};
use crate::eigenproblem::symmetric::EigenproblemError;
use crate::linear::Linear;
use pencils::{diagonal, identity, linear, zeros};

/// All roots, including conjugates.
fn all(roots: &[Root]) -> Vec<Complex64> {
    let mut values = Vec::new();
    for root in roots {
        values.push(root.s);
        if root.s.im > 0.0 {
            values.push(root.s.conj());
        }
    }
    values
}
