//! Constraints on positions only: the quadratic problem `(s^2 P^T M P + s P^T C P + P^T K_c P) y = 0`.

use super::{Gathered, Normalisation, is_shared, lift, projected, with_reactions};
use crate::constraints::Tangent;
use crate::modes::general::{Eigenproblem, Numbers, Roots, solve_on};
use crate::modes::symmetric::Trouble;
use crate::{Complex, Linear};

pub(super) fn roots<const N: usize>(
    linear: &Linear<f64, N>,
    tangent: &Tangent<N>,
) -> Result<Roots<N>, Trouble> {
    let f = tangent.freedom;
    let mut store = [[[0.0; N]; N]; 3];
    let [mass, damping, stiffness] = store.each_mut().map(|matrix| {
        let all = matrix.as_flattened_mut();
        &mut all[..f * f]
    });
    projected(&linear.mass, tangent, mass);
    projected(&linear.damping, tangent, damping);
    projected(&linear.stiffness, tangent, stiffness);
    let mut numbers = [[Numbers::NONE; 2]; N];
    let mut right = [[[Complex::default(); N]; 2]; N];
    let mut left = right;
    let right = &mut right.as_flattened_mut().as_flattened_mut()[..2 * f * f];
    let left = &mut left.as_flattened_mut().as_flattened_mut()[..2 * f * f];
    let problem = Eigenproblem::Quadratic {
        n: f,
        mass,
        damping,
        stiffness,
    };
    let count = solve_on(problem, numbers.as_flattened_mut(), right, left)
        .map_err(|trouble| tangent_trouble(trouble, tangent))?;
    let numbers = &numbers.as_flattened()[..count];
    let transposed = transposed(linear);
    let mut gathered = Gathered::new(linear, tangent.structure, Normalisation::Mass);
    for (i, own) in numbers.iter().enumerate() {
        let vector = i * f..(i + 1) * f;
        let phi = lift(tangent, &right[vector.clone()]);
        let psi = lift(tangent, &left[vector]);
        gathered.add(
            own,
            is_shared(numbers, i),
            with_reactions(linear, tangent, own.s, &phi),
            with_reactions(&transposed, tangent, own.s, &psi),
        )?;
    }
    Ok(gathered.roots)
}

/// Names a coordinate that the massless direction moves.
pub(super) fn tangent_trouble<const N: usize>(trouble: Trouble, tangent: &Tangent<N>) -> Trouble {
    match trouble {
        Trouble::SingularMass(row) => {
            Trouble::SingularMass(tangent.basis.get(row).map_or(0, greatest))
        }
        other => other,
    }
}

/// Position of the component of greatest size.
pub(super) fn greatest<const N: usize>(x: &[f64; N]) -> usize {
    (1..N).fold(
        0,
        |most, i| if x[i].abs() > x[most].abs() { i } else { most },
    )
}

fn transposed<const N: usize>(linear: &Linear<f64, N>) -> Linear<f64, N> {
    Linear {
        mass: crate::array::transpose(&linear.mass),
        damping: crate::array::transpose(&linear.damping),
        stiffness: crate::array::transpose(&linear.stiffness),
    }
}
