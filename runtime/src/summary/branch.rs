//! Whether a sample lies on the branch of the nominal equilibrium.

use crate::algebra::{Lu, Vector};
use crate::equilibrium::equilibrium;
use crate::kernels::Kernels;
use crate::{Equilibrium, Policy};

/// Maximum number of bisections of the path to a sample: a sample this close to a branch point counts as beyond it.
const HALVINGS: usize = 10;

/// Whether the equilibrium `q` of a design lies on the same branch as the nominal one.
///
/// Two stable equilibria of neighbouring designs lie on one branch if each is in the potential valley of the other: if
/// `det Khat` of each design has the same sign at both equilibria. At a pitchfork, the branch that ends and the one
/// that begins fail this test however close they are. Where the test is inconclusive, the path between the two designs
/// is bisected. Branches that meet where two stiffnesses vanish at once cannot be told apart.
pub(super) fn on_nominal_branch(
    mechanism: &dyn Kernels,
    nominal: &Equilibrium,
    design: &[f64],
    q: &[f64],
) -> bool {
    let way = Way { mechanism, nominal };
    let from = (&nominal.design[..], &nominal.coordinates[..]);
    way.connected(from, (design, q), HALVINGS)
}

struct Way<'a> {
    mechanism: &'a dyn Kernels,
    nominal: &'a Equilibrium,
}

impl Way<'_> {
    fn connected(&self, a: (&[f64], &[f64]), b: (&[f64], &[f64]), halvings: usize) -> bool {
        if self.negative(a.0, a.1) == self.negative(a.0, b.1)
            && self.negative(b.0, b.1) == self.negative(b.0, a.1)
        {
            return true;
        }
        if halvings == 0 {
            return false;
        }
        let design: Vector = a.0.iter().zip(b.0).map(|(a, b)| 0.5 * (a + b)).collect();
        let inputs = &self.nominal.inputs;
        let middle = equilibrium(self.mechanism, inputs, &design, a.1, Policy::Stable);
        middle.is_ok_and(|middle| {
            let middle = (&design[..], &middle.coordinates[..]);
            self.connected(a, middle, halvings - 1) && self.connected(middle, b, halvings - 1)
        })
    }

    /// The sign of `det Khat`, with the place held along free directions; `None` where it is singular.
    fn negative(&self, design: &[f64], q: &[f64]) -> Option<bool> {
        let (_, stiffness) = self
            .mechanism
            .residual_and_stiffness(q, &self.nominal.inputs, design);
        Lu::new(&self.nominal.free.held(&stiffness)).map(|factors| factors.negative_determinant())
    }
}
