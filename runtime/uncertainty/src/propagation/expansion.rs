//! Taylor expansions of responses at the nominal design.

use super::model::{Evaluated, Model, Take};
use super::space::Space;
use crate::Error;
use crate::algebra::{Matrix, Vector, dot, form};
use crate::kernels::CurvatureKernels;
use crate::quadratic::QuadraticModels;
use crate::response::Responses;
use crate::tolerance::Outcome;

/// `f(b0 + x) = value + S x + x^T H x / 2`, SI.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    pub(super) value: f64,
    pub(super) slopes: Vector,
    /// `H`, if known.
    pub(super) curvature: Option<Matrix>,
}

impl Expansion {
    /// The first-order value at a step `x` from the nominal design.
    pub(super) fn first_order(&self, x: &[f64]) -> f64 {
        self.value + dot(&self.slopes, x)
    }

    /// The second-order value at a step `x`.
    pub(super) fn second_order(&self, x: &[f64]) -> Option<f64> {
        let curvature = self.curvature.as_ref()?;
        Some(self.first_order(x) + 0.5 * form(x, curvature, x))
    }
}

/// Expands the responses about the nominal design; `None` if a response has no value or slopes there. Second
/// derivatives are missing for modes that are too close together, outputs that are not smooth, and transcritical branch
/// points.
pub(super) fn expansions(
    mechanism: &dyn CurvatureKernels,
    responses: &Responses<'_>,
) -> Result<Vec<Option<Expansion>>, Error> {
    let at = responses.nominal();
    let realisation = responses.with_gradients(&mut responses.workspace(), &at.design)?;
    let mut models = QuadraticModels::new(mechanism, responses);
    let values = realisation.values.iter().zip(realisation.gradients);
    Ok(responses
        .wanted()
        .iter()
        .zip(values)
        .map(|(response, (value, slopes))| {
            Some(Expansion {
                value: (*value)?,
                slopes: slopes?,
                curvature: models.of(*response).ok().map(|model| model.quadratic.curvature),
            })
        })
        .collect())
}

/// Evaluates every expansion to first order, then every one to second order.
pub(super) struct Polynomials<'a> {
    pub(super) space: &'a Space<'a>,
    pub(super) expansions: &'a [Option<Expansion>],
}

impl Model for Polynomials<'_> {
    /// A design, the step to it, and the values of the expansions there.
    type Room = (Vector, Vector, Vec<Option<f64>>);

    fn room(&self) -> Self::Room {
        let nominal = Vector::from(self.space.nominal);
        let values = vec![None; 2 * self.expansions.len()];
        (nominal.clone(), nominal, values)
    }

    fn evaluate(
        &self,
        (design, x, values): &mut Self::Room,
        points: &[Vector],
        take: &mut Take<'_>,
    ) -> Result<(), Error> {
        let outcome = Outcome::Stable;
        for (k, z) in points.iter().enumerate() {
            self.space.design(z, design);
            for ((x, value), nominal) in x.iter_mut().zip(&*design).zip(self.space.nominal) {
                *x = value - nominal;
            }
            let (first, second) = values.split_at_mut(self.expansions.len());
            for (k, expansion) in self.expansions.iter().enumerate() {
                first[k] = expansion.as_ref().map(|item| item.first_order(x));
                second[k] = expansion.as_ref().and_then(|item| item.second_order(x));
            }
            take(k, Evaluated { design, outcome, values })?;
        }
        Ok(())
    }
}
