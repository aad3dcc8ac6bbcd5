//! Gravity: one acceleration, the same everywhere.

use super::resolver::Resolver;
use super::typed::{Typed, ValueContext};
use crate::base::dimension::Dimension;
use crate::model::expression::{Expr, Vector};
use crate::model::simplify;
use crate::syntax::ast::{self, Gravity};

impl Resolver<'_> {
    /// The acceleration in the ground frame; zero if none is declared.
    pub(super) fn gravity(&mut self) -> Vector {
        let mut declared: Option<Vector> = None;
        let mut seen = false;
        for gravity in self.ast.all::<ast::Gravity>() {
            if seen {
                let message = "gravity is declared twice";
                self.diagnostics.error(gravity.keyword, message);
                continue;
            }
            seen = true;
            declared = self.acceleration(gravity);
        }
        declared.unwrap_or([0.0; 3].map(Expr::Number))
    }

    fn acceleration(&mut self, gravity: &Gravity) -> Option<Vector> {
        let value = &gravity.value;
        let what = "gravity";
        let direction = gravity.along.as_ref().map(|along| self.direction(along, ValueContext::Parameter));
        let vector = match (self.value(value, ValueContext::Parameter)?, direction) {
            (Typed::Scalar(magnitude, quantity), Some(direction)) => {
                self.expect(quantity, Dimension::ACCELERATION, what, value)?;
                direction?.map(|component| simplify::multiply(magnitude.clone(), component))
            }
            (Typed::Vector(vector, quantity), None) => {
                self.expect(quantity, Dimension::ACCELERATION, what, value)?;
                vector
            }
            (Typed::Scalar(..), None) => {
                return self.refuse_with_help(
                    value.extent,
                    "gravity needs a direction",
                    "write `along -z` after its magnitude",
                );
            }
            (Typed::Matrix(..), _) => {
                let message = "a vector is expected here, this is a matrix";
                return self.refuse(value.extent, message);
            }
            (Typed::Vector(..), Some(_)) => {
                return self.refuse_with_help(
                    value.extent,
                    "this vector has a direction already",
                    "remove `along`, or give a magnitude instead of the vector",
                );
            }
        };
        self.require_finite(&vector, what, value.extent);
        Some(vector)
    }
}
