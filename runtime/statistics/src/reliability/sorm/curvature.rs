//! Principal curvatures of the limit at a design point.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::Error;
use crate::reliability::counted::Counted;
use crate::reliability::form::DesignPoint;
use crate::reliability::vector::{add_scaled, dot};

/// Cube root of the rounding unit: the step of central differences for which rounding and truncation errors are
/// balanced.
const STEP: f64 = 6e-6;

/// The principal curvatures in ascending order, one fewer than there are variables; positive if the limit bends away
/// from a safe origin. They are the eigenvalues of `T^T H T / |grad g|`, where the columns of `T` are an orthonormal
/// basis of the tangent plane.
pub(super) fn principal_curvatures(limit: &Counted, at: &DesignPoint) -> Result<Vec<f64>, Error> {
    let tangents = tangent_basis(&at.direction);
    let products = match limit.hessian(&at.point)? {
        Some(hessian) => tangents.iter().map(|t| multiply(&hessian, t)).collect(),
        None => differences(limit, at, &tangents)?,
    };
    let entry = |i: usize, j: usize| {
        let (a, b) = (dot(&tangents[i], &products[j]), dot(&tangents[j], &products[i]));
        0.5 * (a / at.gradient_norm + b / at.gradient_norm)
    };
    let matrix = DMatrix::from_fn(tangents.len(), tangents.len(), entry);
    let mut curvatures: Vec<f64> = match matrix.nrows() {
        0 => Vec::new(),
        _ => SymmetricEigen::new(matrix).eigenvalues.iter().copied().collect(),
    };
    curvatures.sort_by(f64::total_cmp);
    Ok(curvatures)
}

/// `H t` for each tangent, by central differences of the gradient; a step that leaves the domain is halved.
fn differences(limit: &Counted, at: &DesignPoint, tangents: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
    let along = |tangent: &Vec<f64>| {
        let mut step = STEP * at.beta.abs().max(1.0);
        for _ in 0..8 {
            let ahead = limit.evaluate(&add_scaled(&at.point, step, tangent));
            let behind = limit.evaluate(&add_scaled(&at.point, -step, tangent));
            if let (Some(ahead), Some(behind)) = (ahead, behind) {
                let pairs = ahead.gradient.iter().zip(&behind.gradient);
                return Ok(pairs.map(|(a, b)| (a - b) / (2.0 * step)).collect());
            }
            step *= 0.5;
        }
        Err(limit.no_value("beside the design point"))
    };
    tangents.iter().map(along).collect()
}

/// Orthonormal vectors perpendicular to a unit vector: all but the first column of the Householder reflection that maps
/// the first axis to it.
fn tangent_basis(direction: &[f64]) -> Vec<Vec<f64>> {
    let mut reflector = direction.to_vec();
    reflector[0] += 1.0_f64.copysign(direction[0]);
    let square = dot(&reflector, &reflector);
    let column = |i: usize| {
        let mut column = vec![0.0; direction.len()];
        column[i] = 1.0;
        add_scaled(&column, -2.0 * reflector[i] / square, &reflector)
    };
    (1..direction.len()).map(column).collect()
}

fn multiply(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, vector)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangents_are_orthonormal() {
        for direction in [vec![1.0, 0.0, 0.0], vec![-0.6, 0.0, 0.8], vec![0.0, -1.0, 0.0]] {
            let mut all = tangent_basis(&direction);
            all.push(direction);
            for (i, a) in all.iter().enumerate() {
                for (j, b) in all.iter().enumerate() {
                    let expected = f64::from(u8::from(i == j));
                    assert!((dot(a, b) - expected).abs() < 1e-15, "{all:?}");
                }
            }
        }
    }
}
