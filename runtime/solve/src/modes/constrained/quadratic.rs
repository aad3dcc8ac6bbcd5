//! Constraints on positions only: the quadratic problem `(s^2 P^T M P + s P^T C P + P^T K_c P) y = 0`.

use super::{Gathered, is_shared, lift, projected, with_reactions};
use crate::constraints::Tangent;
use crate::eigenproblem::{EigenproblemError, Root, general};
use crate::kernels::Linear;
use crate::modes::deflation;
use crate::modes::normalisation::Normalisation;
use crate::modes::pencil::transposed;

pub(super) fn roots(linear: &Linear, tangent: &Tangent, free: usize) -> Result<Vec<Root>, EigenproblemError> {
    let reduced = Linear {
        mass: projected(&linear.mass, tangent),
        damping: projected(&linear.damping, tangent),
        stiffness: projected(&linear.stiffness, tangent),
    };
    let reduced =
        deflation::roots(&reduced, free, general::solve).map_err(|trouble| tangent_trouble(trouble, tangent))?;
    let transposed = transposed(linear);
    let mut gathered = Gathered::new(linear, tangent.structure, Normalisation::Mass);
    for (i, root) in reduced.iter().enumerate() {
        let (phi, psi) = (lift(tangent, &root.right), lift(tangent, &root.left));
        gathered.add(
            root,
            is_shared(&reduced, i),
            with_reactions(linear, tangent, root.s, &phi),
            with_reactions(&transposed, tangent, root.s, &psi),
        );
    }
    Ok(gathered.roots)
}

/// Names a coordinate moved by the massless direction.
pub(super) fn tangent_trouble(trouble: EigenproblemError, tangent: &Tangent) -> EigenproblemError {
    match trouble {
        EigenproblemError::SingularMass(row) => {
            EigenproblemError::SingularMass(tangent.basis.get(row).map_or(0, |x| greatest(x)))
        }
        other => other,
    }
}

/// Position of the component of largest magnitude.
pub(super) fn greatest(x: &[f64]) -> usize {
    (1..x.len()).fold(0, |most, i| if x[i].abs() > x[most].abs() { i } else { most })
}
